#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include "mechanics_planar_state.h"
#include "taut/mechanics/bending.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/private/grid_bending.h"
#include "taut/mechanics/private/grid_friction.h"
#include "taut/ode/method_table.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using test::PlanarState;

constexpr int rubbingColumns = 6, rubbingRows = 4;
constexpr double rubbingAcross = 0.02, rubbingDown = 0.03;  // [m]

// M_y = 1e-3 N at 5 /m.
BendingFriction rubbing() {
    return {gridBending(rubbingColumns, rubbingRows, {2e-4, 2e-4, 0, 0}, rubbingAcross, rubbingDown),
            5.0,
            {rubbingAcross, rubbingDown},
            {0, 0, -1}};
}

std::vector<int> rubbingPoints() {
    std::vector<int> points(rubbingColumns * rubbingRows);
    std::iota(points.begin(), points.end(), 0);
    return points;
}

PlanarState<double> rubbingSheet() {
    std::vector<dvec3> x;
    for (int i = 0; i < rubbingColumns * rubbingRows; ++i)
        x.emplace_back(rubbingAcross * (i % rubbingColumns), -rubbingDown * (i / rubbingColumns), 0);
    return {x, std::vector<double>(x.size(), 1.0)};
}

// Between two slides the force has a potential, which it shows where nothing slips: a slipping thread pulls and stores
// no more. Where points are moved by a cell some normals hardly exist. Directions are held at an edge, and inside on
// each side of a point.
TEST(GridFriction, ForcesAreTheSlopeOfWhatStuckFoldsStore) {
    BendingFriction friction = rubbing();
    friction.yield = 1e6;
    std::vector<bool> isHeld(rubbingPoints().size(), false);
    std::vector<dvec3> rest;
    for (int i = 0; i < rubbingColumns * rubbingRows; ++i) {
        isHeld[i] = i % rubbingColumns == 0 || i == 9;
        rest.push_back(rubbingSheet().get(rubbingSheet().x, i));
    }
    friction.stuck = clamped(friction.stuck, isHeld, isHeld, rest);
    ASSERT_EQ(friction.stuck.clamps.size(), 4U + 4U);
    std::vector<double> sliders(GridFriction<double>::sliderCount(friction, true));
    for (std::size_t i = 0; i < sliders.size(); ++i) sliders[i] = 1e-4 * static_cast<double>(i % 7);  // [m]
    const GridFriction<double> generator(friction, rubbingPoints(), sliders);
    for (const double size : {0.002, 0.02}) {
        PlanarState<double> state = rubbingSheet();
        state.shake(size, 0.0);
        const std::vector<dvec3> forces = state.forces(generator);
        double largest = 0;
        for (const dvec3& f : forces) largest = std::max(largest, glm::length(f));
        constexpr double h = 1e-7;  // [m]; the energy's third derivative over its first is about 1/(5 mm)²
        for (int i = 0; i < rubbingColumns * rubbingRows; ++i)
            for (int axis = 0; axis < 3 && !isHeld[i]; ++axis) {
                PlanarState<double> moved = state;
                moved.x[moved.index(i, axis)] += h;
                const double more = generator.potentialEnergy(moved.motion());
                moved.x[moved.index(i, axis)] -= 2 * h;
                const double slope = (more - generator.potentialEnergy(moved.motion())) / (2 * h);
                EXPECT_NEAR(forces[i][axis], -slope, 1e-7 * largest) << size << " at " << i;
            }
    }
}

TEST(GridFriction, HasNeitherASumNorATorqueHoweverTheSheetLies) {
    std::vector<double> sliders(GridFriction<double>::sliderCount(rubbing(), false));
    GridFriction<double> generator(rubbing(), rubbingPoints(), sliders);
    PlanarState<double> state = rubbingSheet();
    for (const double size : {1e-4, 0.002, 0.02}) {  // [m]
        state.shake(size, 0.0);
        generator.slide(state.motion());
        state.shake(0.2 * size, 0.0);
        dvec3 sum(0.0), torque(0.0);
        double largest = 0;
        const std::vector<dvec3> forces = state.forces(generator);
        for (int i = 0; i < rubbingColumns * rubbingRows; ++i) {
            const dvec3 f = forces[i];
            sum += f;
            torque += glm::cross(state.get(state.x, i), f);
            largest = std::max(largest, glm::length(f));
        }
        // Rounding of some hundred terms of that size, 0.1 m from the origin.
        EXPECT_LT(glm::length(sum), 1e-13 * largest) << size;
        EXPECT_LT(glm::length(torque), 1e-14 * largest) << size;
    }
}

