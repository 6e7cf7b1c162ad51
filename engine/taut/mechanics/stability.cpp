#include "taut/mechanics/private/stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "taut/core/error.h"
#include "taut/mechanics/private/cell_shape.h"

namespace taut::mechanics {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Largest eigenvalue of a symmetric 3×3 matrix by cyclic Jacobi rotations, which need no trigonometry.
double largestEigenvalue(Matrix m) {
    for (int sweep = 0; sweep < 12; ++sweep) {
        // The error is no more than `off` over the largest entry.
        const double off = m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
        if (off <= 1e-32 * (m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2])) break;
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
    }
    return std::max({m[0][0], m[1][1], m[2][2]});
}

double largestExtra(const NetworkView& network, std::span<const double> extra) {
    double largest = 0;
    for (std::size_t i = 0; i < extra.size(); ++i) largest = std::max(largest, extra[i] * network.inverseMasses[i]);
    return largest;
}

// atPoint (points) a_i [1/s²]; more [1/s²] is added to their largest sum over an element.
FrequencyBound overElements(const NetworkView& network, std::span<const double> atPoint, double more) {
    FrequencyBound bound;
    double largest = 0;
    for (std::size_t s = 0; s < network.springs.size(); ++s) {
        const Spring& spring = network.springs[s];
        const double sum = atPoint[spring.a] + atPoint[spring.b];
        if (sum > largest) {
            largest = sum;
            bound.spring = static_cast<int>(s);
        }
    }
    bound.bySprings = largest >= more;
    for (const VolumeCell& cell : network.cells) {
        double sum = 0;
        for (int i : cell.points) sum += atPoint[i];
        if (sum <= largest) continue;
        largest = sum;
        bound.bySprings = false;
    }
    bound.omega = std::sqrt(largest + more);
    return bound;
}

void addOuter(Matrix& sum, double factor, const glm::dvec3& n) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) sum[i][j] += factor * n[i] * n[j];
}
void addToAll(Matrix& sum, double factor) {
    for (std::size_t i = 0; i < 3; ++i) sum[i][i] += factor;
}

// Adds `factor` times the spring's stiffness at both its points.
void addSpring(std::vector<Matrix>& sum, const Spring& spring, double factor, std::span<const glm::dvec3> positions) {
    const auto a = static_cast<std::size_t>(spring.a), b = static_cast<std::size_t>(spring.b);
    const glm::dvec3 d = positions[b] - positions[a];
    const double l = std::sqrt(glm::dot(d, d));
    const glm::dvec3 n = l > 0 ? d / l : glm::dvec3(0.0);
    const double across = l > 0 ? std::max(0.0, 1.0 - spring.restLength / l) : 1.0;
    for (const std::size_t i : {a, b}) {
        addOuter(sum[i], factor * spring.stiffness * (1.0 - across), n);
        addToAll(sum[i], factor * spring.stiffness * across);
    }
}

// Pairs of points that cells couple, each with the h [N/m] that the pressures of its cells cause.
struct PressureCouplings {
    std::vector<std::vector<std::pair<int, glm::dvec3>>> higher;  // (points) the other point of a pair

    explicit PressureCouplings(std::size_t points) : higher(points) {}
    void add(int a, int b, const glm::dvec3& h) {
        auto& of = higher[std::min(a, b)];
        const int other = std::max(a, b);
        auto found = std::find_if(of.begin(), of.end(), [&](const auto& pair) { return pair.first == other; });
        if (found == of.end()) found = of.insert(found, {other, glm::dvec3(0.0)});
        found->second += h;
    }
};

