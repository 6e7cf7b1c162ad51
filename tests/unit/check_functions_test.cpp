// Every function of the language in a small scene whose answer is known from theory.
#include <cmath>

#include "taut/bodies/solid.h"
#include "taut/check/private/function_table.h"
#include "taut/check/private/shadow.h"
#include "taut/core/error.h"
#include "unit/check_support.h"

namespace taut::check {
namespace {

constexpr double rounding = 1e-12;  // a few dozen roundings of numbers near 10

std::string placeIn(const world::World& world, const std::string& expression) {
    Selections selections;
    return Check::parse(expression + " < 0").where(Now(world, selections));
}

TEST(CheckFunctions, PlacesAreCentresOfMass) {
    const world::World world(sceneOf(balls));
    EXPECT_NEAR(valueIn(world, "position(net.balls@a).x"), 1.0, rounding);
    EXPECT_NEAR(valueIn(world, "position(net.balls@b).y"), 2.0, rounding);
    EXPECT_NEAR(valueIn(world, "position(net.balls@a).z"), 3.0, rounding);
    // (1·1 + 3·5 + 1·0)/5
    EXPECT_NEAR(valueIn(world, "position(net.balls).x"), 16.0 / 5, rounding);
    EXPECT_NEAR(valueIn(world, "distance(net.balls@a, net.balls@b)"), 4.0, rounding);
    EXPECT_NEAR(valueIn(world, "distance([1, -1, 7], net.balls@a)"), 5.0, rounding);
    EXPECT_NEAR(valueIn(world, "length(position(net.balls@b) - position(net.balls@a))"), 4.0, rounding);
}

TEST(CheckFunctions, HighestAndLowestPointsAreNamed) {
    const world::World world(sceneOf("[rope.r]\nends = [[0, 1, 0], [0, 3, 0]]\nsegments = 4\n"));
    EXPECT_NEAR(valueIn(world, "height(rope.r)"), 3.0, rounding);
    EXPECT_NEAR(valueIn(world, "lowest(rope.*)"), 1.0, rounding);
    EXPECT_NEAR(valueIn(world, "height(rope.r@50%)"), 2.0, rounding);
    EXPECT_EQ(placeIn(world, "height(rope.r)"), "rope.r@#4 at [0, 3, 0]");
    EXPECT_EQ(placeIn(world, "lowest(rope.*)"), "rope.r@#0 at [0, 1, 0]");
    EXPECT_EQ(placeIn(world, "height(rope.r@ends)"), "rope.r@ends, point 2 of 2 at [0, 3, 0]");
    EXPECT_EQ(placeIn(world, "height(rope.r@start)"), "rope.r@start at [0, 1, 0]");
}

// A ball, a box on an edge, a cylinder and a cone aslant; angles by a triangle with sides 3, 4 and 5.
TEST(CheckFunctions, SolidsEndWhereTheyAreDrawn) {
    const std::string aslant = "rotation_deg = [0, 0, 36.86989764584402]\n";
    const world::World world(sceneOf(
        "[solid.ball]\nshape = \"sphere\"\nradius = 0.5\nposition = [0, 1, 0]\n"
        "[solid.box]\nshape = \"box\"\nsize = [4, 3, 1]\nthickness = 0\nposition = [9, 5, 0]\n" +
        aslant + "[solid.can]\nshape = \"cylinder\"\nradius = 1\nheight = 4\nthickness = 0.01\nposition = [0, 9, 0]\n" +
        aslant + "[solid.hat]\nshape = \"cone\"\nradius = 1\nheight = 4\nthickness = 0\nposition = [0, 20, 0]\n" +
        aslant + "[solid.tin]\nshape = \"cylinder\"\nradius = 0.2\nheight = 2\nposition = [30, 9, 0]\n" +
        "[rope.r]\nends = [[3, 1, -1], [3, 1, 1]]\nsegments = 1\n"));
    EXPECT_NEAR(valueIn(world, "lowest(solid.ball)"), 0.5, rounding);
    EXPECT_NEAR(valueIn(world, "height(solid.ball)"), 1.5, rounding);
    EXPECT_EQ(placeIn(world, "height(solid.ball)"), "solid.ball at [0, 1.5, 0]");
    EXPECT_NEAR(valueIn(world, "lowest(solid.box)"), 5 - 2 * 0.6 - 1.5 * 0.8, rounding);
    // Of the rim of a disc, the radius of the rest within the thickness, which is rounded.
    EXPECT_NEAR(valueIn(world, "height(solid.can)"), 9 + 1.99 * 0.8 + 0.99 * 0.6 + 0.01, rounding);
    EXPECT_NEAR(valueIn(world, "lowest(solid.tin)"), 8.0, rounding);
    EXPECT_NEAR(valueIn(world, "height(solid.tin)"), 10.0, rounding);
    EXPECT_NEAR(valueIn(world, "lowest(solid.hat)"), 20 - 2 * 0.8 - 0.6, rounding);
    EXPECT_NEAR(valueIn(world, "height(solid.hat)"), 20 + 2 * 0.8, rounding);
    EXPECT_NEAR(valueIn(world, "lowest(solid.*)"), 0.5, rounding);
    EXPECT_NEAR(valueIn(world, "gap(solid.ball, rope.r)"), 3 - 0.5, rounding);
    EXPECT_NEAR(valueIn(world, "gap(solid.*, rope.r)"), 3 - 0.5, rounding);
    // A mesh is drawn as it is, and others keep a thickness away.
    world::SceneSpec scene = sceneOf("[rope.r]\nends = [[3, 0, -1], [3, 0, 1]]\nsegments = 1\n");
    world::SolidSpec gem;
    gem.name = "gem";
    gem.shape = "hull";
    auto mesh = std::make_shared<world::MeshData>();
    mesh->positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    gem.meshData = mesh;
    scene.bodies.add(gem);
    const world::World other(scene);
    EXPECT_NEAR(valueIn(other, "lowest(solid.gem)"), -1.0, rounding);
    EXPECT_NEAR(valueIn(other, "gap(solid.gem, rope.r)"), 2.0, rounding);
}

// Of a camera 2 m away whose picture is 2 tan(0.5) m high at 1 m, and twice as wide: ends at 2 m × tan(0.5) = 1.09 m.
// An upright picture ends where one of 16:9 does to the left and right: at 1.94 m, and at twice that above.
TEST(CheckFunctions, PicturesEndAtTheirEdges) {
    const auto shareOf = [](const std::string& ends, const std::string& size = "[200, 100]") {
        const world::World world(sceneOf("[picture]\nsize = " + size +
                                         "\n[camera.main]\neye = [0, 0, 2]\ntarget = [0, 0, 0]\n"
                                         "fov_deg = 57.295779513\n[rope.r]\nsegments = 1\nends = " +
                                         ends));
        return valueIn(world, "in_picture(rope.r)");
    };
    EXPECT_EQ(shareOf("[[0, 1.09, 0], [0, -1.09, 0]]"), 1.0);
    EXPECT_EQ(shareOf("[[0, 1.10, 0], [0, -1.09, 0]]"), 0.5);
    EXPECT_EQ(shareOf("[[2.18, 0, 0], [-2.18, 0, 0]]"), 1.0);
    EXPECT_EQ(shareOf("[[2.19, 0, 0], [-2.19, 0, 0]]"), 0.0);
    EXPECT_EQ(shareOf("[[0, 0, 1], [0, 0, 3]]"), 0.5);  // one is behind
    EXPECT_EQ(shareOf("[[1.94, 3.88, 0], [-1.95, 0, 0]]", "[100, 200]"), 0.5);
    EXPECT_EQ(shareOf("[[1.94, 3.89, 0], [-1.94, 0, 0]]", "[100, 200]"), 0.5);
}

// A push of (2, 0, 0) N s on 1 kg and of (0, 3, 0) N s on 3 kg.
TEST(CheckFunctions, MotionFollowsFromImpulses) {
    world::World world(sceneOf("[world]\ngravity = [0, 0, 0]\n" + balls +
                               "[[at]]\nt = 0\ndo = \"push\"\ntarget = \"net.balls@a\"\nimpulse_Ns = [2, 0, 0]\n"
                               "[[at]]\nt = 0\ndo = \"push\"\ntarget = \"net.balls@b\"\nimpulse_Ns = [0, 3, 0]\n"));
    play(world, 1);
    EXPECT_NEAR(valueIn(world, "speed(net.balls)"), 2.0, rounding);
    EXPECT_NEAR(valueIn(world, "velocity(net.balls@b).y"), 1.0, rounding);
    EXPECT_EQ(placeIn(world, "speed(net.balls)").substr(0, 12), "net.balls@#0");
    EXPECT_NEAR(valueIn(world, "momentum.x"), 2.0, rounding);
    EXPECT_NEAR(valueIn(world, "momentum(net.balls).y"), 3.0, rounding);
    EXPECT_NEAR(valueIn(world, "length(momentum)"), std::sqrt(13.0), rounding);
    // L = Σ x × p about the origin: (1, 2, 3) × (2, 0, 0) = (0, 6, -4) and (5, 2, 3) × (0, 3, 0) = (-9, 0, 15).
    EXPECT_NEAR(valueIn(world, "angular_momentum(net.balls).x"), -9.0, rounding);
    EXPECT_NEAR(valueIn(world, "angular_momentum(net.balls).y"), 6.0, rounding);
    EXPECT_NEAR(valueIn(world, "angular_momentum(net.balls).z"), 11.0, rounding);
    EXPECT_NEAR(valueIn(world, "kinetic_energy"), 0.5 * 1 * 4 + 0.5 * 3 * 1, rounding);
    EXPECT_NEAR(valueIn(world, "time"), 1.0 / 60, rounding);
    for (const world::Metric& metric : world::metricTable())
        if (metric.columns == "max_speed_m_per_s")
            EXPECT_NEAR(std::get<double>(metric.value(world.metrics())), 2.0, rounding);
}

// A spring of 100 N/m drawn from 2 to 3 m, 1 kg at 5 m and 4 kg at 2 m.
TEST(CheckFunctions, EnergiesAndStrainsAreThoseOfASpring) {
    const world::World world(
        sceneOf("[net.n]\npoints = [{ name = \"a\", position = [0, 5, 0], mass_kg = 1 },"
                "{ name = \"b\", position = [0, 2, 0], mass_kg = 4 }]\n"
                "springs = [{ a = \"a\", b = \"b\", stiffness_N_per_m = 100, rest_length_m = 2 }]\n"
                "[rope.slack]\nends = [[0, 0, 0], [1, 0, 0]]\n"));
    EXPECT_NEAR(valueIn(world, "max_strain(net.n)"), 0.5, rounding);
    EXPECT_NEAR(valueIn(world, "max_strain(rope.slack)"), 0.0, rounding);
    EXPECT_EQ(placeIn(world, "max_strain"), "net.n");
    EXPECT_NEAR(valueIn(world, "elastic_energy(net.n)"), 50.0, rounding);
    EXPECT_NEAR(valueIn(world, "potential_energy(net.*)"), 9.81 * (5 + 8), 1e-11);  // numbers near 100
    EXPECT_NEAR(valueIn(world, "energy(net.n)"), 50.0 + 9.81 * 13, 1e-11);
}

// A block whose upper face is led down by a half.
TEST(CheckFunctions, VolumesAreSharesOfThoseAtRest) {
    const std::string block =
        "[world]\ngravity = [0, 0, 0]\n[block.b]\nsize = [1, 1, 1]\ncells = [2, 1, 1]\nposition = [0, 0.5, 0]\n"
        "hold = [\"bottom\"]\n";
    world::World world(sceneOf(block +
                               "[[at]]\nt = 0\ndo = \"grab\"\nid = \"h\"\nrigid = true\ntarget = \"block.b@top\"\n"
                               "[[at]]\nt = 0\ndo = \"move\"\nid = \"h\"\nto = [0, 0.5, 0]\n"));
    EXPECT_NEAR(valueIn(world, "volume(block.b)"), 1.0, rounding);
    EXPECT_NEAR(valueIn(world, "cell_volume(block.b)"), 1.0, rounding);
    EXPECT_EQ(valueIn(world, "inverted(block.*)"), 0.0);
    play(world, 1);
    EXPECT_NEAR(valueIn(world, "volume(block.b)"), 0.5, rounding);
    EXPECT_NEAR(valueIn(world, "cell_volume"), 0.5, rounding);
}

TEST(CheckFunctions, CellsTurnedInsideOutAreCounted) {
    world::World world(sceneOf(
        "[world]\ngravity = [0, 0, 0]\n[block.b]\nsize = [1, 1, 1]\ncells = [1, 1, 1]\nposition = [0, 0.5, 0]\n"
        "hold = [\"bottom\"]\n[[at]]\nt = 0\ndo = \"grab\"\nid = \"h\"\nrigid = true\ntarget = \"block.b@top\"\n"
        "[[at]]\nt = 0\ndo = \"move\"\nid = \"h\"\nto = [0, -1, 0]\n"));
    play(world, 1);
    EXPECT_EQ(valueIn(world, "inverted(block.b)"), 1.0);
    EXPECT_EQ(placeIn(world, "inverted"), "block.b");
}

// A rope of ten segments, cut at two places.
TEST(CheckFunctions, TornSpringsAreCounted) {
    world::World world(
        sceneOf("[world]\ngravity = [0, 0, 0]\n[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\nsegments = 10\n"
                "[[at]]\nt = 0\ndo = \"cut\"\ntarget = \"rope.r\"\nplane = [[0.25, 0, 0], [1, 0, 0]]\n"
                "[[at]]\nt = 0.1\ndo = \"cut\"\ntarget = \"rope.r\"\nplane = [[0.75, 0, 0], [1, 0, 0]]\n"));
    EXPECT_EQ(valueIn(world, "torn(rope.r)"), 0.0);
    play(world, 1);
    EXPECT_EQ(valueIn(world, "torn(rope.r)"), 1.0);
    play(world, 6);
    EXPECT_EQ(valueIn(world, "torn"), 2.0);
}

// Points at rest on the ground: as many contacts as points, none of them deep.
TEST(CheckFunctions, ContactsAndTheirDepthAreThoseOfABodyOnTheGround) {
    world::World world(
        sceneOf("[material.m]\n[cloth.c]\nmaterial = \"m\"\nsize = [1, 1]\ncells = [2, 2]\norigin = [0, 0.005, 0]\n"
                "down = [0, 0, 1]\nthickness = 0.005\n[collider.ground]\nshape = \"plane\"\n"));
    play(world, 30);
    EXPECT_EQ(valueIn(world, "contacts(cloth.c)"), 9.0);
    EXPECT_LE(valueIn(world, "penetration(cloth.c)"), 1e-6);  // of a state in metres to rounding of the contact
}

TEST(CheckFunctions, DepthInsideAColliderIsMeasured) {
    const world::World world(
        sceneOf("[net.n]\npoints = [{ name = \"p\", position = [0, -0.25, 0] }]\nthickness = 0\n"
                "[collider.ground]\nshape = \"plane\"\n"));
    EXPECT_NEAR(valueIn(world, "penetration(net.n)"), 0.25, rounding);
}

const std::string weightless = "[world]\ngravity = [0, 0, 0]\n";

std::string lineOf(const std::string& name, const std::string& ends, int segments = 1) {
    return "[rope." + name + "]\nends = " + ends + "\nsegments = " + std::to_string(segments) + "\n";
}

// Lines across each other, 0.3 and 0.5 m apart; the cut part of one is gone.
TEST(CheckFunctions, GapsAreBetweenTheNearestPartsOfOtherBodies) {
    world::World world(
        sceneOf(weightless + lineOf("x", "[[0, 0, 0], [3, 0, 0]]", 3) +
                lineOf("z1", "[[1.5, 0.3, -1], [1.5, 0.3, 1]]") + lineOf("z2", "[[1.5, -0.5, -1], [1.5, -0.5, 1]]") +
                "[[at]]\nt = 0.01\ndo = \"cut\"\ntarget = \"rope.x\"\nplane = [[1.5, 0, 0], [1, 0, 0]]\n"));
    EXPECT_NEAR(valueIn(world, "gap(rope.x, rope.z1)"), 0.3, rounding);
    EXPECT_NEAR(valueIn(world, "gap(rope.x, rope.z2)"), 0.5, rounding);
    EXPECT_NEAR(valueIn(world, "gap(rope.z*, rope.x)"), 0.3, rounding);
    EXPECT_NEAR(valueIn(world, "gap(rope.z*, rope.z*)"), 0.8, rounding);
    play(world, 2);
    EXPECT_NEAR(valueIn(world, "gap(rope.x, rope.z1)"), std::hypot(0.3, 0.5), 1e-6);  // to the ends of the cut
    EXPECT_THROW((void)valueIn(world, "gap(rope.x, rope.x)"), core::Error);
}

// 0.3 m apart, of which they keep 5 % more than the sum of their thicknesses while they touch.
TEST(CheckFunctions, TouchingIsWithinTheSumOfThicknesses) {
    for (const auto& [thickness, isTouching] : {std::pair{"0.1856", 0.0}, {"0.1858", 1.0}}) {
        const world::World world(sceneOf(weightless + lineOf("x", "[[0, 0, 0], [3, 0, 0]]") + "thickness = 0.1\n" +
                                         lineOf("z", "[[1.5, 0.3, -1], [1.5, 0.3, 1]]") + "thickness = " + thickness +
                                         "\n"));
        EXPECT_EQ(valueIn(world, "touching(rope.z, rope.x)"), isTouching) << thickness;
    }
}

// A line through one of the two triangles of a cloth.
TEST(CheckFunctions, CrossingsAreCountedAndHaveNoGap) {
    const std::string cloth =
        "[material.m]\n[cloth.c]\nmaterial = \"m\"\nsize = [1, 1]\ncells = [1, 1]\ndown = [0, 0, 1]\n"
        "touch = \"others\"\n";
    const world::World world(
        sceneOf(weightless + cloth + lineOf("r", "[[0.2, -1, 0.5], [0.2, 1, 0.5]]") + "touch = \"others\"\n"));
    EXPECT_EQ(valueIn(world, "gap(cloth.c, rope.r)"), 0.0);
    EXPECT_EQ(valueIn(world, "crossings()"), 1.0);
    EXPECT_EQ(valueIn(world, "crossings(rope.r)"), 1.0);
    EXPECT_EQ(valueIn(world, "body_contacts"), 0.0);
}

// Squares of a metre: one flat, one half way beside it and over it, one at 60° to the ground, one upright.
TEST(CheckFunctions, ShadowsAreThoseOfProjections) {
    const auto square = [](const std::string& name, const std::string& where) {
        return "[cloth." + name + "]\nmaterial = \"m\"\nsize = [1, 1]\ncells = [2, 2]\n" + where + "\n";
    };
    const world::World world(sceneOf("[material.m]\n" + square("flat", "down = [0, 0, 1]") +
                                     square("flatter", "origin = [0.5, 1, 0.5]\ndown = [0, 0, 1]") +
                                     square("slant", "down = [0, 0.8660254037844386, 0.5]") + square("hung", "") +
                                     lineOf("r", "[[0, 0, 0], [1, 0, 1]]") +
                                     "[solid.ball]\nshape = \"sphere\"\nradius = 0.1\nposition = [9, 0, 0]\n"));
    // A ball as it is drawn, with 32 sides.
    EXPECT_NEAR(valueIn(world, "shadow(solid.ball, y)"), 16 * std::sin(3.14159265358979 / 16) * 0.01, 1e-6);
    EXPECT_NEAR(valueIn(world, "shadow(cloth.flat, y)"), 1.0, rounding);
    EXPECT_NEAR(valueIn(world, "shadow(cloth.flat*, y)"), 1.75, rounding);
    EXPECT_NEAR(valueIn(world, "shadow(cloth.slant, y)"), 0.5, rounding);
    EXPECT_NEAR(valueIn(world, "shadow(cloth.slant, z)"), 0.8660254037844386, rounding);
    EXPECT_NEAR(valueIn(world, "shadow(cloth.slant, x)"), 0.0, rounding);
    EXPECT_NEAR(valueIn(world, "shadow(cloth.hung, z)"), 1.0, rounding);
    EXPECT_EQ(valueIn(world, "shadow(rope.r, y)"), 0.0);
}

TEST(CheckFunctions, ShadowsLoseWhatIsTorn) {
    world::World world(sceneOf(weightless + "[material.m]\n[cloth.c]\nmaterial = \"m\"\nsize = [1, 1]\ncells = [4, 4]\n"
                                            "[[at]]\nt = 0\ndo = \"cut\"\ntarget = \"cloth.c\"\n"));
    EXPECT_NEAR(valueIn(world, "shadow(cloth.c, z)"), 1.0, rounding);
    play(world, 1);
    EXPECT_EQ(valueIn(world, "shadow(cloth.c, z)"), 0.0);
}

// A fan of 720 triangles, once and again turned within itself; two triangles that make a star of six points, of which
// each is 1/9 of a triangle; two specks a kilometre apart.
TEST(CheckFunctions, CoveredAreasCountEachPlaceOnce) {
    const auto corner = [](double degrees) {
        return glm::dvec2(std::cos(degrees * 3.141592653589793 / 180), std::sin(degrees * 3.141592653589793 / 180));
    };
    std::vector<FlatTriangle> disc;
    for (int i = 0; i < 720; ++i) disc.push_back({glm::dvec2(0.0), corner(0.5 * i), corner(0.5 * (i + 1))});
    const double area = 360 * std::sin(3.141592653589793 / 360);
    EXPECT_NEAR(coveredArea(disc), area, rounding);
    for (int i = 0; i < 720; ++i)
        disc.push_back({glm::dvec2(0.1, 0), 0.8 * corner(7 + 0.5 * i), 0.8 * corner(7.5 + 0.5 * i)});
    EXPECT_NEAR(coveredArea(disc), area, rounding);
    const double triangle = 0.75 * std::sqrt(3.0);
    EXPECT_NEAR(coveredArea({{corner(90), corner(210), corner(330)}, {corner(30), corner(150), corner(270)}}),
                triangle * 4 / 3, 1e-6);  // six crossings, a strip of 7.5e-4 squared over 8 each
    const auto speck = [](double y) { return FlatTriangle{glm::dvec2(0, y), {2e-3, y}, {0, y + 1e-3}}; };
    EXPECT_NEAR(coveredArea({speck(0), speck(1000)}), 2e-6, 1e-15);  // rounding of 1000 m
}

TEST(CheckFunctions, NumbersAreComputedLikeNumbers) {
    const world::World world(sceneOf(balls));
    EXPECT_NEAR(valueIn(world, "2 + 3 * 4 - 6 / 4 + time"), 12.5, rounding);
    EXPECT_NEAR(valueIn(world, "-(2 + 3) * -(4 - 1) + time"), 15.0, rounding);
    EXPECT_NEAR(valueIn(world, "abs(1 - 4) + abs(2) + time"), 5.0, rounding);
    EXPECT_NEAR(valueIn(world, "length([2, 3, 6] / 7 * 2) + time"), 2.0, rounding);
    EXPECT_NEAR(valueIn(world, "8 / 4 / 2 + time"), 1.0, rounding);
    EXPECT_NEAR(valueIn(world, "(position(net.balls@a) + 2 * [1, 1, 1]).z"), 5.0, rounding);
    EXPECT_TRUE(std::isnan(valueIn(world, "(time - time) / 0")));
}

TEST(CheckFunctions, EveryOneStandsInTheManualWithAHelp) {
    const std::string manual = functionsManual();
    for (const Function& function : functionTable()) {
        EXPECT_NE(manual.find("  " + function.signature() + " "), std::string::npos) << function.name;
        EXPECT_NE(manual.find(function.help), std::string::npos) << function.name;
        EXPECT_TRUE(function.help.ends_with('.')) << function.name;
        EXPECT_EQ(std::count_if(functionTable().begin(), functionTable().end(),
                                [&](const Function& f) { return f.name == function.name; }),
                  1)
            << function.name;
    }
}

}  // namespace
}  // namespace taut::check
