#include "taut/island/private/rest_bound.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "taut/ode/private/conjugate_gradient.h"

namespace taut::world {
namespace {

constexpr double tolerance = 1e-3;  // residual over right-hand side
constexpr int mostProducts = 2000;

double product(std::span<const dvec3> a, std::span<const dvec3> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
    return sum;
}

// Without the part along a normal.
dvec3 along(const dvec3& v, const dvec3& normal) {
    return v - glm::dot(v, normal) * normal;
}

// Solves K u = b for the free points. Returns false if it cannot.
bool solve(std::span<const double> inverseMasses, std::span<const dvec3> normals,
           const mechanics::StiffnessProduct& multiply, std::span<const dvec3> b, std::vector<dvec3>& u) {
    const std::size_t n = b.size();
    std::vector<dvec3> inverse(n), across(n), in(n), sum(n);
    for (std::size_t i = 0; i < n; ++i) {
        inverse[i] = dvec3(inverseMasses[i]);
        across[i] = along(b[i], normals[i]);
    }
    u.assign(n, dvec3(0.0));
    const auto multiplyAcross = [&](const double* from, double* to) {
        std::copy_n(from, 3 * n, &in.front().x);
        std::fill(sum.begin(), sum.end(), dvec3(0.0));
        multiply(in, sum);
        for (std::size_t i = 0; i < n; ++i) sum[i] = along(sum[i], normals[i]);
        std::copy_n(&sum.front().x, 3 * n, to);
    };
    ode::ConjugateGradient<double> solver(3 * n);
    const int most = std::min(mostProducts, 12 * static_cast<int>(n) + 20);
    return solver.solve(multiplyAcross, &inverse.front().x, &across.front().x, tolerance, most, &u.front().x).converged;
}

double longest(std::span<const dvec3> vectors) {
    double square = 0;
    for (const dvec3& v : vectors) square = std::max(square, glm::dot(v, v));
    return std::sqrt(square);
}

}  // namespace

double restBound(std::span<const double> inverseMasses, std::span<const dvec3> normals, std::span<const dvec3> v,
                 std::span<const dvec3> r, double floor, const mechanics::StiffnessProduct& multiply) {
    constexpr double none = std::numeric_limits<double>::infinity();
    const std::size_t n = v.size();
    std::vector<dvec3> shaken(n, dvec3(0.0)), momenta(n, dvec3(0.0)), forces(n, dvec3(0.0)), way, swing;
    bool isAnyFree = false;
    for (std::size_t i = 0; i < n; ++i) {
        if (!(inverseMasses[i] > 0)) continue;
        isAnyFree = true;
        for (int k = 0; k < 3; ++k) {
            // The same on every machine, and without symmetry: fractional parts of multiples of the golden ratio.
            const double phase = static_cast<double>(3 * i + static_cast<std::size_t>(k) + 1) * 0.6180339887498949;
            shaken[i][k] = v[i][k] + floor * (2.0 * (phase - std::floor(phase)) - 1.0);
        }
        shaken[i] = along(shaken[i], normals[i]);
        momenta[i] = shaken[i] / inverseMasses[i];
        forces[i] = r[i];
    }
    if (!isAnyFree) return 0.0;
    if (!solve(inverseMasses, normals, multiply, momenta, swing)) return none;
    if (!solve(inverseMasses, normals, multiply, forces, way)) return none;
    const double kinetic = product(momenta, shaken), swung = product(momenta, swing);
    if (!(kinetic > 0) || !(swung >= 0)) return none;
    return longest(way) + longest(shaken) * std::sqrt(swung / kinetic);
}

}  // namespace taut::world
