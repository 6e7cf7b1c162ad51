// Every field of the format lands in its member, and its default is that of the struct.
#include <cmath>
#include <set>

#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/bodies/rope.h"
#include "taut/bodies/solid.h"
#include "taut/core/trig.h"
#include "taut/forces/anchor.h"
#include "taut/forces/wind.h"
#include "taut/joints/joints.h"
#include "taut/scene/private/document.h"
#include "taut/scene/private/sections.h"
#include "unit/scene_full_text.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

using core::radians;
using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

world::SceneSpec fullSpec() {
    const AssetFolder folder;
    return folder.load(fullScene).spec;
}

template <class All>
auto& named(const All& all, const std::string& name) {
    for (auto& one : all)
        if (one.name == name) return one;
    throw std::runtime_error("there is no " + name);
}

// Angles pass through one multiplication, so that the last bit may differ.
void expectNear(const dvec3& a, const dvec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-15);
}

TEST(SceneFields, SettingsLandInTheirMembers) {
    const world::SceneSpec scene = fullSpec();
    EXPECT_EQ(scene.title, "everything");
    EXPECT_EQ(scene.need.rmsPosition, 1e-3);
    EXPECT_EQ(scene.need.rmsPercent, 2.5);
    EXPECT_EQ(scene.need.rmsPixels, 3.5);
    EXPECT_EQ(scene.need.horizon, 0.75);
    EXPECT_EQ(scene.need.budget, 16.0);
    EXPECT_EQ(scene.solver.integrator, "velocity-verlet");
    EXPECT_EQ(scene.solver.dt, 1e-3);
    EXPECT_EQ(scene.solver.safety, 0.8);
    EXPECT_EQ(scene.solver.newtonSteps, 4);
    EXPECT_EQ(scene.solver.cgTolerance, 1e-7);
    EXPECT_EQ(scene.solver.cgIterations, 300);
    EXPECT_EQ(scene.solver.sleepError, 2e-4);
    EXPECT_EQ(scene.solver.precision, world::Precision::double_);
    EXPECT_EQ(scene.world.gravity, dvec3(0.5, -1.62, 0.25));
    EXPECT_EQ(scene.world.airDensity, 0.02);
    EXPECT_EQ(scene.run.fps, 30.0);
    EXPECT_EQ(scene.run.seconds, 4.5);
    EXPECT_EQ(scene.picture.size, ivec2(640, 360));
    EXPECT_EQ(scene.picture.camera, "main");
    EXPECT_EQ(scene.picture.samples, 1);
    EXPECT_EQ(scene.picture.shadowSize, 1024);
    EXPECT_EQ(scene.picture.smooth, 1);
}

