// Eigenvalues of a small dense symmetric matrix, for tests that hold a bound against the truth.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace taut::test {

// A square matrix, row by row.
struct Matrix {
    explicit Matrix(std::size_t size) : n(size), entries(size * size, 0.0) {}
    double& at(std::size_t row, std::size_t column) { return entries[row * n + column]; }
    double at(std::size_t row, std::size_t column) const { return entries[row * n + column]; }

    std::size_t n;
    std::vector<double> entries;
};

// Ascending. Cyclic Jacobi rotations until the off-diagonal part is rounding; the matrix is taken as symmetric.
inline std::vector<double> eigenvalues(Matrix a) {
    const std::size_t n = a.n;
    for (int sweep = 0; sweep < 60; ++sweep) {
        double off = 0.0, all = 0.0;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) (i == j ? all : off) += a.at(i, j) * a.at(i, j);
        if (off <= 1e-28 * (all + off)) break;
        for (std::size_t p = 0; p + 1 < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                if (a.at(p, q) == 0.0) continue;
                const double slope = (a.at(q, q) - a.at(p, p)) / (2.0 * a.at(p, q));
                const double t = (slope < 0.0 ? -1.0 : 1.0) / (std::abs(slope) + std::sqrt(slope * slope + 1.0));
                const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
                for (std::size_t k = 0; k < n; ++k) {
                    const double kp = a.at(k, p), kq = a.at(k, q);
                    a.at(k, p) = c * kp - s * kq;
                    a.at(k, q) = s * kp + c * kq;
                }
                for (std::size_t k = 0; k < n; ++k) {
                    const double pk = a.at(p, k), qk = a.at(q, k);
                    a.at(p, k) = c * pk - s * qk;
                    a.at(q, k) = s * pk + c * qk;
                }
            }
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(a.at(i, i));
    std::sort(values.begin(), values.end());
    return values;
}

}  // namespace taut::test
