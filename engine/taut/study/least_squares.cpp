#include "taut/study/least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut::study {
namespace {

using Matrix = std::vector<Vector>;  // of rows

constexpr double longest = 1.5;        // step of an unknown
constexpr double leastDamping = 1e-6;  // next to columns of length 1
constexpr double collinear = 1e-4;     // eigenvalue, next to columns of length 1

double dot(const Vector& a, const Vector& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// The normal equations JᵀJ d = -Jᵀr with columns of J scaled to length 1, by the eigenvectors of their matrix. An
// unknown that is held has no column.
class NormalEquations {
  public:
    // columns: (unknowns)(residuals)
    NormalEquations(const Matrix& columns, const Vector& residuals) {
        const std::size_t n = columns.size();
        Matrix matrix(n, Vector(n));
        for (const Vector& column : columns) {
            length_.push_back(std::sqrt(dot(column, column)));
            gradient_.push_back(length_.back() > 0 ? dot(column, residuals) / length_.back() : 0.0);
        }
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                const double both = length_[i] * length_[j];
                matrix[i][j] = both > 0 ? dot(columns[i], columns[j]) / both : 0.0;
            }
        of_ = eigenvectors(std::move(matrix));
    }

    Vector step(double damping) const {
        Vector d(length_.size(), 0.0);
        eachDirection([&](const Vector& along, double value) {
            const double share = -dot(along, gradient_) / (value + damping);
            for (std::size_t i = 0; i < d.size(); ++i) d[i] += share * unscaled(along[i], i);
        });
        return d;
    }

    // By how much the sum of squares would fall if residuals were linear.
    double gain() const {
        double sum = 0;
        eachDirection([&](const Vector& along, double value) {
            const double part = dot(along, gradient_);
            sum += part * part / (value + leastDamping);
        });
        return sum;
    }

    Matrix covariance() const {
        Matrix sum(length_.size(), Vector(length_.size(), 0.0));
        eachDirection([&](const Vector& along, double value) {
            for (std::size_t i = 0; i < along.size(); ++i)
                for (std::size_t j = 0; j < along.size(); ++j)
                    sum[i][j] += unscaled(along[i], i) * unscaled(along[j], j) / value;
        });
        return sum;
    }

    Matrix unseen(const std::vector<bool>& isHeld) const {
        Matrix directions;
        for (std::size_t i = 0; i < length_.size(); ++i) {
            if (length_[i] > 0 || isHeld[i]) continue;
            directions.emplace_back(length_.size(), 0.0)[i] = 1;
        }
        eachDirection([&](const Vector& along, double value) {
            Vector d;
            for (std::size_t i = 0; i < along.size(); ++i) d.push_back(unscaled(along[i], i));
            const double size = std::sqrt(dot(d, d));
            if (value > collinear && size < std::sqrt(value)) return;
            for (double& part : d) part /= size;
            directions.push_back(std::move(d));
        });
        return directions;
    }

  private:
    double unscaled(double part, std::size_t i) const { return length_[i] > 0 ? part / length_[i] : 0.0; }

    // Of the parameters that have a column.
    template <class Visit>
    void eachDirection(const Visit& visit) const {
        for (std::size_t k = 0; k < length_.size(); ++k) {
            double inColumns = 0;
            for (std::size_t i = 0; i < length_.size(); ++i)
                if (length_[i] > 0) inColumns += std::abs(of_.vectors[k][i]);
            if (inColumns > 0.5) visit(of_.vectors[k], std::max(of_.values[k], 1e-15));
        }
    }

    Vector length_;    // (unknowns) of columns
    Vector gradient_;  // (unknowns)
    Eigenvectors of_;
};

class Descent {
  public:
    explicit Descent(const LeastSquares& problem) : problem_(problem) {
        at_.x = problem.start;
        at_.residuals = evaluate({at_.x}).front();
    }

    Minimum run() {
        if (at_.residuals.empty()) return at_;
        double damping = 1e-2;
        while (true) {
            const Matrix columns = derivatives();
            hold(columns);
            Matrix free = columns;
            for (std::size_t i = 0; i < free.size(); ++i)
                if (at_.isHeld[i]) std::ranges::fill(free[i], 0.0);
            const NormalEquations equations(free, at_.residuals);
            const double perValue = at_.sum() / static_cast<double>(at_.residuals.size());
            at_.hasConverged =
                equations.gain() < 1e-4 * std::max(1.0, perValue) || !(stepped(equations, damping) || isCut_);
            if (at_.hasConverged || isCut_ || used_ + 2 * static_cast<int>(at_.x.size()) + 3 > problem_.most) {
                conclude(equations);
                return at_;
            }
        }
    }

  private:
    std::vector<Vector> evaluate(const std::vector<Vector>& points) {
        used_ += static_cast<int>(points.size());
        return problem_.residuals(points);
    }

