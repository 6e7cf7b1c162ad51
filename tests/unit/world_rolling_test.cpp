// Resistance against rolling and spinning of solids, against theory.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/timelines.h"
#include "taut/body/body.h"
#include "taut/island/private/island.h"
#include "taut/world/private/impl.h"
#include "unit/scene_support.h"

namespace taut::world::rolling {
namespace {

using support::g;
using support::run;

constexpr double radius = 0.05;

// A ball on a plane that rises by `slope` [-] towards x.
SceneSpec ballOn(double slope, const std::string& plane, const std::string& ball) {
    const double cosine = 1 / std::sqrt(1 + slope * slope), sine = slope * cosine;
    const auto text = [](double x) { return std::to_string(x); };
    return scene::loadSceneText(
               "schema = 1\n[run]\nfps = 100\nseconds = 10\n[solver]\nprecision = \"double\"\nsleep_error_m = 1e-4\n"
               "[collider.ground]\nshape = \"plane\"\nfriction = 0.5\nnormal = [" +
                   text(-sine) + ", " + text(cosine) + ", 0]\n" + plane +
                   "[solid.ball]\nshape = \"sphere\"\nradius = 0.05\nposition = [" + text(-radius * sine) + ", " +
                   text(radius * cosine) + ", 0]\n" + ball,
               "rolling.toml", {})
        .spec;
}

dvec3 centreOf(const World& world, const std::string& target = "solid.ball") {
    dvec3 sum(0.0);
    const std::vector<dvec3> x = world.points(target).x;
    for (const dvec3& own : x) sum += own;
    return sum / static_cast<double>(x.size());
}
bool isAsleep(World& world) {
    return WorldAccess::of(world).islands.front()->isAsleep();
}

// m a = F and I a/r = l m g - F r, so a ball slows by a = g l/r / (1 + 2/5), and stops after v²/(2 a).
TEST(Rolling, ABallStopsAfterTheDistanceOfTheory) {
    constexpr double length = 0.001, v = 0.5, a = g * length / radius / 1.4;
    for (const bool isOfBall : {true, false}) {  // the lengths of the two sides count alike
        const std::string key = "rolling_friction = 0.001\n",
                          moves = "velocity = [0.5, 0, 0]\nspin_rad_per_s = [0, 0, -10]\n";
        World world(ballOn(0, isOfBall ? "" : key, moves + (isOfBall ? key : "")));
        run(world, 100);
        EXPECT_NEAR(centreOf(world).x / (v - 0.5 * a), 1, 0.02);
        run(world, static_cast<int>(100 * v / a) - 100 + 100);
        EXPECT_NEAR(centreOf(world).x / (0.5 * v * v / a), 1, 0.02);
        EXPECT_TRUE(isAsleep(world));
    }
    World without(ballOn(0, "", "velocity = [0.5, 0, 0]\nspin_rad_per_s = [0, 0, -10]\n"));
    run(without, 400);
    EXPECT_NEAR(centreOf(without).x, 2.0, 0.01);
}

// On a slope it stays up to tan = l/r, and else rolls down by g (sin - l/r cos) / (1 + 2/5).
TEST(Rolling, ABallStaysOnASlopeBelowTheRatioOfLengthAndRadius) {
    constexpr double length = 0.005;
    for (const double slope : {0.08, 0.2}) {
        World world(ballOn(slope, "", "rolling_friction = 0.005\n"));
        const dvec3 start = centreOf(world);
        run(world, 100);
        const double way = glm::distance(centreOf(world), start), cosine = 1 / std::sqrt(1 + slope * slope);
        if (slope < length / radius) {
            EXPECT_LT(way, 1e-6);
            EXPECT_TRUE(isAsleep(world));
        } else {
            EXPECT_NEAR(way / (0.5 * g * cosine * (slope - length / radius) / 1.4), 1, 0.02);
        }
    }
}

// A cylinder on its side rests on a line, so only rolling friction keeps it: it stops at a = g l/r / (1 + 1/2).
TEST(Rolling, ACylinderOnItsSideComesToRestAndSleeps) {
    constexpr double a = g * 0.002 / radius / 1.5, v = 0.3;
    World world(
        scene::loadSceneText(
            "schema = 1\n[run]\nfps = 100\nseconds = 10\n[solver]\nprecision = \"double\"\nsleep_error_m = 1e-4\n"
            "[collider.ground]\nshape = \"plane\"\nfriction = 0.5\n"
            "[solid.ball]\nshape = \"cylinder\"\nradius = 0.05\nheight = 0.2\nrotation_deg = [90, 0, 0]\nposition = "
            "[0, 0.05, 0]\nvelocity = [0.3, 0, 0]\nspin_rad_per_s = [0, 0, -6]\nrolling_friction = 0.002\n",
            "rolling.toml", {})
            .spec);
    run(world, 200);
    EXPECT_NEAR(centreOf(world).x / (0.5 * v * v / a), 1, 0.02);
    EXPECT_TRUE(isAsleep(world));
}

// A ball that spins about the normal is slowed by s m g / (2/5 m r²), and stays where it is.
TEST(Rolling, ASpinningBallStopsAfterTheTimeOfTheory) {
    constexpr double slows = 0.001 * g / (0.4 * radius * radius), w = 20;
    World world(ballOn(0, "", "spin_rad_per_s = [0, 20, 0]\nspin_friction = 0.001\n"));
    const double start = world.metrics().angularMomentum.y;
    run(world, 100);
    EXPECT_NEAR(world.metrics().angularMomentum.y / start, 1 - slows / w, 0.02);
    run(world, static_cast<int>(100 * w / slows) - 100 + 100);
    EXPECT_NEAR(world.metrics().angularMomentum.y / start, 0, 1e-6);
    EXPECT_LT(glm::distance(centreOf(world), {0, radius, 0}), 1e-4);
}

// The torque is against the turn on the collider: on the axis of a turntable a ball comes to spin with it.
TEST(Rolling, ATurntableTakesABallAlong) {
    World world(
        scene::loadSceneText(
            "schema = 1\n[run]\nfps = 100\nseconds = 10\n[solver]\nprecision = \"double\"\n"
            "[collider.table]\nshape = \"box\"\nsize = [1, 0.2, 1]\nkeys = [{ t = 0, position = [0, -0.1, 0] }, "
            "{ t = 2, position = [0, -0.1, 0], rotation_deg = [0, 115, 0], ease = \"linear\" }]\n"
            "[solid.ball]\nshape = \"sphere\"\nradius = 0.05\nposition = [0, 0.05, 0]\nspin_friction = 0.001\n",
            "rolling.toml", {})
            .spec);
    run(world, 150);
    const double mass = 500 * 4 / 3.0 * 3.14159265358979 * radius * radius * radius;
    const double turn = 115 * 3.14159265358979 / 180 / 2;  // [rad/s]
    EXPECT_NEAR(world.metrics().angularMomentum.y / (0.4 * mass * radius * radius * turn), 1, 0.01);
}

}  // namespace
}  // namespace taut::world::rolling
