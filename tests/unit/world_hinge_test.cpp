// Places on solids by name and by numbers, and joints at them: welds, rods, ball joints and hinges against theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/timelines.h"
#include "taut/world/world.h"
#include "unit/scene_support.h"
#include "unit/world_places.h"

namespace taut::world::hinges {
namespace {

using support::run;

constexpr double g = 9.81, pi = 3.14159265358979323846;

SceneSpec sceneOf(const std::string& text) {
    return scene::loadSceneText(text, "hinge.toml", {}).spec;
}

std::string head(const std::string& gravity, const std::string& solver = "") {
    return "schema = 1\n[run]\nfps = 100\nseconds = 10\n[solver]\nprecision = \"double\"\n" + solver +
           "[world]\ngravity = " + gravity + "\n";
}

const std::string post = "[collider.post]\nshape = \"sphere\"\nradius = 0.01\nposition = [0, 2, 0]\n";

// A rod of 1 m that hangs from its upper end, turned by `degrees` about z.
std::string link(const std::string& name, double degrees, const std::string& more = "") {
    const double a = degrees * pi / 180;
    return "[solid." + name +
           "]\nshape = \"box\"\nsize = [0.02, 1, 0.02]\nthickness = 1e-9\ndrag_per_s = "
           "0\nrotation_deg = [0, 0, " +
           std::to_string(degrees) + "]\nposition = [" + std::to_string(0.5 * std::sin(a)) + ", " +
           std::to_string(2 - 0.5 * std::cos(a)) + ", 0]\n" + more;
}

std::string hinge(const std::string& a, const std::string& b, const std::string& more = "") {
    return "[[joint]]\na = \"" + a + "\"\nb = \"" + b + "\"\nkind = \"hinge\"\n" + more;
}

// Complete elliptic integral of the first kind by the arithmetic-geometric mean.
double ellipticK(double k) {
    double a = 1, b = std::sqrt(1 - k * k);
    while (std::abs(a - b) > 1e-15) std::tie(a, b) = std::pair(0.5 * (a + b), std::sqrt(a * b));
    return pi / (2 * a);
}

// A box of w, h, w that swings about its upper end has I = m (w² + h²)/12 + m h²/4, and a period of
// 4 sqrt(I / (m g h/2)) K(sin(θ0/2)). Released at 60° it is back there after one period.
TEST(Hinge, APendulumHasThePeriodOfTheEllipticIntegral) {
    const double period =
        4 * std::sqrt((0.02 * 0.02 + 1) / 12 + 0.25) / std::sqrt(0.5 * g) * ellipticK(std::sin(pi / 6));
    World world(sceneOf(head("[0, -9.81, 0]") + post + link("bob", 60) +
                        hinge("solid.bob", "collider.post", "place = [0, 0.5, 0]\naxis = [0, 0, 1]\n")));
    const auto angle = [&] {
        const dvec3 d = middle(world, "solid.bob@top") - middle(world, "solid.bob@bottom");
        return std::atan2(-d.x, d.y);
    };
    const double energy = world.metrics().energy();
    double crossed = 0, before = angle(), opening = 0;  // [s] third passage through the lowest place: 5/4 periods
    int passages = 0;
    while (passages < 3) {
        run(world, 1);
        const double now = angle();
        if (now * before < 0 && ++passages == 3) crossed = world.time() - 0.01 * now / (now - before);
        before = now;
        const dvec3 top = middle(world, "solid.bob@top") - dvec3(0, 2, 0);
        opening = std::max(opening, std::abs(lengthOf(top)));
    }
    EXPECT_NEAR(crossed / (1.25 * period), 1.0, 1e-4);
    EXPECT_LT(opening, 1e-4);  // of a link of 1 m
    EXPECT_NEAR(world.metrics().energy(), energy, 1e-4 * 0.2 * g * 0.5);
}

// Two links in free space, one spinning: their joint adds no momentum, and hardly any energy.
TEST(Hinge, KeepsMomentumAndEnergyOfFreeBodies) {
    for (const char* kind : {"hinge", "ball"}) {
        World world(sceneOf(head("[0, 0, 0]") + link("a", 0, "spin_rad_per_s = [0, 0, 2]\n") +
                            "[solid.b]\nlike = \"a\"\nposition = [0, 0.5, 0]\nspin_rad_per_s = [0, 0, 0]\n[[joint]]\n"
                            "a = \"solid.a\"\nb = \"solid.b\"\nkind = \"" +
                            kind + "\"\nplace = [0, -0.5, 0]\naxis = [0, 0, 1]\n"));
        run(world, 1);
        const Metrics before = world.metrics();
        double opening = 0;
        for (int i = 0; i < 200; ++i) {
            run(world, 1);
            opening = std::max(opening, lengthOf(middle(world, "solid.a@bottom") - middle(world, "solid.b@top")));
        }
        const Metrics after = world.metrics();
        // Rounding of 25000 rigid placements of slender links, as of links that are pinned at corners.
        EXPECT_LT(lengthOf(after.momentum - before.momentum), 1e-6) << kind;
        EXPECT_LT(lengthOf(after.angularMomentum - before.angularMomentum), 1e-6) << kind;
        EXPECT_NEAR(after.energy() / before.energy(), 1.0, 1e-3) << kind;
        EXPECT_LT(opening, 1e-4) << kind;
    }
}

// A turn about any axis but the hinge's own is held: pushed along it, the link stays in its plane.
TEST(Hinge, HoldsItsAxisAndABallDoesNot) {
    for (const auto& [kind, most, least] : {std::tuple{"hinge", 1e-4, 0.0}, {"ball", 10.0, 0.1}}) {
        World world(sceneOf(head("[0, -9.81, 0]") + post + link("bob", 30, "velocity = [0, 0, 1]\n") +
                            "[[joint]]\na = \"solid.bob\"\nb = \"collider.post\"\nkind = \"" + kind +
                            "\"\nplace = [0, 0.5, 0]\naxis = [0, 0, 1]\n"));
        double away = 0;
        for (int i = 0; i < 100; ++i) {
            run(world, 1);
            away = std::max(away, std::abs(middle(world, "solid.bob@bottom").z));
        }
        EXPECT_LE(away, most) << kind;
        EXPECT_GE(away, least) << kind;
    }
}

// A link that falls from 80° stops at 30°, where its limit is, and rests there.
TEST(Hinge, StopsAtItsLimits) {
    World world(
        sceneOf(head("[0, -9.81, 0]") + post + link("bob", 80) +
                hinge("collider.post", "solid.bob", "place = [0, 0, 0]\naxis = [0, 0, 1]\nlimits_deg = [-50, 20]\n")));
    double least = 90;
    for (int i = 0; i < 300; ++i) {
        run(world, 1);
        const dvec3 d = middle(world, "solid.bob@top") - middle(world, "solid.bob@bottom");
        least = std::min(least, std::atan2(-d.x, d.y) * 180 / pi);
    }
    EXPECT_NEAR(least, 30, 0.05);
    EXPECT_LT(world.metrics().kinetic, 1e-6);
}

// A lid that falls from 60° on the upper back edge of its chest. It stops on the chest if they touch, and swings into
// it if they do not. Held by a collider or on a solid, the lid lies flat in the end, and the hinge stays closed.
TEST(Hinge, ALidClosesOnItsChestIfTheyTouch) {
    const double a = pi / 3;
    for (const bool isCollider : {true, false})
        for (const bool touches : {true, false}) {
            const std::string chest = isCollider ? "collider.chest" : "solid.chest";
            World world(sceneOf(
                head("[0, -9.81, 0]") + "[collider.ground]\nshape = \"plane\"\nfriction = 0.6\n[" + chest +
                "]\nshape = \"box\"\nsize = [0.6, 0.3, 0.4]\nposition = [0, 0.15, 0]\n"
                "[solid.lid]\nshape = \"box\"\nsize = [0.6, 0.04, 0.4]\nrotation_deg = [-60, 0, 0]\nposition = [0, " +
                std::to_string(0.3 + 0.02 * std::cos(a) + 0.2 * std::sin(a)) + ", " +
                std::to_string(-0.2 - 0.02 * std::sin(a) + 0.2 * std::cos(a)) + "]\n" +
                hinge(chest, "solid.lid", "place = [0, 0.15, -0.2]\naxis = [1, 0, 0]\ntouch = ") +
                (touches ? "true\n" : "false\n")));
            // From the axle, which is on the chest.
            const auto onChest = [&] { return isCollider ? dvec3(0.0) : middle(world, "solid.chest@top-back"); };
            const dvec3 axle = dvec3(0, 0.3, -0.2) - onChest();
            const auto armOfLid = [&] { return lengthOf(middle(world, "solid.lid@bottom-back") - axle - onChest()); };
            const double arm = armOfLid(), under = 0.002;  // [m] points lie inside the rounded face by so much
            double lowest = 1, opening = 0;
            dvec3 before(0.0);  // half a second before the end
            for (int i = 0; i < 200; ++i) {
                run(world, 1);
                lowest = std::min(lowest, middle(world, "solid.lid@bottom-front").y);
                opening = std::max(opening, std::abs(armOfLid() - arm));
                if (i == 150) before = middle(world, "solid.lid@bottom-front");
            }
            if (touches) {
                EXPECT_NEAR(lowest, 0.3 + under, 1e-3) << chest;
                EXPECT_NEAR(middle(world, "solid.lid@bottom-front").y, 0.3 + under, 1e-3) << chest;
                EXPECT_LT(lengthOf(middle(world, "solid.lid@bottom-front") - before), 1e-5) << chest;
                EXPECT_LT(opening, 1e-4 * 0.4) << chest;  // of the lid's depth
            } else {
                EXPECT_LT(lowest, 0.2) << chest;
            }
        }
}

// A bar that falls on two stands, bounces by half and comes to rest, alone and with a load of a hundred times its mass
// that hangs from a ball joint below its middle. Contact and joint are met at once, so the load changes nothing.
TEST(Hinge, ALoadOnAJointChangesNoBounceAndNoRest) {
    const auto worldOf = [](const std::string& more) {
        return World(
            sceneOf(head("[0, -9.81, 0]") +
                    "[collider]\nleft = { shape = \"box\", size = [0.2, 1, 0.4], position = [-0.25, 0.5, 0], "
                    "restitution = 1 }\n"
                    "right = { shape = \"box\", size = [0.2, 1, 0.4], position = [0.25, 0.5, 0], restitution = 1 }\n"
                    "[solid.bar]\nshape = \"box\"\nsize = [0.6, 0.04, 0.1]\nposition = [0, 1.07, 0]\n"
                    "mass_kg = 0.1\nrestitution = 0.5\ndrag_per_s = 0\n" +
                    more));
    };
    World alone = worldOf(""),
          loaded = worldOf(
              "[solid.load]\nshape = \"box\"\nsize = [0.1, 0.4, 0.1]\nposition = [0, 0.85, 0]\nmass_kg = 10\n"
              "drag_per_s = 0\n[[joint]]\na = \"solid.bar\"\nb = \"solid.load\"\nkind = \"ball\"\n"
              "place = [0, -0.02, 0]\n");
    double furthest = 0, bounced = 0;  // [m]
    for (int i = 0; i < 150; ++i) {
        run(alone, 1);
        run(loaded, 1);
        const double own = middle(alone, "solid.bar@bottom").y;
        furthest = std::max(furthest, std::abs(middle(loaded, "solid.bar@bottom").y - own));
        if (i > 12) bounced = std::max(bounced, own);
    }
    EXPECT_GT(bounced, 1.01);
    EXPECT_LT(furthest, 1e-5);
}

// Wheels that a name with * stands for are hinged each at its own centre.
TEST(Hinge, SeveralBodiesHaveOneEachAtThePlaceInTheirOwnAxes) {
    for (const std::string holder : {"solid.cart", "collider.cart"}) {
        World world(sceneOf(head("[0, -9.81, 0]") + "[" + holder +
                            "]\nshape = \"box\"\nsize = [2, 0.1, 0.1]\nposition = [0, 2, 0]\n" +
                            (holder == "solid.cart" ? "hold = [\"all\"]\n" : "") +
                            "[solid.wheel]\nshape = \"sphere\"\nradius = 0.1\nposition = [-0.5, 2, 0.3]\n"
                            "spin_rad_per_s = [0, 0, 5]\narray = { count = [3, 1, 1], step_x = [0.5, 0, 0] }\n" +
                            hinge("solid.wheel.*", holder, "place = [0, 0, 0]\naxis = [0, 0, 1]\n")));
        run(world, 100);
        for (int k = 0; k < 3; ++k)
            EXPECT_LT(lengthOf(middle(world, "solid.wheel." + std::to_string(k)) - dvec3(-0.5 + 0.5 * k, 2, 0.3)), 1e-6)
                << holder << k;
    }
}

// A leash pulls and does not push: a lid that starts at its limit is opened by a motor, and closed by its weight.
TEST(Hinge, LeavesALimit) {
    World world(sceneOf(head("[0, -9.81, 0]") + post + link("bob", 90) +
                        hinge("collider.post", "solid.bob",
                              "place = [0, 0, 0]\naxis = [0, 0, 1]\nlimits_deg = [0, 60]\nmotor_rad_per_s = 1\n"
                              "motor_N_m = 4\n")));  // weight: 0.98 N m
    run(world, 50);
    EXPECT_NEAR(middle(world, "solid.bob@bottom").y, 2 + std::sin(0.5), 0.01);
    run(world, 150);
    EXPECT_NEAR(middle(world, "solid.bob@bottom").y, 2 + std::sin(pi / 3), 0.001);
}

TEST(Hinge, ABallStaysInItsCone) {
    World world(sceneOf(head("[0, -9.81, 0]") + post + link("bob", 0, "velocity = [3, 0, 1]\n") +
                        "[[joint]]\na = \"collider.post\"\nb = \"solid.bob\"\nkind = \"ball\"\nplace = [0, 0, 0]\n"
                        "axis = [0, 1, 0]\ncone_deg = 20\n"));
    double most = 0;
    for (int i = 0; i < 200; ++i) {
        run(world, 1);
        const dvec3 d = middle(world, "solid.bob@top") - middle(world, "solid.bob@bottom");
        most = std::max(most, std::acos(d.y / lengthOf(d)) * 180 / pi);
    }
    EXPECT_NEAR(most, 20, 0.05);
}

// A wheel on an axle, I about it, with ω0 = 10 rad/s. Damping c: ω0 exp(-c t/I). Friction T: ω0 - T t/I, then at rest.
// A motor T: the same towards its speed. And friction that is more than a weight's moment holds it.
TEST(Hinge, FrictionDampingAndMotorAreTheirTorques) {
    const double mass = 1000 * 0.2 * 0.2 * 0.05, inertia = mass * (0.04 + 0.04) / 12;
    const auto rateAfter = [&](const std::string& more, int ticks) {
        World world(sceneOf(head("[0, 0, 0]") + post +
                            "[solid.wheel]\nshape = \"box\"\nsize = [0.2, 0.2, 0.05]\nposition = [0, 2, 0]\n"
                            "density_kg_per_m3 = 1000\ndrag_per_s = 0\ncollide = false\nspin_rad_per_s = [0, 0, 10]\n" +
                            hinge("collider.post", "solid.wheel", "place = [0, 0, 0]\naxis = [0, 0, 1]\n" + more)));
        run(world, ticks);
        return world.metrics().angularMomentum.z / inertia;
    };
    EXPECT_NEAR(rateAfter("", 100), 10.0, 1e-6);
    const double c = inertia;  // slows to 1/e in a second
    EXPECT_NEAR(rateAfter("damping_N_m_s = " + std::to_string(c) + "\n", 100), 10 * std::exp(-1.0), 0.02);
    const std::string torque = std::to_string(5 * inertia);
    EXPECT_NEAR(rateAfter("friction_N_m = " + torque + "\n", 100), 5.0, 0.06);
    EXPECT_NEAR(rateAfter("friction_N_m = " + torque + "\n", 250), 0.0, 1e-9);
    EXPECT_NEAR(rateAfter("motor_rad_per_s = -3\nmotor_N_m = " + torque + "\n", 100), 5.0, 0.06);
    EXPECT_NEAR(rateAfter("motor_rad_per_s = -3\nmotor_N_m = " + torque + "\n", 400), -3.0, 1e-6);
    World world(sceneOf(head("[0, -9.81, 0]") + post + link("bob", 90) +
                        hinge("solid.bob", "collider.post",
                              "place = [0, 0.5, 0]\naxis = [0, 0, 1]\nfriction_N_m = 3\n")));  // weight: 0.98 N m
    run(world, 200);
    EXPECT_NEAR(middle(world, "solid.bob@bottom").y, 2.0, 1e-3);
}

// Its pins, limit, friction and motor are all in a state; released, both bodies move freely.
TEST(Hinge, GoesOnWithTheSameBitsAndIsLetGo) {
    const std::string more =
        "place = [0, 0.5, 0]\naxis = [0, 0, 1]\nlimits_deg = [-100, 50]\nfriction_N_m = 0.1\n"
        "motor_rad_per_s = -1\nmotor_N_m = 0.2\nname = \"h\"\n";
    const SceneSpec scene =
        sceneOf(head("[0, -9.81, 0]") + post + link("bob", 60) + hinge("solid.bob", "collider.post", more) +
                "[[at]]\nt = 0.5\ndo = \"release\"\nid = \"h\"\n");
    World world(scene);
    for (const int ticks : {10, 30}) {
        run(world, ticks);
        World other(scene);
        other.restore(world.save());
        run(world, 5);
        run(other, 5);
        EXPECT_EQ(world.save(), other.save());
    }
    EXPECT_EQ(world.joints().front().left, 1);
    run(world, 50);
    EXPECT_EQ(world.joints().front().left, 0);
    EXPECT_LT(middle(world, "solid.bob@top").y, 1.7);
}

// A link of 0.2 kg that is released at 90° has ω² = 3 g/L at the lowest place, and pulls with 5/2 m g = 4.9 N there.
TEST(Hinge, BreaksAtItsForce) {
    for (const auto& [most, left] : {std::pair{"5.4", 1}, {"4.4", 0}}) {
        World world(sceneOf(head("[0, -9.81, 0]") + post + link("bob", 90) +
                            hinge("solid.bob", "collider.post",
                                  std::string("place = [0, 0.5, 0]\naxis = [0, 0, 1]\nbreak_N = ") + most + "\n")));
        run(world, 100);
        EXPECT_EQ(world.joints().front().left, left) << most;
    }
}

// A box of 0.2, 0.4, 0.6 m: the corner names three faces, the middle of an edge is a place on two, of a face on one.
TEST(Places, OfABoxHaveNames) {
    const std::string box = "[solid.box]\nshape = \"box\"\nsize = [0.2, 0.4, 0.6]\nposition = [1, 2, 3]\n";
    const World world(sceneOf(head("[0, 0, 0]") + box));
    EXPECT_EQ(world.points("solid.box@front-top-left").x.size(), 1U);
    EXPECT_LT(lengthOf(world.points("solid.box@front-top-left").x[0] - dvec3(0.9, 2.2, 3.3)), 0.003 * 2);
    EXPECT_EQ(world.points("solid.box@top-front").x.size(), 2U);
    // A rod from a place by name has the length from there.
    for (const auto& [name, place] : {std::pair{"centre", dvec3(1, 2, 3)},
                                      {"top-middle", dvec3(1, 2.2, 3)},
                                      {"front-left-middle", dvec3(0.9, 2, 3.3)}}) {
        World tied(sceneOf(head("[0, 0, 0]") + box +
                           "[net.n]\npoints = [{ name = \"p\", position = [1, 5, 3] }]\n[[joint]]\na = \"solid.box@" +
                           name + "\"\nb = \"net.n@p\"\nkind = \"rod\"\nfinish = { colour = \"#ff0000\" }\n"));
        bool isDrawn = false;
        for (const view::Surface& surface : tied.view(false).surfaces)
            if (surface.name.starts_with("joint")) {
                isDrawn = true;
                dvec3 low(1e9), high(-1e9);
                for (const glm::vec3& x : surface.geometry->positions)
                    low = min(low, dvec3(x)), high = max(high, dvec3(x));
                EXPECT_NEAR(low.y, place.y, 0.011) << name;
                EXPECT_NEAR(high.y, 5, 0.011) << name;
            }
        EXPECT_TRUE(isDrawn) << name;
    }
}

// A ball on a string that ends at its surface: a conical turn about the vertical has v² = g r tan(α), r from the axis
// to the centre. The string and the radius are one line, so α is that of the centre too.
TEST(Places, ASphereIsTiedAtItsSurface) {
    World world(sceneOf(head("[0, -9.81, 0]") + post +
                        "[solid.ball]\nshape = \"sphere\"\nradius = 0.1\nposition = [0, 1, 0]\ndrag_per_s = 0\n"
                        "[[joint]]\na = \"solid.ball@top\"\nb = \"collider.post\"\nkind = \"rod\"\n"));
    run(world, 100);
    EXPECT_NEAR(world.points("solid.ball").x[6].y, 1.0, 1e-6);
}

// A plank on a rod at a place 0.3 m beside its centre, and a cord's end welded to a place of it: both follow.
TEST(Places, WeldsAndRodsEndThere) {
    World world(sceneOf(head("[0, -9.81, 0]") + post +
                        "[solid.plank]\nshape = \"box\"\nsize = [1, 0.05, 0.2]\nposition = [-0.3, 1, 0]\n"
                        "[net.n]\npoints = [{ name = \"p\", position = [0.2, 1.03, 0], mass_kg = 0.5 }]\n"
                        "[[joint]]\na = \"solid.plank\"\nb = \"collider.post\"\nkind = \"weld\"\nplace = [0.3, 0, 0]\n"
                        "[[joint]]\na = \"solid.plank\"\nb = \"net.n@p\"\nplace = [0.5, 0.025, 0]\nname = \"w\"\n"));
    const auto end = [&] {  // the middle of the plank's right edge above
        const std::vector<dvec3> x = world.points("solid.plank@top-right").x;
        return 0.5 * (x[0] + x[1]);
    };
    for (int i = 0; i < 50; ++i) {
        run(world, 1);
        EXPECT_LT(lengthOf(world.points("net.n@p").x[0] - end()), 0.005);  // its thickness at most
    }
    EXPECT_LT(middle(world, "solid.plank@left").y, 0.9);  // it turns about the place
}

// A lid that lies on its chest, and a bridge at the limit of its hinge, stay where they are; so does a link that hangs,
// unless it turns about the vertical.
TEST(Hinge, JointedSolidsThatStayFallAsleepTogether) {
    const std::string ground = "[collider.ground]\nshape = \"plane\"\n", solver = "sleep_error_m = 1e-3\n";
    const auto box = [](const std::string& name, const std::string& size, const std::string& place,
                        const std::string& more = "") {
        return "[solid." + name + "]\nshape = \"box\"\nsize = " + size + "\nposition = " + place + "\n" + more;
    };
    const auto asleepAfter = [&](const std::string& text, int ticks) {
        World world(sceneOf(head("[0, -9.81, 0]", solver) + ground + post + text));
        run(world, ticks);
        return world.metrics().asleep;
    };
    const std::string chest = box("chest", "[0.6, 0.3, 0.4]", "[0, 0.15, 0]"),
                      lid = box("lid", "[0.6, 0.04, 0.4]", "[0, 0.32, 0]"),
                      onChest = hinge("solid.chest", "solid.lid",
                                      "place = [0, 0.15, -0.2]\naxis = [-1, 0, 0]\ntouch = true\nname = \"h\"\n");
    EXPECT_EQ(asleepAfter(chest + lid + onChest, 300), 28);
    EXPECT_EQ(asleepAfter(box("bridge", "[1, 0.1, 1]", "[0.5, 2, 0]") +
                              hinge("collider.post", "solid.bridge",
                                    "place = [0, 0, 0]\naxis = [0, 0, 1]\nlimits_deg = [0, 80]\n"),
                          300),
              14);
    // Hanging: at rest; slowly turning about the vertical for ever; drawn to rest by damping, from 20°.
    const std::string ball =
        "[[joint]]\nkind = \"ball\"\na = \"collider.post\"\nb = \"solid.bob\"\nplace = [0, 0, 0]\n";
    EXPECT_EQ(asleepAfter(link("bob", 0) + ball, 300), 14);
    EXPECT_EQ(asleepAfter(link("bob", 0, "spin_rad_per_s = [0, 1e-3, 0]\n") + ball, 300), 0);
    const SceneSpec hanging =
        sceneOf(head("[0, -9.81, 0]", solver) + post + link("bob", 20) +
                hinge("collider.post", "solid.bob", "place = [0, 0, 0]\naxis = [0, 0, 1]\ndamping_N_m_s = 0.5\n"));
    World lamp(hanging), resumed(hanging);
    run(lamp, 600);
    EXPECT_EQ(lamp.metrics().asleep, 14);
    EXPECT_LT(std::abs(middle(lamp, "solid.bob@bottom").x), 1e-3);  // its error
    resumed.restore(lamp.save());
    run(lamp, 10);
    run(resumed, 10);
    EXPECT_EQ(lamp.save(), resumed.save());

    // Asleep, it goes on with the same bits after a restart. Released, both wake.
    const SceneSpec scene =
        sceneOf(head("[0, -9.81, 0]", solver) + ground + chest + lid + onChest +
                "[[at]]\nt = 3.05\ndo = \"push\"\ntarget = \"solid.lid@front\"\nimpulse_Ns = [0, 2, 0]\n");
    World world(scene), other(scene);
    run(world, 300);
    other.restore(world.save());
    EXPECT_EQ(other.metrics().asleep, 28);
    run(world, 10);
    run(other, 10);
    EXPECT_EQ(world.metrics().asleep, 0);
    EXPECT_EQ(world.save(), other.save());
}

// A plank of 0.2 kg and 1 m on a hinge at its left end, and on a spring of 50 N/m that goes up 1 m from a place between
// its points. At an arm a from the hinge F = m g / (2 a) keeps it level, with a length of 1 m - F/k. From 10° above it
// comes to rest there: on a point that is held and a place of the plank, and on a collider and a place with a name.
TEST(Places, ASpringBearsAPlankThere) {
    for (const bool isCollider : {true, false}) {
        const double arm = isCollider ? 0.5 : 0.3, force = 0.2 * g * 0.5 / arm;
        const std::string spring =
            isCollider ? "[collider.hook]\nshape = \"sphere\"\nradius = 0.01\nposition = [0.5, 3, 0]\n"
                         "[[joint]]\na = \"solid.plank@centre\"\nb = \"collider.hook\"\nplace = [0, 0, 0]\n"
                       : "[net.n]\npoints = [{ name = \"p\", position = [0.3, 3, 0] }]\nhold = [\"p\"]\n"
                         "[[joint]]\na = \"solid.plank\"\nb = \"net.n@p\"\nplace = [-0.2, 0, 0]\n";
        World world(sceneOf(
            head("[0, -9.81, 0]") + post +
            "[solid.plank]\nshape = \"box\"\nsize = [1, 0.02, 0.02]\nthickness = 1e-9\nrotation_deg = [0, 0, 10]\n"
            "position = [" +
            std::to_string(0.5 * std::cos(pi / 18)) + ", " + std::to_string(2 + 0.5 * std::sin(pi / 18)) + ", 0]\n" +
            spring + "kind = \"spring\"\nstiffness_N_per_m = 50\ndamping_time_s = 0.05\nrest_length_m = " +
            std::to_string(1 - force / 50) + "\n" +
            hinge("collider.post", "solid.plank", "place = [0, 0, 0]\naxis = [0, 0, 1]\n")));
        run(world, 800);
        EXPECT_NEAR(middle(world, "solid.plank@right").y, 2, 1e-5) << isCollider;  // lengths have six decimals
    }
}

// Two boxes in free flight that a spring draws at places between their points: it adds neither momentum nor angular
// momentum beyond the drift of solids by themselves, 1e-9, and keeps the energy to 5e-6, as between points.
TEST(Places, ASpringBetweenSolidsKeepsMomentaAndEnergy) {
    World world(sceneOf(head("[0, 0, 0]") +
                        "[solid.a]\nshape = \"box\"\nsize = [0.2, 0.4, 0.6]\ntouch = \"nothing\"\n"
                        "[solid.b]\nshape = \"box\"\nsize = [0.3, 0.2, 0.2]\nposition = [1, 0.5, 0.3]\n"
                        "velocity = [0, 0.4, -0.2]\nspin_rad_per_s = [0, 1, 0]\ntouch = \"nothing\"\n"
                        "[[joint]]\na = \"solid.a@front-top-middle\"\nb = \"solid.b\"\nplace = [-0.15, 0.05, 0.02]\n"
                        "kind = \"spring\"\nstiffness_N_per_m = 100\ndamping_time_s = 0\nrest_length_m = 0.4\n"));
    const Metrics before = world.metrics();
    double most = 0;
    for (int i = 0; i < 200; ++i) {
        run(world, 1);
        const Metrics now = world.metrics();
        EXPECT_LT(lengthOf(now.momentum - before.momentum), 1e-7);
        EXPECT_LT(lengthOf(now.angularMomentum - before.angularMomentum), 1e-7);
        most = std::max(most, std::abs(now.energy() / before.energy() - 1));
    }
    EXPECT_LT(most, 2e-5);
}

// A box of 2 kg hangs on a spring at a place: 19.6 N. Named, it is in the states of a run before and after its release.
TEST(Places, ASpringBreaksIsReleasedAndGoesOnWithTheSameBits) {
    const std::string box =
        head("[0, -9.81, 0]") + post +
        "[solid.box]\nshape = \"box\"\nsize = [0.2, 0.2, 0.2]\nmass_kg = 2\nposition = [0, 1, 0]\n"
        "[[joint]]\na = \"solid.box@top-middle\"\nb = \"collider.post\"\nkind = \"spring\"\nname = \"s\"\n"
        "place = [0, 0, 0]\nstiffness_N_per_m = 1000\nrest_length_m = 0.8804\n";  // 0.9 m - 19.62 N / k
    for (const auto& [most, left] : {std::pair{"20", 1}, {"19", 0}}) {
        World world(sceneOf(box + "break_N = " + most + "\n"));
        run(world, 100);
        EXPECT_EQ(world.joints().front().left, left) << most;
    }
    const SceneSpec scene = sceneOf(box + "[[at]]\nt = 0.2\ndo = \"release\"\nid = \"s\"\n");
    World world(scene);
    for (const int ticks : {10, 30}) {
        run(world, ticks);
        World other(scene);
        other.restore(world.save());
        run(world, 5);
        run(other, 5);
        EXPECT_EQ(world.save(), other.save());
    }
    EXPECT_EQ(world.joints().front().left, 0);
    EXPECT_NEAR(world.metrics().momentum.y, -2 * g * 0.3, 0.05);
}

// A loose end 0.3 m beside its place comes to it, with a warning; the box does not move or lose its shape for it.
TEST(Places, LooseEndsComeToASolid) {
    const std::string box = head("[0, 0, 0]") + "[solid.box]\nshape = \"box\"\nsize = [0.2, 0.4, 0.6]\n",
                      net =
                          "[net.n]\npoints = [{ name = \"p\", position = [0.4, 0, 0], mass_kg = 50 }]\n"
                          "[[joint]]\nkind = \"ball\"\na = \"solid.box\"\nb = \"net.n@p\"\nplace = [0.1, 0, 0]\n";
    World alone(sceneOf(box)), joined(sceneOf(box + net));
    EXPECT_EQ(joined.points("solid.box").x, alone.points("solid.box").x);
    EXPECT_LT(lengthOf(joined.points("net.n").x[0] - dvec3(0.1, 0, 0)), 1e-12);
    ASSERT_EQ(joined.warnings().size(), 1U);
    EXPECT_EQ(joined.warnings()[0].text,
              "the ball joint \"solid.box\" – \"net.n@p\" jerks points together by 0.3 m: move the bodies together, or "
              "use kind = \"spring\"");
    run(joined, 10);
    EXPECT_LT(lengthOf(joined.points("net.n").v[0]), 1e-9);
}

TEST(Places, ImpossiblePlacesAreRefused) {
    const std::string box =
        "[solid.box]\nshape = \"box\"\nsize = [0.2, 0.4, 0.6]\nposition = [1, 2, 3]\n"
        "[solid.other]\nshape = \"box\"\nsize = [0.2, 0.2, 0.2]\nposition = [1.6, 2, 3]\nhold = [\"front-top-left\"]\n"
        "[collider.c]\nshape = \"sphere\"\nradius = 0.1\nposition = [1, 2, 3]\n"
        "[net.n]\npoints = [{ name = \"p\", position = [1, 5, 3] }, { name = \"q\", position = [2.7, 2, 3] }]\n"
        "hold = [\"q\"]\n";
    const auto messageOf = [](const std::string& text) -> std::string {
        try {
            World world(sceneOf(text));
        } catch (const core::Error& error) {
            return error.what();
        }
        return "";
    };
    for (const auto& [joint, message] :
         {std::pair{"a = \"solid.box\"\nb = \"net.n@p\"\nkind = \"hinge\"\n", "[[joint]] needs place"},
          {"a = \"solid.box@top-left-middl\"\nb = \"net.n@p\"\nkind = \"rod\"\n", "has no points \"top-left-middl\""},
          {"a = \"solid.box@top\"\nb = \"net.n@p\"\nkind = \"rod\"\nplace = [0, 0, 0]\n",
           "a side that is a whole solid or a collider"},
          {"a = \"solid.box\"\nb = \"net.n@p\"\nkind = \"hinge\"\nplace = [0, 0, 0]\nlimits_deg = [10, 20]\n",
           "the limits are turns since the start"},
          {"a = \"solid.box\"\nb = \"net.n@p\"\nkind = \"hinge\"\nplace = [0, 0, 0]\nmotor_rad_per_s = 2\n",
           "a motor has a torque"},
          {"a = \"solid.box\"\nb = \"net.n@p\"\nkind = \"ball\"\nplace = [0, 0, 0]\ncone_deg = 10\n",
           "a ball joint with cone_deg needs a rigid body or a collider on each side"},
          {"a = \"solid.box\"\nb = \"solid.other@left-middle\"\nkind = \"ball\"\nplace = [0.1, 0, 0]\n",
           "a ball joint holds its sides at one place, and \"solid.other@left-middle\" is 0.400000 m from it"},
          {"a = \"solid.other@left-middle\"\nb = \"collider.c\"\nkind = \"ball\"\nplace = [0, 0, 0]\n",
           "a ball joint holds its sides at one place, and \"solid.other@left-middle\" is 0.500000 m from it"},
          {"a = \"solid.other\"\nb = \"net.n@q\"\nkind = \"ball\"\nplace = [0.1, 0, 0]\n",
           "is open by 1.000000 m, and its sides are held: move them together, or leave `hold` out of one"},
          {"a = \"solid.box\"\nb = \"net.n@p\"\nkind = \"hinge\"\nplace = [0, 0, 0]\n",
           "a hinge needs a rigid body or a collider on each side"}})
        EXPECT_NE(messageOf(head("[0, 0, 0]") + box + "[[joint]]\n" + joint).find(message), std::string::npos)
            << joint << messageOf(head("[0, 0, 0]") + box + "[[joint]]\n" + joint);
}

}  // namespace
}  // namespace taut::world::hinges