    // (unknowns)(residuals) by differences to both sides, or to one where the other has no value.
    Matrix derivatives() {
        std::vector<Vector> points;
        for (std::size_t i = 0; i < at_.x.size(); ++i)
            for (const double side : {-1.0, 1.0}) {
                points.push_back(at_.x);
                double& x = points.back()[i];
                x = std::clamp(x + side * problem_.difference, problem_.low[i], problem_.high[i]);
            }
        const std::vector<Vector> values = evaluate(points);
        Matrix columns;
        for (std::size_t i = 0; i < at_.x.size(); ++i) {
            const bool hasLeft = !values[2 * i].empty(), hasRight = !values[2 * i + 1].empty();
            const Vector& left = hasLeft ? values[2 * i] : at_.residuals;
            const Vector& right = hasRight ? values[2 * i + 1] : at_.residuals;
            const double width = (hasRight ? points[2 * i + 1][i] : at_.x[i]) - (hasLeft ? points[2 * i][i] : at_.x[i]);
            Vector& column = columns.emplace_back(at_.residuals.size(), 0.0);
            for (std::size_t k = 0; k < column.size() && width > 0; ++k) column[k] = (right[k] - left[k]) / width;
        }
        return columns;
    }

    // Where the sum falls outwards at a bound.
    void hold(const Matrix& columns) {
        at_.isHeld.clear();
        for (std::size_t i = 0; i < at_.x.size(); ++i) {
            const double slope = dot(columns[i], at_.residuals);
            at_.isHeld.push_back((at_.x[i] <= problem_.low[i] && slope > 0) ||
                                 (at_.x[i] >= problem_.high[i] && slope < 0));
        }
    }

    Vector pointAt(const Vector& step) const {
        double most = 0;
        for (const double part : step) most = std::max(most, std::abs(part));
        const double share = most > longest ? longest / most : 1.0;
        Vector x = at_.x;
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = std::clamp(x[i] + share * step[i], problem_.low[i], problem_.high[i]);
        return x;
    }

    // Three dampings at a time; whether one of them makes the sum less.
    bool stepped(const NormalEquations& equations, double& damping) {
        while (damping < 1e6) {
            if (used_ + 3 > problem_.most) {
                isCut_ = true;
                return false;
            }
            std::vector<Vector> points;
            for (const double factor : {0.1, 1.0, 10.0}) points.push_back(pointAt(equations.step(damping * factor)));
            const std::vector<Vector> values = evaluate(points);
            const double before = at_.sum(), dampings[] = {0.1 * damping, damping, 10 * damping};
            double best = before;
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (values[i].empty() || !(dot(values[i], values[i]) < best)) continue;
                best = dot(values[i], values[i]);
                at_.x = points[i];
                at_.residuals = values[i];
                damping = std::max(dampings[i], leastDamping);
            }
            if (best < before) return true;
            damping *= 1e3;
        }
        return false;
    }

    void conclude(const NormalEquations& equations) {
        at_.unseen = equations.unseen(at_.isHeld);
        at_.covariance = equations.covariance();
        const auto n = static_cast<double>(at_.residuals.size()), unknowns = static_cast<double>(at_.x.size());
        const double scatter = n > unknowns ? std::max(1.0, at_.sum() / (n - unknowns)) : 1.0;
        for (std::size_t i = 0; i < at_.x.size(); ++i) {
            for (double& part : at_.covariance[i]) part *= scatter;
            at_.deviation.push_back(at_.isHeld[i] ? std::numeric_limits<double>::quiet_NaN()
                                                  : std::sqrt(at_.covariance[i][i]));
        }
    }

    const LeastSquares& problem_;
    Minimum at_;
    int used_ = 0;
    bool isCut_ = false;
};

}  // namespace

double Minimum::sum() const {
    return dot(residuals, residuals);
}

Minimum leastSquares(const LeastSquares& problem) {
    return Descent(problem).run();
}

Eigenvectors eigenvectors(std::vector<Vector> a) {
    const std::size_t n = a.size();
    Matrix v(n, Vector(n, 0.0));  // rows
    for (std::size_t i = 0; i < n; ++i) v[i][i] = 1;
    for (int sweep = 0; sweep < 30; ++sweep)
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                if (a[p][q] == 0) continue;
                // The rotation that makes a_pq nothing.
                const double half = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
                const double t = (half < 0 ? -1 : 1) / (std::abs(half) + std::sqrt(half * half + 1));
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
                for (std::size_t k = 0; k < n; ++k) {
                    const double x = a[k][p], y = a[k][q];
                    a[k][p] = c * x - s * y, a[k][q] = s * x + c * y;
                }
                for (Matrix* rows : {&a, &v})
                    for (std::size_t k = 0; k < n; ++k) {
                        const double x = (*rows)[p][k], y = (*rows)[q][k];
                        (*rows)[p][k] = c * x - s * y, (*rows)[q][k] = s * x + c * y;
                    }
            }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t i, std::size_t j) { return a[i][i] < a[j][j]; });
    Eigenvectors found;
    for (const std::size_t i : order) {
        found.values.push_back(a[i][i]);
        found.vectors.push_back(v[i]);
    }
    return found;
}

}  // namespace taut::study
