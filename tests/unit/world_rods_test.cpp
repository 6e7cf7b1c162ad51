// Rods against theory: pendulums, invariants of a free pair, chains and trusses, places on colliders, contact.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/timelines.h"
#include "taut/bodies/net.h"
#include "taut/ode/method_table.h"
#include "taut/world/components.h"
#include "unit/scene_support.h"

namespace taut::world::rods {
namespace {

using support::g;
using support::run;

SceneSpec sceneOf(const std::string& text) {
    return scene::loadSceneText(text, "rods.toml", {}).spec;
}

std::string head(const std::string& method, const std::string& dt, const std::string& precision = "double") {
    return "schema = 1\n[run]\nfps = 100\nseconds = 1\n[solver]\nintegrator = \"" + method + "\"\ndt = " + dt +
           "\nprecision = \"" + precision + "\"\n";
}

std::string rod(const std::string& a, const std::string& b) {
    return "[[joint]]\na = \"" + a + "\"\nb = \"" + b + "\"\nkind = \"rod\"\n";
}

// Points hanging at angles from the one above, the first held at the origin; no springs.
std::string pendulum(std::span<const double> angles, std::span<const double> lengths, std::span<const double> masses) {
    std::string points = "{ name = \"p0\", position = [0, 0, 0], hold = true }", rods;
    double x = 0, y = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        x += lengths[i] * std::sin(angles[i]);
        y -= lengths[i] * std::cos(angles[i]);
        char text[200];
        std::snprintf(text, sizeof text, ", { name = \"p%zu\", position = [%.17g, %.17g, 0], mass_kg = %.17g }", i + 1,
                      x, y, masses[i]);
        points += text;
        rods += rod("net.n@p" + std::to_string(i), "net.n@p" + std::to_string(i + 1));
    }
    return "[net.n]\npoints = [" + points + "]\ndrag_per_s = 0\n" + rods;
}

double lengthOf(const dvec3& d) {
    return std::sqrt(glm::dot(d, d));
}

TEST(Rods, APendulumKeepsItsEnergyForAHundredPeriods) {
    const double angle[] = {1.0}, length[] = {0.25}, mass[] = {2.0};
    World world(sceneOf(head("leapfrog", "0.002") + pendulum(angle, length, mass)));
    const double start = world.metrics().energy(), swing = 2.0 * g * 0.25 * (1 - std::cos(1.0));
    double most = 0, strain = 0;
    // 1.07 s a period at that angle.
    for (int tick = 0; tick < 107 * 100; ++tick) {
        run(world, 1);
        const Metrics now = world.metrics();
        most = std::max(most, std::abs(now.energy() - start) / swing);
        strain = std::max(strain, now.maxStrain);
    }
    EXPECT_LT(most, 1e-4) << most;       // measured 4.8e-5, (ω h)²/8 of it; it goes on as it is
    EXPECT_LT(strain, 1e-12) << strain;  // to which they are solved: 1e-13, and rounding
}

// θ1, θ2, ω1, ω2 of two masses on rods without mass.
using Angles = std::array<double, 4>;
struct DoublePendulum {
    double m1, m2, l1, l2;
    Angles slope(const Angles& y) const {
        const double d = y[0] - y[1], m = m1 + m2, s = std::sin(d), c = std::cos(d), q = m1 + m2 * s * s;
        const double w1 = y[2] * y[2], w2 = y[3] * y[3];
        return {y[2], y[3],
                (-m2 * l1 * w1 * s * c + m2 * g * std::sin(y[1]) * c - m2 * l2 * w2 * s - m * g * std::sin(y[0])) /
                    (l1 * q),
                (m2 * l2 * w2 * s * c + m * (g * std::sin(y[0]) * c + l1 * w1 * s - g * std::sin(y[1]))) / (l2 * q)};
    }
    // By RK4.
    Angles after(Angles y, double seconds, int steps) const {
        const double h = seconds / steps;
        const auto moved = [&](const Angles& k, double by) {
            Angles at = y;
            for (std::size_t i = 0; i < 4; ++i) at[i] += by * k[i];
            return at;
        };
        for (int n = 0; n < steps; ++n) {
            const Angles a = slope(y), b = slope(moved(a, h / 2)), c = slope(moved(b, h / 2)), d = slope(moved(c, h));
            for (std::size_t i = 0; i < 4; ++i) y[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        }
        return y;
    }
    dvec3 end(const Angles& y) const {
        return {l1 * std::sin(y[0]) + l2 * std::sin(y[1]), -l1 * std::cos(y[0]) - l2 * std::cos(y[1]), 0};
    }
};

double errorOfDoublePendulum(const std::string& method, const std::string& dt, double seconds) {
    const double angles[] = {1.0, 1.6}, lengths[] = {0.6, 0.4}, masses[] = {1.0, 0.7};
    const DoublePendulum exact{1.0, 0.7, 0.6, 0.4};
    World world(sceneOf(head(method, dt) + pendulum(angles, lengths, masses)));
    run(world, static_cast<int>(std::lround(seconds * 100)));
    return lengthOf(world.points("net.n@p2").x[0] - exact.end(exact.after({1.0, 1.6, 0, 0}, seconds, 200000)));
}

TEST(Rods, ADoublePendulumFollowsItsEquations) {
    const double error = errorOfDoublePendulum("leapfrog", "0.001", 2.0);
    EXPECT_LT(error, 2e-5) << error;  // measured 9e-6 m, of the 1 m that it is long
}

// Halved steps leave a quarter of the error.
TEST(Rods, LeapfrogAndVerletKeepTheirOrder) {
    for (const char* method : {"leapfrog", "velocity-verlet"}) {
        const double ratio = errorOfDoublePendulum(method, "0.005", 1.0) / errorOfDoublePendulum(method, "0.0025", 1.0);
        EXPECT_GT(ratio, 3.5) << method;
        EXPECT_LT(ratio, 4.5) << method;
    }
}

TEST(Rods, EveryMethodKeepsLengthAndMomentaOfAFreePair) {
    for (const ode::MethodInfo& method : ode::builtInMethods().all())
        for (const bool isDouble : {true, false}) {
            const std::string name(method.name);
            SceneSpec scene = sceneOf(head(name, "0.001", isDouble ? "double" : "single") +
                                      "[world]\ngravity = [0, 0, 0]\n[net.n]\ndrag_per_s = 0\nspin_rad_per_s = [1, 2, "
                                      "3]\nvelocity = [0.3, 0, 0]\npoints = [{ name = \"a\", position = [0, 1, 0], "
                                      "mass_kg = 2 }, { name = \"b\", position = [0.5, 1.2, 0] }]\n" +
                                      rod("net.n@a", "net.n@b"));
            World world(scene);
            const Metrics before = world.metrics();
            run(world, 50);
            const Metrics after = world.metrics();
            const double rounding = isDouble ? 1e-11 : 5e-3;  // 500 steps, of places over h: 1e-16 / 1e-3 each; 1e-7
            EXPECT_LT(after.maxStrain, isDouble ? 1e-12 : 1e-6) << name;
            EXPECT_LT(lengthOf(after.momentum - before.momentum), rounding) << name;
            EXPECT_LT(lengthOf(after.angularMomentum - before.angularMomentum), rounding) << name;
        }
}

// Coupled to the end: fifty rods between held points, and all six bars and both diagonals of squares.
TEST(Rods, ChainsAndTrussesHold) {
    std::string points, chain;
    for (int i = 0; i <= 50; ++i) {
        const std::string n = std::to_string(i), y = i % 2 == 0 ? "0" : "-0.05";
        points += "{ name = \"p" + n + "\", position = [" + std::to_string(0.1 * i) + ", " + y + ", 0]" +
                  (i % 50 == 0 ? ", hold = true" : "") + " }, ";
        if (i > 0) chain += rod("net.c@p" + std::to_string(i - 1), "net.c@p" + n);
    }
    World world(sceneOf(head("leapfrog", "0.001") + "[net.c]\npoints = [" + points + "]\n" + chain +
                        "[net.t]\nspin_rad_per_s = [0, 0, 2]\npoints = [{ name = \"a\", position = [0, 3, 0] }, { name "
                        "= \"b\", position = [1, 3, 0] }, { name = \"c\", position = [1, 4, 0] }, { name = \"d\", "
                        "position = [0, 4, 0] }]\n" +
                        rod("net.t@a", "net.t@b") + rod("net.t@b", "net.t@c") + rod("net.t@c", "net.t@d") +
                        rod("net.t@d", "net.t@a") + rod("net.t@a", "net.t@c") + rod("net.t@b", "net.t@d")));
    for (int tick = 0; tick < 50; ++tick) {
        run(world, 1);
        ASSERT_LT(world.metrics().maxStrain, 1e-11) << tick;
    }
    EXPECT_EQ(world.islands()[0].constraints, 50);
    EXPECT_EQ(world.islands()[1].constraints, 6);
}

const std::string swing =
    "[net.n]\ndrag_per_s = 0\npoints = [{ name = \"a\", position = [0, -1, 0] }, { name = \"b\", position = [0.4, "
    "-1.2, 0], mass_kg = 2 }]\n" +
    rod("net.n@a", "net.n@b") + rod("collider.arm", "net.n@a") + "place = [0.3, 0, 0]\n";

// It moves and turns about z: the place goes where the collider has it.
TEST(Rods, AColliderLeadsThePlaceOfARod) {
    World world(sceneOf(head("leapfrog", "0.001") +
                        "[collider.arm]\nshape = \"sphere\"\nradius = 0.01\nkeys = [{ t = 0, position = [0, 0, 0] }, "
                        "{ t = 1, position = [1, 0, 0], rotation_deg = [0, 0, 90] }]\n" +
                        swing));
    EXPECT_EQ(world.joints()[1].kind, "rod");
    for (int tick = 0; tick < 100; ++tick) {
        run(world, 1);
        ASSERT_LT(world.metrics().maxStrain, 1e-12) << tick;
    }
    // The place at 1 s: (1, 0, 0) + 0.3 m along y; the rod is as long as it was.
    EXPECT_NEAR(lengthOf(world.points("net.n@a").x[0] - dvec3(1, 0.3, 0)), std::sqrt(0.3 * 0.3 + 1), 1e-12);
}

TEST(Rods, AreSavedCutAndLetGo) {
    const std::string text = head("leapfrog", "0.001") +
                             "[collider.arm]\nshape = \"sphere\"\nradius = 0.01\nkeys = [{ t = 0, position = [0, 0, "
                             "0] }, { t = 1, position = [0, 0.5, 0] }]\n" +
                             swing;
    SceneSpec scene = sceneOf(text);
    auto cut = support::action<CutAction>(0.2, "net.n");
    cut.planePoint = dvec3(0.2, -1, 0);
    cut.planeNormal = dvec3(1, 0, 0);
    scene.actions = {cut};
    World world(scene);
    EXPECT_EQ(world.islands()[0].constraints, 2);
    for (const int ticks : {10, 20}) {  // before the cut and after it
        run(world, ticks);
        World other(scene);
        other.restore(world.save());
        EXPECT_EQ(other.metrics().kinetic, world.metrics().kinetic);
        run(world, 2);
        run(other, 2);
        EXPECT_EQ(other.save(), world.save());
    }
    EXPECT_EQ(world.islands()[0].constraints, 1);
    EXPECT_LT(world.points("net.n@b").v[0].y, -0.05);  // it falls alone
    world.registry().each<Identity>([&](ecs::Entity entity, const Identity& identity) {
        if (identity.fullName() == "collider.arm") world.destroy(entity);
    });
    run(world, 1);
    EXPECT_EQ(world.islands()[0].constraints, 0);
}

// Ends lie on a floor, and on cloth that touches: the distance is kept all the same.
TEST(Rods, HoldInContact) {
    World world(sceneOf(head("leapfrog", "0.001") +
                        "[collider.floor]\nshape = \"plane\"\n[net.n]\ntouch = \"others\"\npoints = [{ name = \"a\", "
                        "position = [0, 0.3, 0] }, { name = \"b\", position = [0.5, 0.5, 0] }]\nsprings = [{ a = "
                        "\"a\", b = \"b\", stiffness_N_per_m = 1 }]\n[rope.r]\nstretch_N = 200\nsegments = 4\nends = "
                        "[[0.25, 0.2, -0.5], [0.25, 0.2, "
                        "0.5]]\nhold = [\"ends\"]\ntouch = \"others\"\n" +
                        rod("net.n@a", "net.n@b")));
    int pressed = 0, contacts = 0;
    for (int tick = 0; tick < 200; ++tick) {
        run(world, 1);
        pressed += world.metrics().bodyContacts;
        contacts += world.metrics("net.n").contacts;
        const PointsNow net = world.points("net.n");
        ASSERT_NEAR(lengthOf(net.x[1] - net.x[0]), std::sqrt(0.29), 1e-12) << tick;
    }
    EXPECT_GT(pressed, 0);
    EXPECT_GT(contacts, 0);
    EXPECT_LT(world.metrics("net.n").kinetic, 0.05);  // it lies there
}

TEST(Rods, OtherKeysAreRefusedByName) {
    const scene::AssetFolder folder;
    const std::string two =
        "schema = 1\n[net.n]\npoints = [{ name = \"a\", position = [0, 0, 0] }, { name = \"b\", position = [0, 0, 0] "
        "}]\n";
    const std::string reach = folder.messageOf(two + rod("net.n@a", "net.n@b") + "reach_m = 1\n");
    EXPECT_NE(reach.find("reach_m does not go with a rod\n"), std::string::npos) << reach;
    const std::string place = folder.messageOf(two + rod("net.n@a", "net.n@b") + "place = [0, 0, 0]\n");
    EXPECT_NE(place.find("place is on a side that is a whole solid or a collider"), std::string::npos) << place;
    try {
        World{sceneOf(two + rod("net.n@a", "net.n@b"))};
        ADD_FAILURE() << "was made";
    } catch (const core::Error& error) {
        EXPECT_NE(std::string(error.what())
                      .find("rods.toml:4:1: error: a rod has both ends in one place; move them "
                            "apart, or use kind = \"weld\""),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace taut::world::rods