// So the result does not depend on when in a step, or how often, sliders follow.
TEST(GridFriction, SlidingChangesNoForceAndIsDoneAtOnce) {
    std::vector<double> sliders(GridFriction<double>::sliderCount(rubbing(), false));
    GridFriction<double> generator(rubbing(), rubbingPoints(), sliders);
    PlanarState<double> state = rubbingSheet();
    state.shake(0.002, 0.0);
    const std::vector<dvec3> before = state.forces(generator);
    const double stored = generator.potentialEnergy(state.motion());
    generator.slide(state.motion());
    const std::vector<dvec3> after = state.forces(generator);
    double largest = 0, change = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        largest = std::max(largest, glm::length(before[i]));
        change = std::max(change, glm::length(after[i] - before[i]));
    }
    EXPECT_LT(change, 1e-13 * largest);
    EXPECT_NEAR(generator.potentialEnergy(state.motion()), stored, 1e-13 * stored);
    EXPECT_GT(*std::max_element(sliders.begin(), sliders.end()), 0);
}

// A strip whose sheet rubs: cells along it, its moment of friction over its rigidity, which is the curvature that
// stays.
struct CreasedStrip {
    static constexpr double cell = 1e-3, rigidity = 1e-5, crease = 50;  // [m], [N m], [1/m]

    Model model;
    std::vector<double> sliders;
    std::unique_ptr<MassSpringSystem<double>> system;
    GridFriction<double>* friction = nullptr;  // of the system
    std::unique_ptr<ode::Method<double>> method = ode::builtInMethods().make<double>("leapfrog");
    ode::State<double> state;

    CreasedStrip(int cells, double dragRate) {
        model = buildCloth({.down = {0, 0, 1},
                            .size = {cells * cell, cell},
                            .cells = {cells, 1},
                            .material = {.stretch = 100,
                                         .shear = 20,
                                         .bend = 0,
                                         .dragRate = dragRate,
                                         .rigidity = {rigidity, rigidity, 0, 2 * rigidity},
                                         .frictionMoment = rigidity * crease,
                                         .frictionYield = 0.1 * crease}});
        system = std::make_unique<MassSpringSystem<double>>(model);
        std::vector<int> points(model.positions.size());
        std::iota(points.begin(), points.end(), 0);
        sliders.resize(GridFriction<double>::sliderCount(model.friction, false));
        system->add(std::make_unique<GridBending<double>>(model.bending, points));
        auto rubbing = std::make_unique<GridFriction<double>>(model.friction, points, sliders);
        friction = rubbing.get();
        system->add(std::move(rubbing));
        state = ode::State<double>(system->layout());
    }
    std::size_t index(std::size_t i, int axis) const {
        return static_cast<std::size_t>(axis * state.layout.stride) + i;
    }
    dvec3 get(const core::AlignedArray<double>& of, std::size_t i) const {
        return {of[index(i, 0)], of[index(i, 1)], of[index(i, 2)]};
    }
    // Every point at place(point as it is flat).
    template <class Place>
    void lay(const Place& place) {
        for (std::size_t i = 0; i < model.positions.size(); ++i) {
            const dvec3 x = place(model.positions[i]);
            for (int axis = 0; axis < 3; ++axis) state.x[index(i, axis)] = x[axis];
        }
        friction->slide(system->motion(0, state.x.data(), state.v.data()));
    }
    static dvec3 onCircle(const dvec3& x, double bent) {
        return {std::sin(bent * x.x) / bent, (1 - std::cos(bent * x.x)) / bent, x.z};
    }
    void run(int steps, double h) {
        method->start(*system, 0, h, state);
        for (int i = 0; i < steps; ++i) {
            friction->slide(system->motion(0, state.x.data(), state.v.data()));
            method->step(*system, 0, h, state);
        }
    }
    // Of the fold in the middle of the upper edge [1/m].
    double curvature() const {
        const auto i = static_cast<std::size_t>(model.grid[0] / 2);
        return glm::length(get(state.x, i - 1) - 2.0 * get(state.x, i) + get(state.x, i + 1)) / (cell * cell);
    }
};

