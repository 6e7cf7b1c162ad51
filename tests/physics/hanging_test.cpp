// Hanging bodies at rest: statics against theory, and the same shape at every resolution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/network.h"
#include "support/small_scenes.h"
#include "taut/bodies/rope.h"
#include "taut/forces/wind.h"
#include "taut/joints/joints.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/stability.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut::test::hanging {
namespace {

using mechanics::Model;

constexpr double g = 9.81;
const dvec3 gravity(0, -g, 0);

// Lets the model come to rest under strong drag, by leap-frog at a safe step; returns where it is when nothing moves
// faster than `stillness`.
std::vector<dvec3> atRest(Model model, double drag, double stillness) {
    std::vector<double> inverseMasses;
    for (std::size_t i = 0; i < model.masses.size(); ++i) {
        model.dragRates[i] = drag;
        inverseMasses.push_back(model.held[i] ? 0.0 : 1.0 / model.masses[i]);
    }
    const double h = 1.8 / mechanics::boundAnywhere({model.springs, inverseMasses}, {}).omega;
    Network network(model, "leapfrog", h, gravity);
    for (int i = 0; i < 4000; ++i) {
        network.step(100);
        double fastest = 0.0;
        for (const dvec3& v : network.velocities()) fastest = std::max(fastest, glm::length(v));
        if (fastest < stillness) return network.positions();
    }
    ADD_FAILURE() << "does not come to rest";
    return network.positions();
}

// A rope of n segments with half a segment's mass at either end stretches by MgL/2EA, exactly, for any n:
// Σ (tension of segment i) ℓ/EA, tension i = Mg (2(n - i) + 1)/2n.
TEST(HangingRope, StretchesUnderItsOwnWeightByTheTheoryAtEveryResolution) {
    constexpr double mass = 0.8, length = 3.0, ea = 400.0;
    for (int segments : {1, 4, 10, 25}) {
        Model rope = mechanics::buildRope(
            {.start = {1, 2, 3}, .end = {1, 2 - length, 3}, .segments = segments, .mass = mass, .stretch = ea});
        hold(rope, "start");
        const std::vector<dvec3> x = atRest(rope, 8.0, 1e-12);
        const double stretch = glm::length(x.back() - x.front()) - length;
        // At rest to 1e-12 m/s against springs and drag of 8/s: 1e-12 m or so.
        EXPECT_NEAR(stretch, mass * g * length / (2.0 * ea), 1e-9) << segments << " segments";
        // In the middle three quarters of it have come together.
        if (segments % 2 == 0)
            EXPECT_NEAR(x[x.size() / 2].y, 2 - 0.5 * length - 0.75 * stretch, 1e-9) << segments << " segments";
    }
}

// A light rope carries a heavy one by a pin; the step has their dashpots split off. These see no motion where nothing
// moves: the upper rope stretches by (M + m/2) g L/EA, the lower one by M g L/2EA, and both have no velocity.
TEST(HangingRope, CarriesAnotherByAPinWithTheTheorysStretchUnderStrongDashpots) {
    constexpr double light = 0.004, heavy = 0.4, ea = 100.0;
    world::SceneSpec scene;
    scene.solver.precision = world::Precision::double_;
    for (const bool isLower : {false, true}) {
        world::RopeSpec rope;
        rope.name = isLower ? "lower" : "upper";
        rope.start = {0, isLower ? 1 : 2, 0};
        rope.end = {0, isLower ? 0 : 1, 0};
        rope.segments = 4;
        rope.mass = isLower ? heavy : light;
        rope.stretch = ea;
        rope.dampingTime = 2e-3;
        rope.drag = 6.0;
        if (!isLower) rope.hold = {"start"};
        scene.bodies.add(rope);
    }
    world::WeldJoint pin = support::weld("rope.upper@end", "rope.lower@start");
    pin.name = "pin";
    scene.joints.add(pin);
    world::World world(scene);
    while (world.time() < 10.0) ASSERT_FALSE(world.advance());
    const auto upper = world.points("rope.upper"), lower = world.points("rope.lower");
    EXPECT_NEAR(upper.x.back().y, 1 - (heavy + light / 2) * g / ea, 1e-8);
    EXPECT_NEAR(lower.x.back().y, upper.x.back().y - 1 - heavy * g / (2 * ea), 1e-8);
    for (const dvec3& v : upper.v) EXPECT_LT(glm::length(v), 1e-6);
}

// In an even wind a rope hangs straight, at the angle θ where weight and drag across it are the same all along:
// μ g sin θ = ½ρ C_D d (U cos θ)². Nothing acts along it.
TEST(HangingRope, StandsStraightAndAslantInAWind) {
    constexpr double mass = 0.05, diameter = 0.02, speed = 6.0;
    world::SceneSpec spec;
    world::RopeSpec rope;
    rope.name = "line";
    rope.start = {0, 2, 0};
    rope.end = {0, 1, 0};
    rope.segments = 10;
    rope.mass = mass;
    rope.stretch = 500.0;
    rope.dampingTime = 1e-3;
    rope.drag = 1.0;
    rope.thickness = diameter / 2;
    rope.hold = {"start"};
    spec.bodies.add(rope);
    world::WindSpec wind;
    wind.name = "air";
    wind.velocity = {speed, 0, 0};
    wind.drag = 1.1;
    wind.on = {"rope.line"};
    spec.forces.add(wind);
    world::World world(spec);
    for (int i = 0; i < 600; ++i) ASSERT_FALSE(world.advance());
    const double ratio = 0.5 * 1.2 * 1.1 * diameter * speed * speed / (mass * g);
    const double sine = (std::sqrt(1.0 + 4.0 * ratio * ratio) - 1.0) / (2.0 * ratio);
    const std::vector<dvec3> x = world.points("rope.line").x;
    for (std::size_t i = 1; i < x.size(); ++i) {
        const dvec3 way = x[i] - x[0];
        EXPECT_NEAR(way.x / glm::length(way), sine, 1e-3) << i;  // it is a thousandth longer than at rest
    }
}

// A chain of n elastic links between two points on one level. H is the horizontal pull, V_i the vertical one in link i:
// link i has the tension T_i = √(H² + V_i²), the length l_i = L + T_i/k, and spans l_i H/T_i. Σ l_i H/T_i = span gives
// H.
struct Catenary {
    double span, restLength, stiffness, pointMass;
    int links;

