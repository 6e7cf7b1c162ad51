// Joints that are released: by a name, by a force, by a cut; and pins, which keep points in one place until then.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/timelines.h"
#include "taut/bodies/net.h"
#include "taut/view/frame_view.h"
#include "taut/world/world.h"
#include "unit/scene_support.h"

namespace taut::world::letting_go {
namespace {

using support::g;
using support::run;

SceneSpec sceneOf(const std::string& text) {
    return scene::loadSceneText(text, "joints.toml", {}).spec;
}

const std::string head = "schema = 1\n[run]\nfps = 100\nseconds = 10\n[solver]\nprecision = \"double\"\ndt = 0.001\n";

std::string withAction(const std::string& action, const std::string& text) {
    return "schema = 1\nat = [{ " + action + " }]\n" + text.substr(text.find("[run]"));
}

double lengthOf(const dvec3& d) {
    return std::sqrt(glm::dot(d, d));
}

int left(const World& world, const std::string& name) {
    int sum = 0;
    for (const JointInfo& joint : world.joints())
        if (joint.name == name) sum += joint.left;
    return sum;
}

// Two sheets sewn together along an edge, one of them held, swinging.
std::string sheets(const std::string& sewn) {
    return head +
           "[material.m]\n[cloth.a]\nsize = [0.4, 0.4]\ncells = [4, 4]\norigin = [0, 2, 0]\nmaterial = \"m\"\n"
           "hold = [\"left\"]\n[cloth.b]\nsize = [0.4, 0.4]\ncells = [4, 4]\norigin = [0.4, 2, 0]\nmaterial = \"m\"\n"
           "velocity = [0, 0, 1]\n[[joint]]\na = \"cloth.a@right\"\nb = \"cloth.b@left\"\n" +
           sewn;
}

TEST(Pins, MoveAsPointsThatAreMerged) {
    World merged(sceneOf(sheets(""))), pinned(sceneOf(sheets("name = \"seam\"\n")));
    EXPECT_EQ(merged.islands()[0].points + 5, pinned.islands()[0].points);
    for (int tick = 0; tick < 10; ++tick) {
        run(merged, 1);
        run(pinned, 1);
        const auto a = merged.points("cloth.*").x, b = pinned.points("cloth.*").x;
        for (std::size_t i = 0; i < a.size(); ++i)
            // 100 steps of springs of 30 /s; the effect of rounding grows no faster than with them.
            EXPECT_LT(lengthOf(a[i] - b[i]), 1e-11) << tick << " " << i;
    }
    const auto edge = pinned.points("cloth.a@right").x, other = pinned.points("cloth.b@left").x;
    for (std::size_t i = 0; i < edge.size(); ++i) EXPECT_EQ(edge[i], other[i]);
}

// Of a free cross of three points in one place, with springs, that spins.
TEST(Pins, KeepMomentumAndAngularMomentum) {
    World world(sceneOf(
        head +
        "[world]\ngravity = [0, 0, 0]\n[net.n]\ndrag_per_s = 0\nspin_rad_per_s = [1, 2, 3]\nvelocity = [0.3, 0, 0]\n"
        "points = [{ name = \"a\", position = [0, 1, 0], mass_kg = 2 }, { name = \"b\", position = [0, 1, 0] },\n"
        "{ name = \"c\", position = [0, 1, 0], mass_kg = 3 }, { name = \"d\", position = [1, 1, 0] },\n"
        "{ name = \"e\", position = [0, 2, 0.3] }, { name = \"f\", position = [-0.5, 1, 1] }]\n"
        "springs = [{ a = \"a\", b = \"d\" }, { a = \"b\", b = \"e\" }, { a = \"c\", b = \"f\" }]\n"
        "[[joint]]\na = \"net.n@a\"\nb = \"net.n@b\"\n[[joint]]\na = \"net.n@b\"\nb = \"net.n@c\"\n"));
    const Metrics before = world.metrics();
    run(world, 100);
    const Metrics after = world.metrics();
    // Places of 2 m over h are rounded to 4e-13 m/s, of 6 kg, at random in 1000 steps: 8e-11.
    EXPECT_LT(lengthOf(after.momentum - before.momentum), 1e-10);
    EXPECT_LT(lengthOf(after.angularMomentum - before.angularMomentum), 1e-10);
    EXPECT_EQ(world.points("net.n@a").x, world.points("net.n@c").x);
}

// A point of 2 kg at a height of 2 m, with one of 1 kg on a rod of 1 m below it, and that joint.
std::string hanging(const std::string& joint) {
    return head +
           "[net.n]\npoints = [{ name = \"a\", position = [0, 2, 0], hold = true }, { name = \"z\", position = [0, 3, "
           "0], hold = true }]\n[net.o]\npoints = [{ name = \"b\", position = [0, 2, 0], mass_kg = 2 }, { name = "
           "\"c\", position = [0, 1, 0] }]\ndrag_per_s = 0\n[[joint]]\na = \"net.o@b\"\nb = \"net.o@c\"\n"
           "kind = \"rod\"\n[[joint]]\nname = \"peg\"\n" +
           joint;
}
const std::string ball = "[collider.k]\nshape = \"sphere\"\nradius = 0.1\nposition = [0, ";

// At rest each bears the weight of all that hangs on it, with any method; a collider does not push the points it
// carries, here from within it.
TEST(LettingGo, AJointBreaksAtTheWeightThatItBears) {
    for (const char* method : {"leapfrog", "velocity-verlet", "rk4"})
        for (const std::string& joint :
             {std::string("a = \"net.o@b\"\nb = \"net.n@a\"\n"), std::string("a = \"net.o@b\"\nb = \"collider.k\"\n"),
              std::string("a = \"net.o@b\"\nb = \"net.n@z\"\nkind = \"rod\"\n")})
            for (const double share : {0.999, 1.001}) {
                const bool isCarried = joint.find("collider") != std::string::npos;
                SceneSpec scene = sceneOf(hanging(joint + "break_N = " + std::to_string(share * 3 * g) + "\n" +
                                                  (isCarried ? ball + "2, 0.05]\n" : "")));
                scene.solver.integrator = method;
                World world(scene);
                run(world, 2);  // leap-frog's first kick is half a step's
                EXPECT_EQ(left(world, "peg"), share < 1 ? 0 : 1) << method << " " << joint << share;
            }
}

// Of 1000 N/m, in the tick in which the mean of its stretch passes 20 mm.
TEST(LettingGo, ASpringBreaksByItsStretch) {
    for (const std::string& to : {std::string("net.n@z"), std::string("collider.k")}) {
        World world(
            sceneOf(hanging("a = \"net.o@b\"\nb = \"" + to +
                            "\"\nkind = \"spring\"\nstiffness_N_per_m = 1000\nbreak_N = 20\n" + ball + "3, 0]\n")));
        double stretch[] = {0, 0, 0};  // after the last ticks
        while (left(world, "peg") == 1 && world.tick() < 100) {
            run(world, 1);
            std::rotate(stretch, stretch + 1, stretch + 3);
            stretch[2] = 2 - world.points("net.o@b").x[0].y;
        }
        const double trapezoid = 1e-4;  // [m] of ticks of 10 ms, in which the speed changes by 10 m/s² or less
        EXPECT_LT(0.5 * (stretch[0] + stretch[1]), 0.020 + trapezoid) << to;
        EXPECT_GT(0.5 * (stretch[1] + stretch[2]), 0.020 - trapezoid) << to;
    }
}

TEST(LettingGo, AReleasedPointFallsFromWhereItHung) {
    World world(
        sceneOf(withAction("t = 0.5, do = \"release\", id = \"peg\"", hanging("a = \"net.o@b\"\nb = \"net.n@a\"\n"))));
    run(world, 50);
    EXPECT_EQ(left(world, "peg"), 1);
    EXPECT_EQ(world.points("net.o@b").x[0].y, 2.0);
    run(world, 20);
    EXPECT_EQ(left(world, "peg"), 0);
    // Leap-frog is exact for a constant force.
    EXPECT_NEAR(world.points("net.o@b").x[0].y, 2.0 - 0.5 * g * 0.2 * 0.2, 1e-12);
}

// Two joints of one name, one of a list of targets; and each tie breaks by itself.
TEST(LettingGo, ANameIsThatOfAllItsJointsAndOfEveryTie) {
    const std::string text = withAction(
        "t = 0.1, do = \"release\", id = \"peg\"",
        head +
            "[material.m]\n[cloth.a]\ncells = [4, 4]\norigin = [0, 2, 0]\nmaterial = \"m\"\n"
            "[net.n]\npoints = [{ name = \"a\", position = [0, 2, 0], hold = true }, { name = \"b\", position = [1, 2, "
            "0], hold = true }, { name = \"c\", position = [0.5, 2, 0], hold = true }]\n"
            "[[joint]]\nname = \"peg\"\na = [\"cloth.a@top-left\", \"cloth.a@top-right\"]\nb = \"net.n@all\"\n"
            "[[joint]]\nname = \"peg\"\na = \"cloth.a@(0.5,0)\"\nb = \"net.n@c\"\n");
    World world(sceneOf(text));
    run(world, 10);
    EXPECT_EQ(left(world, "peg"), 3);
    run(world, 1);
    EXPECT_EQ(left(world, "peg"), 0);
}

TEST(LettingGo, ReleasedTiesAreSavedAndGoOnTheSame) {
    for (const std::string& joint :
         {std::string("a = \"net.o@b\"\nb = \"net.n@a\"\nbreak_N = 40\n"),
          std::string("a = \"net.o@b\"\nb = \"collider.k\"\nkind = \"spring\"\nbreak_N = 1e9\n"),
          std::string("a = \"net.o@b\"\nb = \"collider.k\"\n")}) {
        const SceneSpec scene =
            sceneOf(withAction("t = 0.1, do = \"release\", id = \"peg\"", hanging(joint) + ball + "3, 0]\n"));
        World world(scene);
        for (const int ticks : {5, 10}) {  // before, and after
            run(world, ticks);
            World other(scene);
            other.restore(world.save());
            run(other, 10);
            run(world, 10);
            EXPECT_EQ(world.save(), other.save()) << joint;
            EXPECT_EQ(left(world, "peg"), left(other, "peg"));
        }
        EXPECT_EQ(left(world, "peg"), 0);
    }
}

TEST(LettingGo, FreeReleasesARodToACollider) {
    World world(
        sceneOf(withAction("t = 0.1, do = \"free\", target = \"net.o@b\"",
                           hanging("a = \"net.o@b\"\nb = \"collider.k\"\nkind = \"rod\"\n") + ball + "3, 0]\n")));
    run(world, 10);
    EXPECT_EQ(left(world, "peg"), 1);
    run(world, 1);
    EXPECT_EQ(left(world, "peg"), 0);
}

TEST(LettingGo, ACutOfNoPlaneTakesAllSpringsAndRodsOfABody) {
    World world(
        sceneOf(withAction("t = 0, do = \"cut\", target = \"net.o\"", hanging("a = \"net.o@b\"\nb = \"net.n@a\"\n"))));
    run(world, 1);
    EXPECT_EQ(world.joints()[0].left, 0);
    EXPECT_EQ(left(world, "peg"), 1);  // its other end is of another body
    EXPECT_EQ(world.metrics().brokenSprings, 1);
}

// A chain of 20 links of 5 cm: ω² up to 4 T/(m L), T the weight of all below, asks for steps of 1/100 s / 2 at least.
TEST(LettingGo, RodsUnderTensionShortenStepsOfAuto) {
    std::string points, rods;
    for (int i = 0; i <= 20; ++i) {
        const std::string n = std::to_string(i);
        points += "{ name = \"p" + n + "\", position = [" + std::to_string(0.05 * i) + ", 2, 0]" +
                  (i == 0 ? ", hold = true" : "") + " }, ";
        if (i > 0)
            rods +=
                "[[joint]]\na = \"net.c@p" + std::to_string(i - 1) + "\"\nb = \"net.c@p" + n + "\"\nkind = \"rod\"\n";
    }
    World world(sceneOf("schema = 1\n[run]\nfps = 60\nseconds = 10\n[net.c]\npoints = [" + points + "]\n" + rods));
    const double start = world.metrics().energy();
    double most = start;
    for (int tick = 0; tick < 240; ++tick) {
        run(world, 1);
        most = std::max(most, world.metrics().energy());
    }
    EXPECT_GT(world.islands()[0].substeps, 1);
    EXPECT_LT(most - start, 0.05 * 21 * g * 1.0) << most - start;  // of m g L; drag takes out, steps put nothing in
}

TEST(LettingGo, TiesAreDrawnOnlyWithAFinishAndWhileTheyHold) {
    const auto surfaces = [](const World& world) {
        int count = 0;
        for (const view::Surface& surface : world.view(false).surfaces) count += surface.name == "joint.peg.0";
        return count;
    };
    const std::string spring = "a = \"net.o@b\"\nb = \"net.n@z\"\nkind = \"spring\"\n";
    EXPECT_EQ(surfaces(World(sceneOf(hanging(spring)))), 0);
    World world(
        sceneOf(withAction("t = 0.1, do = \"release\", id = \"peg\"", hanging(spring + "turns = 5\nfinish = {}\n"))));
    run(world, 10);
    EXPECT_EQ(surfaces(world), 1);
    run(world, 1);
    EXPECT_EQ(surfaces(world), 0);
}

TEST(LettingGo, ASpringJointHasTheRestLengthThatIsGiven) {
    World world(
        sceneOf(hanging("a = \"net.o@c\"\nb = \"net.n@a\"\nkind = \"spring\"\nrest_length_m = 0.5\n"
                        "stiffness_N_per_m = 100\n")));
    EXPECT_NEAR(world.metrics().elastic, 0.5 * 100 * 0.5 * 0.5, 1e-9);  // 1 m apart as it starts
}

}  // namespace
}  // namespace taut::world::letting_go