// Adds the stiffness of the cell and of its folds at their corners, each times the sum of `weights` (points; empty: 1)
// of its corners.
void addCell(std::vector<Matrix>& sum, const VolumeCell& cell, std::span<const double> weights, const CellCorners& p) {
    const auto add = [&](const auto& corners, const auto& gradients, double volume) {
        double weight = weights.empty() ? 1.0 : 0.0;
        if (!weights.empty())
            for (std::size_t c : corners) weight += weights[cell.points[c]];
        for (std::size_t k = 0; k < corners.size(); ++k)
            addOuter(sum[cell.points[corners[k]]], weight * cell.bulkModulus / volume, gradients[k]);
    };
    add(cellCorners, gradientsOf(p), cell.restVolume);
    forEachFold(p, cell.restVolume,
                [&](const Fold& fold) { add(fold.corners, fold.gradients, cell.restVolume / 6.0); });
}

void addPressure(PressureCouplings& pressed, const VolumeCell& cell, const CellCorners& p) {
    const double pressure = cell.bulkModulus * (volumeOf(p) / cell.restVolume - 1.0);
    for (const CellPair& pair : cellPairs) {
        const int a = cell.points[pair.i], b = cell.points[pair.j];
        pressed.add(a, b, (a < b ? pressure : -pressure) * pair.coupling(p));
    }
    forEachFold(p, cell.restVolume, [&](const Fold& fold) {
        for (const auto& [i, j, h] : couplingsOf(fold, p)) {
            const int a = cell.points[i], b = cell.points[j];
            pressed.add(a, b, (a < b ? 1.0 : -1.0) * cell.bulkModulus * h);
        }
    });
}

double largestRow(const NetworkView& network, PressureCouplings& pressed) {
    std::vector<double> rows(network.inverseMasses.size(), 0.0);
    for (std::size_t a = 0; a < rows.size(); ++a) {
        auto& of = pressed.higher[a];
        std::sort(of.begin(), of.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
        for (const auto& [other, h] : of) {
            const auto b = static_cast<std::size_t>(other);
            const double entry = std::sqrt(network.inverseMasses[a] * network.inverseMasses[b] * glm::dot(h, h));
            rows[a] += entry;
            rows[b] += entry;
        }
    }
    return rows.empty() ? 0.0 : *std::max_element(rows.begin(), rows.end());
}

// Σ_e T_e K_e at the points, T_e the sum of `weights` (points; empty: 1) over the points of the element e. `loose`
// (springs; may be empty): springs that count with all their stiffness in every direction.
std::vector<Matrix> stiffnessAtPoints(const NetworkView& network, std::span<const glm::dvec3> positions,
                                      const std::vector<bool>& loose, std::span<const double> weights) {
    std::vector<Matrix> sum(network.inverseMasses.size(), Matrix{});
    for (std::size_t s = 0; s < network.springs.size(); ++s) {
        const Spring& spring = network.springs[s];
        const double factor = weights.empty() ? 1.0 : weights[spring.a] + weights[spring.b];
        if (loose.empty() || !loose[s]) {
            addSpring(sum, spring, factor, positions);
        } else {
            addToAll(sum[spring.a], factor * spring.stiffness);
            addToAll(sum[spring.b], factor * spring.stiffness);
        }
    }
    for (const VolumeCell& cell : network.cells) addCell(sum, cell, weights, cornersOf(cell, positions));
    return sum;
}

// The first sweep computes a_i of every point. The second sweep weighs each element with the sum of its a_i.
FrequencyBound secondBound(const NetworkView& network, std::span<const double> extra,
                           std::span<const glm::dvec3> positions, const std::vector<bool>& loose) {
    const auto rates = [&](const std::vector<Matrix>& sum) {
        std::vector<double> atPoint(sum.size());
        for (std::size_t i = 0; i < sum.size(); ++i) atPoint[i] = largestEigenvalue(sum[i]) * network.inverseMasses[i];
        return atPoint;
    };
    const std::vector<double> a = rates(stiffnessAtPoints(network, positions, loose, {}));
    PressureCouplings pressed(network.inverseMasses.size());
    for (const VolumeCell& cell : network.cells) addPressure(pressed, cell, cornersOf(cell, positions));
    const double more = largestExtra(network, extra) + largestRow(network, pressed);
    FrequencyBound bound = overElements(network, a, more);
    if (network.cells.empty()) return bound;

    const std::vector<double> b = rates(stiffnessAtPoints(network, positions, loose, a));
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] > 0) largest = std::max(largest, b[i] / a[i]);
    bound.omega = std::min(bound.omega, std::sqrt(largest + more));
    return bound;
}