    double vertical(int i) const { return pointMass * g * (0.5 * (links - 1) - i); }
    double tension(double pull, int i) const { return std::hypot(pull, vertical(i)); }
    double linkLength(double pull, int i) const { return restLength + tension(pull, i) / stiffness; }
    double spanAt(double pull) const {
        double sum = 0.0;
        for (int i = 0; i < links; ++i) sum += linkLength(pull, i) * pull / tension(pull, i);
        return sum;
    }
    std::vector<dvec3> points() const {
        double low = 1e-9, high = 1e6;
        for (int i = 0; i < 200; ++i) {
            const double middle = 0.5 * (low + high);
            (spanAt(middle) < span ? low : high) = middle;
        }
        std::vector<dvec3> x{dvec3(0.0)};
        for (int i = 0; i < links; ++i)
            x.push_back(x.back() + linkLength(low, i) / tension(low, i) * dvec3(low, -vertical(i), 0));
        return x;
    }
};

TEST(HangingRope, BetweenTwoPointsIsTheElasticDiscreteCatenary) {
    for (double length : {1.3, 1.0, 0.9})  // slack, just long enough, taut
        for (int segments : {8, 15}) {
            SCOPED_TRACE("length " + std::to_string(length) + ", segments " + std::to_string(segments));
            constexpr double mass = 0.5, ea = 60.0;
            const double link = length / segments;
            Model rope = mechanics::buildRope({.start = {0, 0, 0},
                                               .end = {1, 0, 0},
                                               .segments = segments,
                                               .length = length,
                                               .mass = mass,
                                               .stretch = ea});
            hold(rope, "ends");
            const std::vector<dvec3> x = atRest(rope, 6.0, 1e-11);
            const std::vector<dvec3> ought = Catenary{1.0, link, ea / link, mass / segments, segments}.points();
            ASSERT_EQ(x.size(), ought.size());
            for (std::size_t i = 0; i < x.size(); ++i)
                EXPECT_LT(glm::length(x[i] - ought[i]), 1e-8) << "point " << i;  // at rest to 1e-11 m/s
            EXPECT_NEAR(glm::length(ought.back() - dvec3(1, 0, 0)), 0.0, 1e-9);
        }
}

double lowest(const std::vector<dvec3>& x) {
    double y = HUGE_VAL;
    for (const dvec3& p : x) y = std::min(y, p.y);
    return y;
}

// The chain of n links differs from the smooth curve by a share 1/n²: the sag at 2n is off by a quarter of that at n.
TEST(Refinement, KeepsTheSagOfARope) {
    double sag[3];
    for (int i = 0; i < 3; ++i) {
        Model rope = mechanics::buildRope(
            {.start = {0, 0, 0}, .end = {2, 0, 0}, .segments = 10 << i, .length = 2.2, .mass = 0.4, .stretch = 80.0});
        hold(rope, "ends");
        sag[i] = -lowest(atRest(rope, 4.0, 1e-9));
    }
    EXPECT_NEAR(sag[1] / sag[0], 1.0, 0.01);
    EXPECT_NEAR(sag[2] / sag[1], 1.0, 0.0025);
    // Second order, give or take the term 1/n⁴: 2 ± 0.1.
    EXPECT_NEAR(std::log2((sag[1] - sag[0]) / (sag[2] - sag[1])), 2.0, 0.1);
}

Model sheet(int cells) {
    return mechanics::buildCloth({.size = {0.8, 0.8},
                                  .cells = {cells, cells},
                                  .material = {0.5, 40.0, 20.0, 0.0, 0.0, 0.0, mechanics::Lumping::weighted}});
}

// Held along its top, a cloth is a membrane under its own weight. Free to narrow, its lower edge sinks by nearly
// ρgL²/2E with E = ks + kd - kd²/(ks + kd) = 53.3 N/m: 29 mm; the held edge takes some of that. k does not depend on
// the number of cells, so the same comes out, up to a share that falls with the cell.
TEST(Refinement, KeepsTheStretchOfAHangingCloth) {
    double stretch[3];
    for (int i = 0; i < 3; ++i) {
        Model cloth = sheet(4 << i);
        hold(cloth, "top");
        const std::vector<dvec3> x = atRest(cloth, 5.0, 1e-8);
        stretch[i] = -x[x.size() - 1 - static_cast<std::size_t>(2 << i)].y - 0.8;  // middle of the lower edge
    }
    EXPECT_NEAR(stretch[2], 0.5 * g * 0.8 * 0.8 / (2.0 * 53.33), 0.08 * stretch[2]);
    EXPECT_NEAR(stretch[1] / stretch[0], 1.0, 0.03);
    EXPECT_NEAR(stretch[2] / stretch[1], 1.0, 0.015);
    EXPECT_LT(std::abs(stretch[2] - stretch[1]), 0.7 * std::abs(stretch[1] - stretch[0]));  // and it converges
}

// Held at its four edges and level, a cloth sags like a drum that stretches as it goes.
TEST(Refinement, KeepsTheSagOfAClothHeldAllAround) {
    double sag[3];
    for (int i = 0; i < 3; ++i) {
        Model cloth = sheet(4 << i);
        for (dvec3& x : cloth.positions) x = {x.x, 0.0, x.y};
        hold(cloth, "edges");
        sag[i] = -lowest(atRest(cloth, 5.0, 1e-8));
    }
    EXPECT_GT(sag[2], 0.05);
    EXPECT_NEAR(sag[1] / sag[0], 1.0, 0.05);
    EXPECT_NEAR(sag[2] / sag[1], 1.0, 0.0125);
    // Order 1 to 2, as for sagging cloth in general: the changes fall by 2 to 4.
    const double fall = (sag[1] - sag[0]) / (sag[2] - sag[1]);
    EXPECT_GT(fall, 1.8);
    EXPECT_LT(fall, 4.8);
}

}  // namespace
}  // namespace taut::test::hanging
