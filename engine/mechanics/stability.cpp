#include "taut/mechanics/stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace taut::mechanics {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Largest eigenvalue of a symmetric 3×3 matrix by cyclic Jacobi rotations, which need no trigonometry.
double largestEigenvalue(Matrix m) {
    for (int sweep = 0; sweep < 12; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                const auto i = static_cast<std::size_t>(p), j = static_cast<std::size_t>(q);
                if (m[i][j] == 0.0) continue;
                const double theta = (m[j][j] - m[i][i]) / (2.0 * m[i][j]);
                const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double a = m[k][i], b = m[k][j];
                    m[k][i] = c * a - s * b;
                    m[k][j] = s * a + c * b;
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    const double a = m[i][k], b = m[j][k];
                    m[i][k] = c * a - s * b;
                    m[j][k] = s * a + c * b;
                }
            }
    return std::max({m[0][0], m[1][1], m[2][2]});
}

double largestExtra(const NetworkView& network, std::span<const double> extra) {
    double largest = 0;
    for (std::size_t i = 0; i < extra.size(); ++i) largest = std::max(largest, extra[i] * network.inverseMasses[i]);
    return largest;
}

FrequencyBound overSprings(const NetworkView& network, std::span<const double> atPoint, std::span<const double> extra) {
    FrequencyBound bound;
    double largest = 0;
    for (std::size_t s = 0; s < network.springs.size(); ++s) {
        const Spring& spring = network.springs[s];
        const double sum = atPoint[static_cast<std::size_t>(spring.a)] + atPoint[static_cast<std::size_t>(spring.b)];
        if (sum > largest) {
            largest = sum;
            bound.spring = static_cast<int>(s);
        }
    }
    const double more = largestExtra(network, extra);
    bound.omega = std::sqrt(largest + more);
    bound.bySprings = largest >= more;
    return bound;
}

// The last component of the normalised eigenvector s of a symmetric tridiagonal matrix (diagonal alpha, beside it beta)
// for its eigenvalue theta. A recurrence from one end drowns in rounding where s decays; two pivot sequences of T - θI,
// from both ends to where s is largest, do not (twisted factorisation, Dhillon and Parlett 2004).
double lastComponent(const std::vector<double>& alpha, const std::vector<double>& beta, double theta) {
    const std::size_t n = alpha.size();
    const auto safe = [](double pivot) { return pivot == 0.0 ? 1e-300 : pivot; };
    std::vector<double> down(n), up(n);
    for (std::size_t i = 0; i < n; ++i)
        down[i] = alpha[i] - theta - (i > 0 ? beta[i - 1] * beta[i - 1] / safe(down[i - 1]) : 0.0);
    for (std::size_t i = n; i-- > 0;)
        up[i] = alpha[i] - theta - (i + 1 < n ? beta[i] * beta[i] / safe(up[i + 1]) : 0.0);
    std::size_t twist = 0;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < n; ++i) {
        const double gamma = std::abs(down[i] + up[i] - (alpha[i] - theta));
        if (gamma < least) {
            least = gamma;
            twist = i;
        }
    }
    double last = 1.0, square = 1.0, s = 1.0;
    for (std::size_t i = twist; i-- > 0;) {
        s *= -beta[i] / safe(down[i]);
        square += s * s;
    }
    for (std::size_t i = twist; i + 1 < n; ++i) {
        last *= -beta[i] / safe(up[i + 1]);
        square += last * last;
    }
    return last / std::sqrt(square);
}

}  // namespace

FrequencyBound boundAnywhere(const NetworkView& network, std::span<const double> extraStiffness) {
    std::vector<double> sum(network.inverseMasses.size(), 0.0);
    for (const Spring& spring : network.springs) {
        sum[static_cast<std::size_t>(spring.a)] += spring.stiffness;
        sum[static_cast<std::size_t>(spring.b)] += spring.stiffness;
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] *= network.inverseMasses[i];
    return overSprings(network, sum, extraStiffness);
}

FrequencyBound boundHere(const NetworkView& network, std::span<const double> extraStiffness,
                         std::span<const glm::dvec3> positions) {
    std::vector<Matrix> sum(network.inverseMasses.size(), Matrix{});
    for (const Spring& spring : network.springs) {
        const auto a = static_cast<std::size_t>(spring.a), b = static_cast<std::size_t>(spring.b);
        const glm::dvec3 d = positions[b] - positions[a];
        const double l = std::sqrt(glm::dot(d, d));
        const glm::dvec3 n = l > 0 ? d / l : glm::dvec3(0.0);
        const double across = l > 0 ? std::max(0.0, 1.0 - spring.restLength / l) : 1.0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double entry = spring.stiffness * ((1.0 - across) * n[i] * n[j] + (i == j ? across : 0.0));
                sum[a][static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] += entry;
                sum[b][static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] += entry;
            }
    }
    std::vector<double> atPoint(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) atPoint[i] = largestEigenvalue(sum[i]) * network.inverseMasses[i];
    return overSprings(network, atPoint, extraStiffness);
}