// Bent to 150 /m, released in thick air: B κ is held by friction. A slider that were kept in space would have turned
// it.
TEST(GridFriction, AStripKeepsItsCreaseAlsoIfItIsTurnedByAQuarterBeforeItIsLetGo) {
    constexpr double step = 2e-6;  // [s]
    std::vector<double> kept;
    for (const bool turns : {false, true}) {
        CreasedStrip strip(10, 4e4);  // a free strip of 10 mm swings at 22.4 √(B/ρL⁴) = 1580 /s
        strip.lay([](const dvec3& x) { return CreasedStrip::onCircle(x, 150); });
        if (turns)
            strip.lay([](const dvec3& x) {
                const dvec3 y = CreasedStrip::onCircle(x, 150);
                return dvec3(0.6 * y.x + 0.8 * y.z, 0.8 * y.x - 0.6 * y.z, y.y);  // and its plane stands elsewhere
            });
        strip.run(100000, step);  // seven times as long as its slowest motion takes
        kept.push_back(strip.curvature());
        // Folds of an angle θ have 2 sin(θ/2)/a = κ in equilibrium, for any θ.
        EXPECT_NEAR(kept.back(), CreasedStrip::crease, 0.002 * CreasedStrip::crease) << (turns ? "turned" : "as bent");
    }
    EXPECT_NEAR(kept[1], kept[0], 1e-9 * kept[0]);  // rounding alone tells them apart
}

// Nothing but its own forces acts on it; folds stick, slip and turn with it.
TEST(GridFriction, ACreasedStripThatSpinsKeepsItsMomentumAndAngularMomentumForAMillionSteps) {
    CreasedStrip strip(4, 0);
    strip.lay([](const dvec3& x) { return CreasedStrip::onCircle(x, 60); });
    double mass = 0;
    for (std::size_t i = 0; i < strip.model.masses.size(); ++i) {
        const dvec3 v = dvec3(0.01, 0.02, -0.01) + glm::cross(dvec3(20, 10, 30), strip.get(strip.state.x, i));  // [m/s]
        for (int axis = 0; axis < 3; ++axis) strip.state.v[strip.index(i, axis)] = v[axis];
        mass += strip.model.masses[i];
    }
    const auto moments = [&] {
        dvec3 p(0.0), l(0.0), centre(0.0);
        for (std::size_t i = 0; i < strip.model.masses.size(); ++i) {
            const dvec3 x = strip.get(strip.state.x, i), mv = strip.model.masses[i] * strip.get(strip.state.v, i);
            p += mv;
            l += glm::cross(x, mv);
            centre += strip.model.masses[i] / mass * x;
        }
        return std::array{p, l - glm::cross(centre, p)};
    };
    strip.run(1, 2e-6);
    const auto [p, l] = moments();
    strip.run(1'000'000, 2e-6);
    const auto [pEnd, lEnd] = moments();
    EXPECT_GT(strip.curvature(), 0.2 * CreasedStrip::crease) << "it is no longer creased";
    // A rounding of 1e-16 in each of a million steps, in no direction.
    EXPECT_LT(glm::length(pEnd - p), 1e-12 * glm::length(p));
    // At its end, 50 mm away, places are rounded by 3.5e-18 m, which is 2e-15 of arms up to 2 mm: in a million steps,
    // in no direction, 2e-12, over the root of ten points; three of these.
    EXPECT_LT(glm::length(lEnd - l), 2e-12 * glm::length(l));
}

}  // namespace
}  // namespace taut::mechanics
