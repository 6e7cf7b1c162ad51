// Fields of a scene that change while it runs, against integrals and new equilibria.
#include <gtest/gtest.h>

#include <cmath>

#include "support/timelines.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/forces/anchor.h"
#include "taut/forces/wind.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using support::run;
using Affects = fields::Affects;
using support::g;

double& gravityOf(SceneSpec& s) {
    return s.world.gravity.y;
}

SceneSpec rampedMass(double stiffness = 1e-9) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    NetSpec net;
    net.name = "ball";
    net.drag = 0;
    net.points = {{"m", {0, 0, 0}, 2.0, false, {}}, {"wall", {0, 1, 0}, 1.0, true, {}}};
    net.springs = {{"m", "wall", stiffness, 1.0, std::nullopt, {}}};
    scene.bodies.add(net);
    return scene;
}

// From rest under a = -g t/T for T: v = -g T/2, x = -g T²/6; then a = -g.
TEST(Ramps, GravityThatRisesEvenlyMakesTheFallThatItsIntegralSays) {
    for (const int substeps : {1, 4}) {
        SceneSpec scene = rampedMass();
        scene.world.gravity = dvec3(0.0);
        scene.solver.dt = 1.0 / 60 / substeps;
        scene.actions = {support::ramp(0.0, "world.gravity", Affects::forces, -g, 0.5, Ease::linear, gravityOf)};
        World world(scene);
        run(world, 30);
        const PointsNow now = world.points("net.ball@m");
        // Leap-frog's kicks are trapezia, which a straight line has exactly; but its first half step takes a for
        // constant, so that places are off by T h² (g/T)/6.
        EXPECT_NEAR(now.v[0].y, -g * 0.5 / 2, 1e-9);
        EXPECT_NEAR(now.x[0].y, -g * 0.25 / 6, 1.01 * g / 6 / 3600 / substeps / substeps);
        run(world, 30);
        EXPECT_NEAR(world.points("net.ball@m").v[0].y, -g * 0.25 - g * 0.5, 1e-9);
    }
}

TEST(Ramps, AtOnceMeansFromTheStartOfTheTick) {
    SceneSpec scene = rampedMass();
    scene.world.gravity = dvec3(0.0);
    scene.actions = {support::ramp(0.1, "world.gravity", Affects::forces, -g, 0.0, Ease::smooth, gravityOf)};
    World world(scene);
    run(world, 6);
    EXPECT_EQ(world.points("net.ball@m").v[0].y, 0.0);
    run(world, 6);
    EXPECT_NEAR(world.points("net.ball@m").v[0].y, -g * 0.1, 1e-9);
    EXPECT_NEAR(world.points("net.ball@m").x[0].y, -g * 0.01 / 2, 1e-9);
}

TEST(Ramps, ALaterRampTakesOverFromTheValueOfTheMoment) {
    SceneSpec scene = rampedMass();
    scene.world.gravity = dvec3(0.0);
    scene.actions = {support::ramp(0.0, "world.gravity", Affects::forces, -8, 0.4, Ease::linear, gravityOf),
                     support::ramp(0.2, "world.gravity", Affects::forces, 0, 0.2, Ease::linear, gravityOf)};
    World world(scene);
    run(world, 60);
    EXPECT_NEAR(world.points("net.ball@m").v[0].y, -4 * 0.2 / 2 - 4 * 0.2 / 2, 1e-9);  // up to 4 and down again
}

// m g = k x for 300 N/m, and then for 900 N/m.
TEST(Ramps, StiffnessMovesTheEquilibrium) {
    SceneSpec scene = rampedMass(300);
    scene.bodies.of<NetSpec>()[0].drag = 10;
    scene.actions = {
        support::ramp(3.0, "net.ball.stiffness", Affects::springs, 900.0, 0.5, Ease::smooth,
                      [](SceneSpec& s) -> double& { return s.bodies.of<NetSpec>()[0].springs[0].stiffness; })};
    World world(scene);
    run(world, 180);
    EXPECT_NEAR(world.points("net.ball@m").x[0].y, -2 * g / 300, 1e-6);  // e^{-5·3} of the start
    run(world, 210);
    EXPECT_NEAR(world.points("net.ball@m").x[0].y, -2 * g / 900, 1e-6);
}

TEST(Ramps, AMaterialChangesEveryClothThatIsOfIt) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    MaterialSpec soft;
    soft.stretch = 200;
    soft.drag = 4;
    scene.materials = {{"silk", soft}, {"felt", soft}};
    scene.bodies.add(support::cloth("a", 3), support::cloth("b", 3));
    scene.bodies.of<ClothSpec>()[0].material = "silk";
    scene.bodies.of<ClothSpec>()[1].material = "felt";
    for (ClothSpec& cloth : scene.bodies.of<ClothSpec>()) cloth.hold = {"top"};
    scene.actions = {support::ramp(3.0, "material.silk.stretch_N_per_m", Affects::springs, 800.0, 0.5, Ease::smooth,
                                   [](SceneSpec& s) -> double& { return s.materials["silk"].stretch; })};
    World world(scene);
    const double rest = world.points("cloth.a@bottom-left").x[0].y;
    run(world, 420);
    const double a = rest - world.points("cloth.a@bottom-left").x[0].y;
    const double b = rest - world.points("cloth.b@bottom-left").x[0].y;
    EXPECT_NEAR(b / a, 4.0, 0.1);  // sag goes with 1/k while strains are small: here 0.5 %
}