void addSpringStiffness(std::span<const Spring> springs, std::span<const glm::dvec3> positions,
                        std::span<const glm::dvec3> u, std::span<glm::dvec3> out) {
    for (const Spring& spring : springs) {
        const auto a = static_cast<std::size_t>(spring.a), b = static_cast<std::size_t>(spring.b);
        const glm::dvec3 d = positions[b] - positions[a];
        const double l = std::sqrt(glm::dot(d, d));
        const glm::dvec3 du = u[a] - u[b];
        glm::dvec3 f = spring.stiffness * du;
        if (l > 0) {
            const glm::dvec3 n = d / l;
            f = spring.stiffness * (du * (1.0 - spring.restLength / l) + n * (glm::dot(n, du) * spring.restLength / l));
        }
        out[a] += f;
        out[b] -= f;
    }
}

namespace {

// The largest Ritz value and its residual [1/s²].
struct Ritz {
    double value = 0, residual = 0;
};

// The tridiagonal matrix of m Lanczos steps; its largest eigenvalue by bisection on Sturm sequences.
Ritz largestRitz(std::span<const double> inverseMasses, const StiffnessProduct& multiply, int products) {
    const std::size_t n = inverseMasses.size();
    std::vector<glm::dvec3> q(n), before(n, glm::dvec3(0.0)), scaled(n), r(n);
    double norm = 0;
    // A start without symmetry, the same everywhere: the fractional parts of multiples of the golden ratio.
    for (std::size_t i = 0; i < n; ++i)
        for (int p = 0; p < 3; ++p) {
            const double phase = static_cast<double>(3 * i + static_cast<std::size_t>(p) + 1) * 0.6180339887498949;
            q[i][p] = inverseMasses[i] > 0 ? phase - std::floor(phase) - 0.5 : 0.0;
            norm += q[i][p] * q[i][p];
        }
    if (norm == 0) return {};
    for (auto& x : q) x /= std::sqrt(norm);
    std::vector<double> alpha, beta;
    double scale = 0;
    for (int k = 0; k < products; ++k) {
        for (std::size_t i = 0; i < n; ++i) scaled[i] = q[i] * std::sqrt(inverseMasses[i]);
        std::fill(r.begin(), r.end(), glm::dvec3(0.0));
        multiply(scaled, r);
        double a = 0;
        for (std::size_t i = 0; i < n; ++i) {
            r[i] *= std::sqrt(inverseMasses[i]);
            a += glm::dot(r[i], q[i]);
        }
        const double last = beta.empty() ? 0.0 : beta.back();
        double b = 0;
        for (std::size_t i = 0; i < n; ++i) {
            r[i] -= a * q[i] + last * before[i];
            b += glm::dot(r[i], r[i]);
        }
        b = std::sqrt(b);
        alpha.push_back(a);
        beta.push_back(b);
        scale = std::max({scale, std::abs(a), b});
        if (b <= 1e-12 * scale) break;
        for (std::size_t i = 0; i < n; ++i) {
            before[i] = q[i];
            q[i] = r[i] / b;
        }
    }
    double high = 0;
    for (std::size_t i = 0; i < alpha.size(); ++i)
        high = std::max(high, alpha[i] + beta[i] + (i > 0 ? beta[i - 1] : 0.0));
    double low = 0;
    // The number of eigenvalues above λ is the number of positive terms of the Sturm sequence.
    const auto above = [&](double lambda) {
        double d = 1;
        for (std::size_t i = 0; i < alpha.size(); ++i) {
            const double off = i > 0 ? beta[i - 1] * beta[i - 1] : 0.0;
            d = alpha[i] - lambda - off / (d == 0 ? 1e-300 : d);
            if (d > 0) return true;
        }
        return false;
    };
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (above(middle) ? low : high) = middle;
    }
    return {low, beta.back() * std::abs(lastComponent(alpha, beta, low))};
}

}  // namespace

double estimateFrequency(std::span<const double> inverseMasses, const StiffnessProduct& multiply, int products) {
    const Ritz ritz = largestRitz(inverseMasses, multiply, products);
    return std::sqrt(ritz.value + ritz.residual);
}

double leastFrequency(std::span<const double> inverseMasses, const StiffnessProduct& multiply, int products) {
    return std::sqrt(largestRitz(inverseMasses, multiply, products).value);
}

}  // namespace taut::mechanics