// The last component of the normalised eigenvector s of a symmetric tridiagonal matrix (diagonal alpha, beside it beta)
// for its eigenvalue theta. A recurrence from one end drowns in rounding where s decays. So it uses two pivot sequences
// of T - θI, from both ends to where s is largest (twisted factorisation, Dhillon and Parlett 2004).
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
    TAUT_EXPECTS(network.cells.empty());
    std::vector<double> sum(network.inverseMasses.size(), 0.0);
    for (const Spring& spring : network.springs) {
        sum[spring.a] += spring.stiffness;
        sum[spring.b] += spring.stiffness;
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] *= network.inverseMasses[i];
    return overElements(network, sum, largestExtra(network, extraStiffness));
}

FrequencyBound boundHere(const NetworkView& network, std::span<const double> extraStiffness,
                         std::span<const glm::dvec3> positions) {
    return secondBound(network, extraStiffness, positions, {});
}

FrequencyBound boundWithin(const NetworkView& network, std::span<const double> extraStiffness,
                           std::span<const glm::dvec3> restPositions, double stretch) {
    if (network.cells.empty()) return boundAnywhere(network, extraStiffness);
    std::vector<bool> isCorner(network.inverseMasses.size(), false), loose;
    for (const VolumeCell& cell : network.cells)
        for (int i : cell.points) isCorner[i] = true;
    for (const Spring& spring : network.springs) loose.push_back(!isCorner[spring.a] || !isCorner[spring.b]);
    FrequencyBound largest;
    std::vector<glm::dvec3> positions(restPositions.size());
    const auto lookAt = [&](const glm::dvec3& scale) {
        for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = scale * restPositions[i];
        const FrequencyBound bound = secondBound(network, extraStiffness, positions, loose);
        if (bound.omega > largest.omega) largest = bound;
    };
    lookAt(glm::dvec3(stretch));
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 thick(1.0), thin(stretch);
        thick[axis] = -stretch;
        thin[axis] = -1.0 / stretch;
        lookAt(thick);
        lookAt(thin);
    }
    return largest;
}

void addSpringStiffness(std::span<const Spring> springs, std::span<const glm::dvec3> positions,
                        std::span<const glm::dvec3> u, std::span<glm::dvec3> out) {
    for (const Spring& spring : springs) {
        const auto a = static_cast<std::size_t>(spring.a), b = static_cast<std::size_t>(spring.b);
        const glm::dvec3 du = u[a] - u[b];
        if (du == glm::dvec3(0.0)) continue;
        const glm::dvec3 d = positions[b] - positions[a];
        const double l = std::sqrt(glm::dot(d, d));
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

// Makes Lanczos steps, then finds the largest eigenvalue of their tridiagonal matrix by bisection on Sturm sequences.
Ritz largestRitz(std::span<const double> inverseMasses, const StiffnessProduct& multiply, int products) {
    const std::size_t n = inverseMasses.size();
    std::vector<glm::dvec3> q(n), before(n, glm::dvec3(0.0)), scaled(n), r(n);
    double norm = 0;
    // A start without symmetry, the same on every machine: the fractional parts of multiples of the golden ratio.
    for (std::size_t i = 0; i < n; ++i)
        for (int p = 0; p < 3; ++p) {
            const double phase = static_cast<double>(3 * i + static_cast<std::size_t>(p) + 1) * 0.6180339887498949;
            q[i][p] = inverseMasses[i] > 0 ? phase - std::floor(phase) - 0.5 : 0.0;
            norm += q[i][p] * q[i][p];
        }
    if (norm == 0) return {};
    for (auto& x : q) x /= std::sqrt(norm);
    // The steps: diagonal alpha, beside it beta.
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
    // Bisection from Gershgorin's bound.
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