// A wind of twice the speed presses four times as hard: on a held cloth the hold takes it, so on one point's spring.
TEST(Ramps, WindThatRisesPressesWithItsSquare) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    MaterialSpec board;
    board.stretch = 2e4;
    board.drag = 20;
    scene.materials = {{"board", board}};
    scene.bodies.add(support::cloth("sail", 2));
    scene.bodies.of<ClothSpec>()[0].material = "board";
    AnchorSpec springs;
    springs.name = "springs";
    springs.target = "cloth.sail";
    springs.at = {0.5, 1.5, 0};
    springs.stiffness = 0;
    WindSpec wind;
    wind.name = "breeze";
    wind.velocity = {0, 0, 2};
    scene.forces.add(wind);
    auto grab = support::grab(0.0, "cloth.sail");  // keeps the shape, yields as one
    grab.strength = 500;
    grab.dampingRatio = 1;
    scene.actions = {grab,
                     support::ramp(2.0, "wind.breeze.velocity", Affects::forces, 4.0, 0.5, Ease::smooth,
                                   [](SceneSpec& s) -> double& { return s.forces.of<WindSpec>()[0].velocity.z; })};
    World world(scene);
    const auto pressed = [&] {
        dvec3 mean(0.0);
        const PointsNow now = world.points("cloth.sail");
        for (std::size_t i = 0; i < now.x.size(); ++i) mean += now.mass[i] / 0.2 * now.x[i];
        return mean.z;
    };
    run(world, 120);
    // ½ρ C_D A u² / K, corners pressed by a third of each triangle; all points are held alike.
    EXPECT_NEAR(pressed(), 0.5 * 1.2 * 4 / 500, 2e-5);
    run(world, 150);
    EXPECT_NEAR(pressed(), 0.5 * 1.2 * 16 / 500, 2e-4);
}

TEST(Ramps, PicturesShowTheValueOfTheirTime) {
    SceneSpec scene = rampedMass();
    scene.light.intensity = 1.0;
    CameraSpec camera;
    camera.name = "main";
    camera.eye = {0, 1, 4};
    scene.cameras = {camera};
    scene.actions = {support::ramp(0.1, "light.intensity", Affects::picture, 3.0, 0.2, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.light.intensity; }),
                     support::ramp(0.1, "camera.main.eye", Affects::picture, 8.0, 0.2, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.cameras[0].eye.z; })};
    World world(scene);
    const float dim = world.view(false).light.colour.x;
    run(world, 6);
    EXPECT_EQ(world.view(false).light.colour.x, dim);
    run(world, 6);
    EXPECT_NEAR(world.view(false).light.colour.x, 2 * dim, 1e-6);
    EXPECT_NEAR(world.view(false).camera.eye.z, 6.0, 1e-6);
    run(world, 20);
    EXPECT_NEAR(world.view(false).light.colour.x, 3 * dim, 1e-6);
    EXPECT_NEAR(world.view(false).camera.eye.z, 8.0, 1e-6);
}

// On a slope of 20° a mass slides iff tan 20° = 0.364 > μ; it gains g (sin 20° - μ cos 20°) a second.
TEST(Ramps, FrictionThatFallsLetsThingsSlide) {
    SceneSpec scene = rampedMass();
    scene.bodies.of<NetSpec>()[0].thickness = 0;
    scene.solver.dt = 1.0 / 960;
    ColliderSpec slope = support::ground();
    const double angle = 20.0 * 3.14159265358979323846 / 180;
    slope.normal = {std::sin(angle), std::cos(angle), 0};
    slope.friction = 0.6;
    scene.colliders = {slope};
    scene.actions = {support::ramp(0.5, "collider.ground.friction", Affects::colliders, 0.1, 0.0, Ease::linear,
                                   [](SceneSpec& s) -> double& { return s.colliders[0].friction; })};
    World world(scene);
    run(world, 20);
    const dvec3 start = world.points("net.ball@m").x[0];
    run(world, 10);
    EXPECT_EQ(world.points("net.ball@m").x[0], start);  // it sticks to the bit
    run(world, 30);
    const double slid = glm::length(world.points("net.ball@m").x[0] - start);
    const double a = g * (std::sin(angle) - 0.1 * std::cos(angle));
    EXPECT_NEAR(slid, 0.5 * a * 0.25, 0.01 * slid);  // contact is of order 1 in the step: measured 0.2 %
}

}  // namespace
}  // namespace taut::world
