#include "taut/mechanics/dashpot_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics_planar_state.h"
#include "support/network.h"
#include "taut/core/private/parallel.h"
#include "taut/mechanics/builders.h"
#include "taut/ode/method_table.h"

namespace taut::mechanics {
namespace {

using test::PlanarState;

template <class Real>
double kineticEnergy(const PlanarState<Real>& state) {
    double energy = 0;
    for (int i = 0; i < state.count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = state.index(i, axis);
            energy += 0.5 * static_cast<double>(state.mass[i]) * std::pow(static_cast<double>(state.v[at]), 2);
        }
    return energy;
}

template <class Real>
SpringNetwork<Real> networkOf(const Model& model) {
    return {model.pointCount(), std::vector<PointRange>{{0, model.grid[0] > 0 ? model.grid[0] + 1 : 0}}, model.springs};
}

// Whole step of a sweep.
template <class Real>
void damp(DashpotSweep<Real>& sweep, const SpringNetwork<Real>& network, PlanarState<Real>& state, double h) {
    const typename DashpotSweep<Real>::Points points{state.stride, state.inverseMass.data(), state.x.data(),
                                                     state.v.data()};
    sweep.before(network, points, h);
    sweep.between(points);
    sweep.after(network, points);
}

Model sheet(int cells, double tau) {
    return buildCloth({.size = {0.01 * cells, 0.01 * cells},
                       .cells = {cells, cells},
                       .material = {0.2, 400, 200, 5, tau, 0, Lumping::weighted}});
}

// Chunks side by side, and every instruction set.
TEST(DashpotSweep, GivesTheSameBitsForAnyThreadsAndInstructionSet) {
    const Model model = sheet(150, 1e-3);  // three chunks
    std::vector<float> first;
    const auto network = networkOf<float>(model);
    ASSERT_GT(network.chunks.size(), 2U);
    test::forEachInstructionSet([&] {
        for (int threads : {1, 2, 7}) {
            PlanarState<float> state(model);
            state.shake(1e-4, 0.5);
            DashpotSweep<float> sweep;
            core::ThreadLimit limit(threads);
            limit.run([&] { damp(sweep, network, state, 1e-4); });
            std::vector<float> v(state.v.begin(), state.v.end());
            if (first.empty()) first = v;
            EXPECT_EQ(v, first) << threads;
        }
    });
}

// However strong: momentum stays, energy only goes.
TEST(DashpotSweep, KeepsMomentumAndAddsNoEnergy) {
    RopeShape rope{.start = {0, 0, 0}, .end = {1, 0, 0}, .segments = 40};
    rope.dampingTime = 1e-2;
    for (const Model& model : {sheet(12, 1e-2), buildRope(rope)})
        for (double h : {1e-5, 1e-3}) {
            PlanarState<double> state(model);
            state.shake(1e-3, 1.0);
            const auto momentum = [&] {
                glm::dvec3 sum(0.0);
                for (int i = 0; i < state.count; ++i) sum += state.mass[i] * state.get(state.v, i);
                return sum;
            };
            const double energy = kineticEnergy(state);
            const glm::dvec3 before = momentum();
            DashpotSweep<double> sweep;
            damp(sweep, networkOf<double>(model), state, h);
            EXPECT_LT(kineticEnergy(state), energy) << model.pointCount() << " points, h = " << h;
            EXPECT_LT(glm::length(momentum() - before), 1e-12);
        }
}

// The longest wave along a rope of 40 springs, or of 300, which are of two blocks, held at one end, with dashpots that
// no explicit step would bear at this h: m x'' = -k (x + τ x') mode by mode, so that x = e^{-ζωt} (cos + ζ/√(1-ζ²)
// sin)(ω√(1-ζ²) t).
TEST(SplitLeapfrog, DampsALongWaveAsTheorySays) {
    for (const int n : {40, 300}) {
        constexpr double k = 1e4, m = 1e-2, tau = 0.02;
        const double fastest = 2 * std::sqrt(k / m),
                     h = 0.9 * 2 / fastest;  // τ ω = 40: explicitly h were 80 times shorter
        Model model;
        for (int i = 0; i <= n; ++i) taut::test::addPoint(model, {0.1 * i, 0, 0}, i == n ? m / 2 : m, i == 0);
        for (int i = 0; i < n; ++i) taut::test::addSpring(model, i, i + 1, k, 0.1, tau);
        const double q = std::acos(-1.0) / (2 * n), omega = fastest * std::sin(q / 2), zeta = 0.5 * tau * omega;
        for (int i = 0; i <= n; ++i) model.positions[i].x += 1e-3 * std::sin(q * i);
        taut::test::Network network(model, "leapfrog", h, {}, {.splits = true});
        const auto steps = static_cast<std::int64_t>(1.0 / (zeta * omega) / h);
        network.step(steps);
        const double t = static_cast<double>(steps) * h, root = std::sqrt(1 - zeta * zeta), phase = omega * root * t;
        const double ought = std::exp(-zeta * omega * t) * (std::cos(phase) + zeta / root * std::sin(phase));
        EXPECT_NEAR((network.position(n).x - 0.1 * n) / 1e-3, ought, 0.01) << n;
    }
}

}  // namespace
}  // namespace taut::mechanics
