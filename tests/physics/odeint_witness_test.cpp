// A third party's witness: spring nets integrated by Boost.odeint, on a right-hand side written here from the formula,
// agree with ours.
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <vector>

#include "support/network.h"

namespace taut::test::odeint_witness {
namespace {

namespace odeint = boost::numeric::odeint;
using mechanics::Model;

// x then v, point by point: x y z of each.
using Stack = std::vector<double>;

// F_a = [k (l - L) + k τ (v_b - v_a)·n] n, F_b = -F_a; a = F/m + g - γ v; held points rest. It shares the numbers of
// the model with ours and no code.
struct Equations {
    const Model& model;
    std::array<double, 3> g;

    void operator()(const Stack& y, Stack& slope, double) const {
        const std::size_t n = model.masses.size(), half = 3 * n;
        Stack force(half, 0.0);
        for (const auto& s : model.springs) {
            const std::size_t a = 3 * static_cast<std::size_t>(s.a), b = 3 * static_cast<std::size_t>(s.b);
            double d[3], u[3], l2 = 0.0, du = 0.0;
            for (std::size_t p = 0; p < 3; ++p) {
                d[p] = y[b + p] - y[a + p];
                u[p] = y[half + b + p] - y[half + a + p];
                l2 += d[p] * d[p];
                du += d[p] * u[p];
            }
            const double l = std::sqrt(l2), pull = s.stiffness * (l - s.restLength + s.dampingTime * du / l) / l;
            for (std::size_t p = 0; p < 3; ++p) {
                force[a + p] += pull * d[p];
                force[b + p] -= pull * d[p];
            }
        }
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t p = 0; p < 3; ++p) {
                const std::size_t at = 3 * i + p;
                slope[at] = model.held[i] ? 0.0 : y[half + at];
                slope[half + at] =
                    model.held[i] ? 0.0 : force[at] / model.masses[i] + g[p] - model.dragRates[i] * y[half + at];
            }
    }
};

Stack stacked(const std::vector<dvec3>& x, const std::vector<dvec3>& v) {
    Stack y;
    for (const auto* all : {&x, &v})
        for (const dvec3& value : *all) y.insert(y.end(), {value.x, value.y, value.z});
    return y;
}

// Our Runge-Kutta 4 at h against an adaptive method of odeint at times 0.1 s apart.
template <class Stepper>
void expectAgreement(const Model& model, double h, Stepper stepper) {
    const dvec3 gravity(0, -9.81, 0);
    const Equations equations{model, {0.0, -9.81, 0.0}};
    Network network(model, "rk4", h, gravity);
    Stack y = stacked(network.positions(), network.velocities());
    const auto stepsPerLook = static_cast<std::int64_t>(std::lround(0.1 / h));
    double moved = 0.0;
    for (int look = 0; look < 5; ++look) {
        odeint::integrate_adaptive(stepper, equations, y, 0.1 * look, 0.1 * (look + 1), 1e-4);
        network.step(stepsPerLook);
        const Stack ours = stacked(network.positions(), network.velocities());
        for (std::size_t i = 0; i < y.size() / 2; ++i) {
            // ω h is 2.5e-3 and less, ω T 60: RK4 is off by (ω h)⁴ ω T/120 = 2e-11 of a motion of decimetres; the
            // witness by 1e-12 a step. Speeds are ω times that.
            ASSERT_NEAR(ours[i], y[i], 1e-9) << "number " << i << " at " << network.time();
            ASSERT_NEAR(ours[y.size() / 2 + i], y[y.size() / 2 + i], 1e-8) << "number " << i;
            const std::size_t point = i / 3;
            moved = std::max(moved, std::abs(y[i] - model.positions[point][static_cast<int>(i % 3)]));
        }
    }
    EXPECT_GT(moved, 0.1);
}

TEST(OdeintWitness, AgreesOnASpringNetByFehlberg78) {
    Model model;
    const dvec3 places[] = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1.1, 0}, {0.1, 0.3, 0.9}, {1, 1, 1}, {0.5, -0.6, 0.4}};
    for (int i = 0; i < 6; ++i) {
        addPoint(model, places[i], 0.1 + 0.07 * i, i == 2);
        if (i != 2) model.velocities.back() = {0.3 + 0.4 * places[i].z, 1.0 - 0.2 * i, -2.0 * places[i].x};
        model.dragRates.back() = 0.1 * i;
    }
    for (int a = 0; a < 6; ++a)
        for (int b = a + 1; b < 6; ++b)
            addSpring(model, a, b, 20.0 + 5.0 * a, (b % 2 == 0 ? 0.8 : 1.2) * glm::length(places[b] - places[a]),
                      a % 2 == 0 ? 5e-3 : 0.0);
    expectAgreement(model, 1e-4, odeint::make_controlled(1e-13, 1e-13, odeint::runge_kutta_fehlberg78<Stack>()));
}

// A 4 × 4 cloth held along its top, wired here: structural, shear and bend springs with dashpots, and drag.
TEST(OdeintWitness, AgreesOnADampedClothByBulirschAndStoer) {
    Model model;
    constexpr int n = 5;
    constexpr double cell = 0.1, tau = 2e-3;
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            addPoint(model, {cell * column, -0.6 * cell * row, 0.8 * cell * row}, 0.01, row == 0);
            if (row > 0)
                model.velocities.back() = {0.2 * std::sin(1.0 * row), 0.1 * column, 0.3 * std::cos(2.0 * column)};
            model.dragRates.back() = 0.5;
        }
    const auto at = [](int row, int column) { return n * row + column; };
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            const int here = at(row, column);
            if (column + 1 < n) addSpring(model, here, at(row, column + 1), 15.0, cell, tau);
            if (row + 1 < n) addSpring(model, here, at(row + 1, column), 15.0, cell, tau);
            if (row + 1 < n && column + 1 < n) {
                addSpring(model, here, at(row + 1, column + 1), 7.5, std::sqrt(2.0) * cell, tau);
                addSpring(model, at(row, column + 1), at(row + 1, column), 7.5, std::sqrt(2.0) * cell, tau);
            }
            if (column + 2 < n) addSpring(model, here, at(row, column + 2), 1.0, 2 * cell, tau);
            if (row + 2 < n) addSpring(model, here, at(row + 2, column), 1.0, 2 * cell, tau);
        }
    expectAgreement(model, 2.5e-5, odeint::bulirsch_stoer<Stack>(1e-12, 1e-12));
}

}  // namespace
}  // namespace taut::test::odeint_witness
