// The bound of every tick against the one that is written down plainly.
#include "taut/mechanics/private/state_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics_planar_state.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/private/stability.h"

namespace taut::mechanics {
namespace {

using test::PlanarState;

Model stirred(Model model) {
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        const double s = static_cast<double>(i);
        model.positions[i] =
            1.1 * model.positions[i] + 0.01 * glm::dvec3(std::sin(3.1 * s), std::sin(5.3 * s), std::sin(7.7 * s));
    }
    return model;
}

template <class Real>
void expectBothAlike(const Model& model, double tolerance) {
    const PlanarState<Real> state(model);
    std::vector<double> inverseMasses;
    for (std::size_t i = 0; i < model.masses.size(); ++i)
        inverseMasses.push_back(model.held[i] ? 0.0 : 1.0 / model.masses[i]);
    const SpringNetwork<Real> network(
        state.count, std::vector<PointRange>{{0, model.grid[0] > 0 ? model.grid[0] + 1 : 0}}, model.springs);
    StateBound<Real> bound(state.count, state.stride);
    bound.setCells(model.cells, model.positions);
    const FastestNow now = bound(network, state.x.data(), state.inverseMass.data());
    const double plain = boundHere({model.springs, inverseMasses, model.cells}, {}, model.positions).omega;
    EXPECT_GE(now.omega2, plain * plain * (1 - tolerance));
    EXPECT_LE(now.omega2, plain * plain * (1 + 2e-4 + tolerance));  // of the polynomial, which is at most 1.3e-4 above

    std::vector<Spring> dashpots = model.springs;
    bool isUniform = true;
    for (Spring& spring : dashpots) {
        isUniform = isUniform && spring.dampingTime == model.springs[0].dampingTime;
        spring.stiffness *= spring.dampingTime;
        spring.restLength = glm::length(model.positions[spring.b] - model.positions[spring.a]);
    }
    const double damping = std::pow(boundHere({dashpots, inverseMasses}, {}, model.positions).omega, 2);
    // With cells its weights are those of springs and cells, with which it may lie below B2, but never below the
    // largest eigenvalue, of which Lanczos gives a lower bound.
    const double lowest = std::pow(leastFrequency(
                                       inverseMasses,
                                       [&](std::span<const glm::dvec3> u, std::span<glm::dvec3> out) {
                                           addSpringStiffness(dashpots, model.positions, u, out);
                                       },
                                       40),
                                   2);
    EXPECT_GE(now.damping, model.cells.empty() ? damping * (1 - tolerance) : lowest * (1 - tolerance));
    // Springs alike in τ are bounded with the transverse effect of their tension.
    EXPECT_LE(now.damping, damping * (isUniform ? 1.5 : 1 + 2e-4 + tolerance));
}

TEST(StateBound, IsThatOfTheDefinition) {
    Model cloth =
        buildCloth({.size = {1.0, 0.7}, .cells = {20, 14}, .material = {0.2, 400, 150, 3, 1e-4, 0, Lumping::weighted}});
    cloth.held[3] = true;
    Model block =
        buildBlock({.size = {0.3, 0.2, 0.2}, .cells = {3, 2, 2}, .young = 2e4, .bulk = 5e4, .dampingTime = 1e-3});
    Model mixed = cloth;
    for (std::size_t s = 0; s < mixed.springs.size(); s += 3) mixed.springs[s].dampingTime = 3e-4;
    for (const Model& model : {stirred(cloth), stirred(block), stirred(mixed)}) {
        expectBothAlike<double>(model, 1e-9);
        expectBothAlike<float>(model, 1e-4);  // skewnesses near ±1 lose half of the digits
    }
}

}  // namespace
}  // namespace taut::mechanics