TEST(SceneFields, LightsAndBackgroundLandInTheirMembers) {
    const world::SceneSpec scene = fullSpec();
    EXPECT_EQ(scene.light.direction, dvec3(1, -2, 3));
    EXPECT_EQ(scene.light.colour, dvec3(1.0, 128.0 / 255.0, 0.0));
    EXPECT_EQ(scene.light.intensity, 2.5);
    EXPECT_EQ(scene.light.softness, radians(9.0));
    EXPECT_EQ(scene.light.sky, dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(scene.light.ground, dvec3(0.4, 0.5, 0.6));
    EXPECT_EQ(scene.light.ambient, 0.7);
    EXPECT_TRUE(scene.environment.image.ends_with("/square.png")) << scene.environment.image;
    EXPECT_EQ(scene.environment.strength, 1.5);
    EXPECT_EQ(scene.environment.turn, radians(-90.0));
    EXPECT_FALSE(scene.environment.visible);
    ASSERT_EQ(scene.lamps.size(), 1U);
    EXPECT_EQ(scene.lamps[0].name, "rim");
    EXPECT_EQ(scene.lamps[0].direction, dvec3(2, -1, 0));
    EXPECT_EQ(scene.lamps[0].colour, dvec3(0.2, 0.4, 0.6));
    EXPECT_EQ(scene.lamps[0].intensity, 1.5);
    EXPECT_EQ(scene.lamps[0].softness, radians(18.0));
    EXPECT_FALSE(scene.lamps[0].shadow);
    EXPECT_EQ(scene.background.top, dvec3(0.11, 0.12, 0.13));
    EXPECT_EQ(scene.background.horizon, dvec3(0.21, 0.22, 0.23));
    EXPECT_EQ(scene.background.fadeStart, 9.0);
    EXPECT_EQ(scene.background.fadeEnd, 31.0);
}

TEST(SceneFields, MaterialLandsInItsMembers) {
    const world::MaterialSpec silk = fullSpec().materials.at("silk");
    EXPECT_EQ(silk.density, 0.07);
    EXPECT_EQ(silk.stretch, 300.0);
    EXPECT_EQ(silk.shear, 120.0);
    EXPECT_EQ(silk.bend, 0.2);
    EXPECT_EQ(silk.rigidity.warp, 3e-6);
    EXPECT_EQ(silk.rigidity.weft, 2e-6);
    EXPECT_EQ(silk.rigidity.bias, 1e-6);
    EXPECT_EQ(silk.friction.hysteresis, 4e-4);
    EXPECT_EQ(silk.friction.yield, 5.5);
    EXPECT_EQ(silk.dampingTime, 2e-4);
    EXPECT_EQ(silk.drag, 0.4);
    EXPECT_EQ(silk.lumping, mechanics::Lumping::uniform);
}

TEST(SceneFields, ANumberInPlaceOfATableIsItsMainField) {
    const AssetFolder folder;
    const world::MaterialSpec felt =
        folder.load("schema = 1\n[material.felt]\nbending_rigidity_N_m = 2e-5\n").spec.materials.at("felt");
    EXPECT_EQ(felt.rigidity.warp, 2e-5);
    EXPECT_EQ(felt.rigidity.weft, std::nullopt);
    EXPECT_EQ(felt.bend, 0.0) << "the springs of textbooks give way to it";
}

void expectCommonMembers(const world::BodySpec& body, const AssetFolder& folder) {
    SCOPED_TRACE(body.name);
    EXPECT_EQ(body.velocity, dvec3(1, 2, 3));
    EXPECT_EQ(body.spin, dvec3(4, 5, 6));
    EXPECT_EQ(body.jitter, 0.001);
    EXPECT_EQ(body.seed, 9);
    EXPECT_EQ(body.friction, 0.9);
    EXPECT_EQ(body.restitution, 0.6);
    EXPECT_EQ(body.thickness, 0.01);
    EXPECT_FALSE(body.collide);
    EXPECT_EQ(body.finish.colour, dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(body.finish.backColour, dvec3(0.4, 0.5, 0.6));
    EXPECT_EQ(body.finish.accent, dvec3(0.7, 0.8, 0.9));
    EXPECT_EQ(body.finish.pattern, view::Pattern::image);
    EXPECT_EQ(body.finish.repeat, 0.3);
    EXPECT_EQ(body.finish.weave, 0.4);
    EXPECT_EQ(body.finish.binding, view::Binding::satin);
    EXPECT_EQ(body.finish.thread, 0.02);
    EXPECT_EQ(body.finish.slub, 0.15);
    EXPECT_EQ(body.finish.fuzz, 0.25);
    EXPECT_EQ(body.finish.roughness, 0.5);
    EXPECT_EQ(body.finish.sheen, 0.6);
    EXPECT_EQ(body.finish.anisotropy, 0.45);
    EXPECT_EQ(body.finish.skin, (folder / "square.obj").string());
    EXPECT_EQ(body.finish.texture, (folder / "square.png").string());
    EXPECT_EQ(body.solver.integrator, "euler");
    EXPECT_EQ(body.solver.dt, 2e-4);
    EXPECT_EQ(body.solver.safety, 0.7);
    EXPECT_EQ(body.solver.newtonSteps, 5);
    EXPECT_EQ(body.solver.cgTolerance, 1e-8);
    EXPECT_EQ(body.solver.cgIterations, 400);
    EXPECT_EQ(body.array.count, ivec3(2, 3, 4));
    EXPECT_EQ(body.array.stepX, dvec3(1, 0, 0));
    EXPECT_EQ(body.array.stepY, dvec3(0, 2, 0));
    EXPECT_EQ(body.array.stepZ, dvec3(0, 0, 3));
}

TEST(SceneFields, CommonKeysSetTheMembersOfEveryBody) {
    const AssetFolder folder;
    const world::SceneSpec scene = folder.load(fullScene).spec;
    const world::BodySpec& flag = named(scene.bodies.of<world::ClothSpec>(), "flag");
    EXPECT_EQ(flag.hold, (std::vector<std::string>{"left", "#7", "(0.5,1)"}));
    EXPECT_EQ(flag.holdOn, "collider.ball");
    EXPECT_EQ(flag.source.file, (folder / "s.toml").string());
    EXPECT_EQ(flag.source.line, 73);
    EXPECT_EQ(flag.source.column, 8);
    expectCommonMembers(flag, folder);

    // The same lines in bodies of the other kinds.
    const std::string full = fullScene;
    const std::size_t first = full.find("velocity = [1, 2, 3]");
    const std::string common = full.substr(first, full.find("[cloth.shirt]") - first);
    const world::SceneSpec others =
        folder
            .load("schema = 1\n[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\n" + common + "[block.b]\nhold = [\"all\"]\n" +
                  common + "[net.n]\npoints = [{ name = \"a\", position = [0, 0, 0] }]\nhold = [\"a\"]\n" + common)
            .spec;
    expectCommonMembers(others.bodies.of<world::RopeSpec>()[0], folder);
    expectCommonMembers(others.bodies.of<world::BlockSpec>()[0], folder);
    expectCommonMembers(others.bodies.of<world::NetSpec>()[0], folder);
    EXPECT_EQ(others.bodies.of<world::BlockSpec>()[0].hold, std::vector<std::string>{"all"});
    EXPECT_EQ(others.bodies.of<world::NetSpec>()[0].hold, std::vector<std::string>{"a"});
}

TEST(SceneFields, ClothsLandInTheirMembers) {
    const AssetFolder folder;
    const world::SceneSpec scene = folder.load(fullScene).spec;
    const world::ClothSpec& flag = named(scene.bodies.of<world::ClothSpec>(), "flag");
    EXPECT_EQ(flag.size, dvec2(1.8, 1.2));
    EXPECT_EQ(flag.cells, ivec2(36, 24));
    EXPECT_EQ(flag.origin, dvec3(0.5, 3, 0.25));
    EXPECT_EQ(flag.across, dvec3(0, 0, 1));  // made a unit vector
    EXPECT_NEAR(flag.grain, radians(90.0), 1e-15);
    EXPECT_EQ(flag.down, dvec3(0, -1, 0));
    EXPECT_EQ(flag.material, "silk");
    EXPECT_EQ(flag.meshData, nullptr);
    const world::ClothSpec& shirt = named(scene.bodies.of<world::ClothSpec>(), "shirt");
    EXPECT_EQ(shirt.mesh, (folder / "square.obj").string());
    ASSERT_NE(shirt.meshData, nullptr);
    EXPECT_EQ(shirt.meshData->positions.size(), 4U);
    EXPECT_EQ(shirt.position, dvec3(1, 2, 3));
    expectNear(shirt.rotation, {core::pi / 2, core::pi, core::pi / 4});
    EXPECT_EQ(shirt.scale, 0.01);
    const world::ClothSpec& front = named(scene.bodies.of<world::ClothSpec>(), "front");
    EXPECT_EQ(front.corners, (std::vector<dvec2>{{0, 0}, {0.4, 0}, {0.5, 0.6}, {0, 0.5}}));
    ASSERT_EQ(front.holes.size(), 1U);
    EXPECT_EQ(front.holes[0].corners, (std::vector<dvec2>{{0.1, 0.2}, {0.2, 0.2}, {0.15, 0.3}}));
    ASSERT_EQ(front.edges.size(), 1U);
    EXPECT_EQ(front.edges[0].name, "hem");
    EXPECT_EQ(front.edges[0].corners, ivec2(1, 0));
    EXPECT_EQ(front.cell, 0.05);
    EXPECT_NE(front.meshData, nullptr);
}

TEST(SceneFields, RopeAndBlockLandInTheirMembers) {
    const world::SceneSpec scene = fullSpec();
    const world::RopeSpec& rail = named(scene.bodies.of<world::RopeSpec>(), "rail");
    EXPECT_EQ(rail.start, dvec3(-4, 2, 1));
    EXPECT_EQ(rail.end, dvec3(-1, 2.5, 1.5));
    EXPECT_EQ(rail.segments, 12);
    EXPECT_EQ(rail.length, 3.5);
    EXPECT_EQ(rail.mass, 2.5);
    EXPECT_EQ(rail.stretch, 4e4);
    EXPECT_EQ(rail.bend, 6.0);
    EXPECT_EQ(rail.rigidity, 7e-6);
    EXPECT_EQ(rail.dampingTime, 3e-4);
    EXPECT_EQ(rail.drag, 0.6);
    EXPECT_EQ(rail.radius, 0.03);
    EXPECT_EQ(rail.lumping, mechanics::Lumping::uniform);
    EXPECT_EQ(rail.hold, (std::vector<std::string>{"ends", "25%"}));
    const world::RopeSpec& winding = named(scene.bodies.of<world::RopeSpec>(), "winding");
    ASSERT_EQ(winding.through.size(), 2U);
    EXPECT_EQ(winding.through[1].position, dvec3(0.6, 5, 1.3));
    EXPECT_TRUE(winding.isClosed);
    const world::BlockSpec& jelly = named(scene.bodies.of<world::BlockSpec>(), "jelly");
    EXPECT_EQ(jelly.size, dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(jelly.cells, ivec3(2, 3, 5));
    EXPECT_EQ(jelly.position, dvec3(7, 8, 9));
    expectNear(jelly.rotation, {0, core::pi / 2, 0});
    EXPECT_EQ(jelly.density, 950.0);
    EXPECT_EQ(jelly.young, 1e4);
    EXPECT_EQ(jelly.bulk, 3e4);
    EXPECT_EQ(named(scene.bodies.of<world::BlockSpec>(), "rubber").poisson, 0.45);
    const world::BlockSpec& bear = named(scene.bodies.of<world::BlockSpec>(), "teddy");
    ASSERT_NE(bear.meshData, nullptr);
    EXPECT_EQ(bear.cell, 0.3);
    EXPECT_EQ(bear.scale, 2.0);
    EXPECT_EQ(bear.position, dvec3(7, 8, 10));
    EXPECT_EQ(jelly.dampingTime, 4e-4);
    EXPECT_EQ(jelly.drag, 0.7);
    EXPECT_EQ(jelly.workingStretch, 2.0);
    EXPECT_EQ(jelly.lumping, mechanics::Lumping::uniform);
}

TEST(SceneFields, NetLandsInItsMembers) {
    const world::SceneSpec scene = fullSpec();
    const world::NetSpec& net = named(scene.bodies.of<world::NetSpec>(), "cradle");
    ASSERT_EQ(net.points.size(), 2U);
    EXPECT_EQ(net.points[0].name, "a");
    EXPECT_EQ(net.points[0].position, dvec3(0, 1, 0));
    EXPECT_EQ(net.points[0].mass, 3.0);
    EXPECT_TRUE(net.points[0].hold);
    EXPECT_FALSE(net.points[1].hold);
    EXPECT_EQ(net.points[1].source.line, 150);
    ASSERT_EQ(net.springs.size(), 1U);
    EXPECT_EQ(net.springs[0].a, "a");
    EXPECT_EQ(net.springs[0].b, "b");
    EXPECT_EQ(net.springs[0].stiffness, 20.0);
    EXPECT_EQ(net.springs[0].restLength, 0.5);
    EXPECT_EQ(net.springs[0].dampingTime, 5e-4);
    EXPECT_EQ(net.dampingTime, 6e-4);
    EXPECT_EQ(net.drag, 0.8);
    EXPECT_EQ(net.radius, 0.04);
    EXPECT_EQ(net.ball, 0.07);
}

TEST(SceneFields, SolidsLandInTheirMembers) {
    const world::SceneSpec scene = fullSpec();
    EXPECT_EQ(scene.contact.restitution, 0.35);
    const world::SolidSpec& crate = named(scene.bodies.of<world::SolidSpec>(), "crate");
    EXPECT_EQ(crate.size, dvec3(0.3, 0.4, 0.5));
    EXPECT_EQ(crate.edge, 0.01);
    EXPECT_EQ(crate.position, dvec3(9, 8, 7));
    expectNear(crate.rotation, {0, 0, core::pi / 6});
    EXPECT_EQ(crate.density, 700.0);
    EXPECT_EQ(crate.drag, 0.05);
    EXPECT_EQ(crate.turnFriction.rolling, 0.003);
    EXPECT_EQ(crate.turnFriction.spin, 0.004);
    EXPECT_EQ(crate.touch, world::Touch::others);
    const world::SolidSpec& pill = named(scene.bodies.of<world::SolidSpec>(), "pill");
    EXPECT_EQ(pill.height, 0.2);
    EXPECT_EQ(pill.thickness, 0.06);
    EXPECT_EQ(pill.mass, 0.8);
    const world::SolidSpec& stone = named(scene.bodies.of<world::SolidSpec>(), "stone");
    ASSERT_NE(stone.meshData, nullptr);
    EXPECT_EQ(stone.scale, 0.5);
}

TEST(SceneFields, TiesAndWindLandInTheirMembers) {
    const world::SceneSpec scene = fullSpec();
    ASSERT_EQ(scene.joints.size(), 7U);
    EXPECT_EQ(scene.joints.of<world::SeamJoint>().at(0).over, 2.0);
    EXPECT_EQ(scene.joints[6].breakForce, 13.0);
    const world::JointSpec& spring = scene.joints[0];
    EXPECT_EQ(spring.a.targets, std::vector<std::string>{"rope.rail@end"});
    EXPECT_EQ(spring.b.targets, std::vector<std::string>{"net.cradle@b"});
    EXPECT_EQ(spring.name, "peg");
    EXPECT_EQ(spring.breakForce, 12.0);
    EXPECT_EQ(spring.look.turns, 6);
    EXPECT_EQ(spring.look.radius, 0.003);
    EXPECT_EQ(spring.look.coil, 0.02);
    ASSERT_TRUE(spring.look.finish);
    EXPECT_EQ(spring.look.finish->colour, dvec3(1, 0, 0));
    EXPECT_EQ(scene.joints.of<world::SpringJoint>().at(0).restLength, 0.4);
    EXPECT_EQ(scene.joints[1].a.text(), "rope.rail@start, rope.rail@50%");
    EXPECT_FALSE(scene.joints[1].isDrawn());
    EXPECT_EQ(scene.joints.of<world::SpringJoint>().at(0).stiffness, 50.0);
    EXPECT_EQ(scene.joints.of<world::SpringJoint>().at(0).dampingTime, 7e-4);
    EXPECT_EQ(scene.joints[1].kind(), "weld");
    EXPECT_EQ(scene.joints[1].reach(), 0.05);
    EXPECT_EQ(scene.joints.of<world::RodJoint>().at(0).place, world::dvec3(0, 1, 2.5));
    const world::HingeJoint& hinge = scene.joints.of<world::HingeJoint>().at(0);
    EXPECT_GT(hinge.axis.y, 0.0);
    EXPECT_NEAR(hinge.limits->x, -0.5 * core::pi, 1e-15);
    EXPECT_NEAR(hinge.limits->y, core::pi, 1e-15);
    EXPECT_EQ(hinge.friction, 0.3);
    EXPECT_EQ(hinge.damping, 0.4);
    EXPECT_EQ(hinge.motorSpeed, -2.0);
    EXPECT_EQ(hinge.motorMost, 6.0);
    EXPECT_TRUE(hinge.touch);
    EXPECT_NEAR(*scene.joints.of<world::BallJoint>().at(0).cone, 0.5 * core::pi, 1e-15);
    EXPECT_EQ(scene.joints.of<world::RodJoint>().at(0).placeIn, world::JointSpec::PlaceIn::world);
    EXPECT_EQ(hinge.placeIn, world::JointSpec::PlaceIn::side);
    const world::SliderJoint& slider = scene.joints.of<world::SliderJoint>().at(0);
    EXPECT_EQ(*slider.limits, glm::dvec2(-1, 2));
    EXPECT_EQ(slider.friction, 0.5);
    EXPECT_EQ(slider.damping, 0.6);
    EXPECT_EQ(slider.motorSpeed, -0.7);
    EXPECT_EQ(slider.motorMost, 8.0);
    ASSERT_EQ(scene.masses.size(), 1U);
    EXPECT_EQ(scene.masses[0].target, "block.jelly@corners");
    EXPECT_EQ(scene.masses[0].mass, 1.5);
    const world::AnchorSpec& hand = named(scene.forces.of<world::AnchorSpec>(), "hand");
    EXPECT_EQ(hand.target, "cloth.flag.*@top-left");
    EXPECT_EQ(hand.at, dvec3(1, 2, 4));
    EXPECT_EQ(hand.stiffness, 60.0);
    EXPECT_EQ(hand.damping, 0.9);
    const world::WindSpec& wind = named(scene.forces.of<world::WindSpec>(), "breeze");
    EXPECT_EQ(wind.velocity, dvec3(6, 0, 1));
    EXPECT_EQ(wind.gustAmplitude, 2.5);
    EXPECT_EQ(wind.gustPeriod, 1.7);
    EXPECT_EQ(wind.gustLength, 3.0);
    EXPECT_EQ(wind.gustSeed, 7);
    EXPECT_EQ(wind.drag, 1.1);
    EXPECT_EQ(wind.lift, 0.5);
    EXPECT_EQ(wind.on, std::vector<std::string>{"cloth.flag.*"});
}

TEST(SceneFields, CollidersLandInTheirMembers) {
    const AssetFolder folder;
    const world::SceneSpec scene = folder.load(fullScene).spec;
    const world::ColliderSpec& ball = named(scene.colliders, "ball");
    EXPECT_EQ(ball.shape, "sphere");
    EXPECT_EQ(ball.position, dvec3(0, 1, 2));
    expectNear(ball.rotation, {0, 0, core::pi / 2});
    EXPECT_EQ(ball.radius, 0.4);
    EXPECT_EQ(ball.friction, 0.6);
    EXPECT_EQ(ball.restitution, 0.5);
    EXPECT_EQ(ball.turnFriction.rolling, 0.001);
    EXPECT_EQ(ball.turnFriction.spin, 0.002);
    EXPECT_FALSE(ball.visible);
    EXPECT_EQ(ball.finish.colour, dvec3(0, 0, 1));
    const world::ColliderSpec& body = named(scene.colliders, "body");
    EXPECT_EQ(body.mesh, (folder / "square.obj").string());
    EXPECT_EQ(body.scale, 0.02);
    ASSERT_NE(body.meshData, nullptr);
    EXPECT_EQ(named(scene.colliders, "floor").normal, dvec3(0, 1, 0));  // made a unit vector
    EXPECT_EQ(named(scene.colliders, "post").height, 2.5);
    const world::ColliderSpec& lift = named(scene.colliders, "lift");
    EXPECT_EQ(lift.size, dvec3(1, 2, 3));
    EXPECT_EQ(lift.edge, 0.05);
    ASSERT_EQ(lift.keys.size(), 2U);
    EXPECT_EQ(lift.keys[0].t, 0.5);
    EXPECT_EQ(lift.keys[0].position, dvec3(1, 0, 0));
    expectNear(lift.keys[0].rotation, {0, core::pi, 0});
    EXPECT_EQ(lift.keys[0].ease, world::Ease::in);
    const world::ColliderSpec& table = named(scene.colliders, "table");
    ASSERT_EQ(table.parts.size(), 3U);
    EXPECT_EQ(table.parts[0].shape, "box");
    EXPECT_EQ(table.parts[0].size, dvec3(2, 0.1, 1));
    EXPECT_EQ(table.parts[0].position, dvec3(0, 1, 0));
    expectNear(table.parts[0].rotation, {core::pi / 2, 0, 0});
    EXPECT_EQ(table.parts[1].radius, 0.2);
    EXPECT_EQ(table.parts[1].height, 0.3);
    EXPECT_EQ(table.parts[2].scale, 0.5);
    ASSERT_NE(table.parts[2].meshData, nullptr);
}

TEST(SceneFields, RoundDrawingsKeepTheirRadiusIfNoThicknessIsGiven) {
    const AssetFolder folder;
    const auto load = [&](const std::string& kind, const std::string& more) {
        return folder.load("schema = 1\n" + kind + more);
    };
    const std::string rope = "[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\n",
                      net = "[net.n]\npoints = [{ name = \"a\", position = [0, 0, 0], mass_kg = 1 }]\nsprings = []\n";
    EXPECT_EQ(load(rope, "").spec.bodies.of<world::RopeSpec>()[0].thickness, 0.02);  // the radius if none is given
    EXPECT_EQ(load(rope, "radius = 0.03\n").spec.bodies.of<world::RopeSpec>()[0].thickness, 0.03);
    EXPECT_EQ(load(net, "radius = 0.03\n").spec.bodies.of<world::NetSpec>()[0].thickness, 0.03);
    EXPECT_EQ(world::RopeSpec().thickness, world::RopeSpec().radius);

    const Loaded given = load(rope, "radius = 0.03\nthickness = 0.014\n");
    EXPECT_EQ(given.spec.bodies.of<world::RopeSpec>()[0].thickness, 0.014);
    ASSERT_EQ(given.warnings.size(), 1U);
    EXPECT_EQ(folder.withoutFolder(printed(given.warnings[0])),
              "s.toml:5:13: warning: with a drawn radius of 0.03 m it sinks in by 0.016 m at contact\n"
              "  thickness = 0.014\n"
              "              ^ leave thickness out");
    for (const char* fine : {"radius = 0.03\nthickness = 0.015\n", "thickness = 0.001\ncollide = false\n"})
        EXPECT_TRUE(load(rope, fine).warnings.empty()) << fine;
}

TEST(SceneFields, AMeshWithoutTextureCoordinatesHasNoWeave) {
    const AssetFolder folder;
    folder.write("unwrapped.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    const auto load = [&](const std::string& mesh) {
        return folder.load("schema = 1\n[material.m]\n[cloth.c]\nmaterial = \"m\"\nmesh = \"" + mesh +
                           "\"\nfinish = { weave = 0.5 }\n");
    };
    const Loaded bare = load("square.obj"), unwrapped = load("unwrapped.obj");
    EXPECT_EQ(bare.spec.bodies.of<world::ClothSpec>()[0].finish.weave, 0.0);
    ASSERT_EQ(bare.warnings.size(), 1U);
    EXPECT_NE(bare.warnings[0].text.find("square.obj has no texture coordinates"), std::string::npos)
        << bare.warnings[0].text;
    EXPECT_EQ(unwrapped.spec.bodies.of<world::ClothSpec>()[0].finish.weave, 0.5);
    EXPECT_TRUE(unwrapped.warnings.empty());
}

TEST(SceneFields, AMeshAndATurnedGridAreSaidToHaveNoThreadsThatRub) {
    const AssetFolder folder;
    const auto load = [&](const std::string& hysteresis) {
        return folder.load(
            "schema = 1\n[material.m]\nbending_rigidity_N_m = 1e-5\nbending_yield_per_m = 5\n"
            "bending_hysteresis_N = " +
            hysteresis +
            "\n[cloth.c]\nmaterial = \"m\"\nmesh = \"square.obj\"\n[cloth.grid]\nmaterial = \"m\"\ngrain_deg = -270\n"
            "[cloth.bias]\nmaterial = \"m\"\ngrain_deg = 45\n");
    };
    const Loaded lost = load("1e-3");
    ASSERT_EQ(lost.warnings.size(), 2U);
    EXPECT_EQ(folder.withoutFolder(printed(lost.warnings[0])),
              "s.toml:6:8: warning: bending_hysteresis_N of material.m does nothing in cloth.c: only threads along the "
              "lines of a grid rub at each other\n"
              "  [cloth.c]\n"
              "         ^ make it a grid, or give the material bending_hysteresis_N = 0");
    EXPECT_NE(lost.warnings[1].text.find("does nothing in cloth.bias"), std::string::npos) << lost.warnings[1].text;
    EXPECT_NE(lost.warnings[1].remedy.find("give it a grain_deg that is a multiple of 90"), std::string::npos);
    EXPECT_TRUE(load("0").warnings.empty());
}

TEST(SceneFields, CamerasLandInTheirMembers) {
    const world::SceneSpec scene = fullSpec();
    const world::CameraSpec& main = named(scene.cameras, "main");
    EXPECT_EQ(main.fieldOfView, radians(45.0));
    ASSERT_EQ(main.keys.size(), 2U);
    EXPECT_EQ(main.keys[0].t, 0.0);
    EXPECT_EQ(main.keys[0].eye, dvec3(1, 2, 3));
    EXPECT_EQ(main.keys[0].target, dvec3(4, 5, 6));
    EXPECT_EQ(main.keys[0].fieldOfView, radians(30.0));
    EXPECT_EQ(main.keys[0].ease, world::Ease::hold);
    EXPECT_EQ(main.keys[1].fieldOfView, std::nullopt);
    const world::CameraSpec& turning = named(scene.cameras, "turning");
    EXPECT_EQ(turning.eye, dvec3(3, 2, 1));
    EXPECT_EQ(turning.target, dvec3(0, 1, 0.5));
    EXPECT_EQ(turning.orbitPeriod, 20.0);
}

}  // namespace
}  // namespace taut::scene
