// Rigid bodies on slopes, in piles and on cloth, against theory.
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <complex>
#include <map>
#include <memory>
#include <numeric>

#include "support/piercings.h"
#include "taut/bodies/solid.h"
#include "taut/core/rigid_motion.h"
#include "taut/core/trig.h"
#include "taut/forces/wind.h"
#include "taut/joints/joints.h"
#include "taut/spec/actions.h"
#include "touching_scenes.h"

namespace taut::test::touching {
namespace {

using world::SolidSpec;
using world::World;

SolidSpec ball(const std::string& name, const dvec3& position, double radius = 0.1) {
    SolidSpec spec;
    spec.name = name;
    spec.shape = "sphere";
    spec.radius = spec.thickness = radius;
    spec.position = position;
    return spec;
}

SolidSpec box(const std::string& name, const dvec3& position, const dvec3& size) {
    SolidSpec spec;
    spec.name = name;
    spec.size = size;
    spec.position = position;
    return spec;
}

SolidSpec round(const std::string& shape, const std::string& name, const dvec3& position, double radius,
                double height) {
    SolidSpec spec = ball(name, position, radius);
    spec.shape = shape;
    spec.height = height;
    spec.thickness = 0.002;
    return spec;
}

core::RigidMotion motionOf(World& world, const std::string& name) {
    const world::PointsNow points = world.points(name);
    return core::rigidMotionOf(points.mass, points.x, points.v);
}

// A plane through the origin that goes down towards x.
world::ColliderSpec slope(double angle, double friction) {
    world::ColliderSpec plane = ground(0.0, friction);
    plane.normal = {std::sin(angle), std::cos(angle), 0.0};
    return plane;
}

void advanceBy(World& world, double seconds) {
    for (int i = static_cast<int>(std::lround(seconds / world.tickSeconds())); i > 0; --i)
        ASSERT_FALSE(world.advance());
}

// In still air it comes to fall with √(2 m g / ρ C_D A), where A is its area seen from below.
TEST(Solid, FallsAtTheSpeedAtWhichTheAirCarriesIt) {
    world::SceneSpec spec = scene();
    world::WindSpec air;
    air.name = "air";
    air.on = {"solid.*"};
    air.drag = 0.8;
    spec.forces.add(air);
    const std::map<std::string, double> seen{
        {"ball", core::pi * 0.01}, {"capsule", core::pi * 0.01 + 0.2 * 0.3}, {"box", 0.1 * 0.2}};
    spec.bodies.add(ball("ball", {0, 0, 0}));
    spec.bodies.add(box("box", {2, 0, 0}, {0.1, 0.05, 0.2}));
    SolidSpec capsule = round("capsule", "capsule", {4, 0, 0}, 0.1, 0.3);
    capsule.thickness = 0.1;
    capsule.rotation.x = core::radians(90.0);
    spec.bodies.add(capsule);
    for (world::BodySpec& body : spec.bodies) dynamic_cast<SolidSpec&>(body).mass = 0.05;
    World world(spec);
    advanceBy(world, 4.0);
    for (const auto& [name, area] : seen)
        EXPECT_NEAR(-motionOf(world, "solid." + name).velocity.y, std::sqrt(2 * 0.05 * g / (1.2 * 0.8 * area)), 1e-3)
            << name;
}

// They roll at g sin θ over 1 plus the square of the radius of gyration over that of the ball, 2/5, or of the cylinder,
// 1/2, and slide at g (sin θ - μ cos θ) where friction is less than that takes.
TEST(SolidBall, RollsAndSlidesDownASlopeAsACylinderDoes) {
    const double angle = 0.35;
    for (const double friction : {0.3, 0.05})
        for (const bool isBall : {true, false}) {
            const dvec3 place = 0.1 * dvec3(std::sin(angle), std::cos(angle), 0.0);
            SolidSpec body = isBall ? ball("body", place) : round("cylinder", "body", place, 0.1, 0.3);
            body.rotation.x = isBall ? 0.0 : core::radians(90.0);
            world::SceneSpec spec = scene();
            spec.colliders = {slope(angle, friction)};
            spec.bodies.add(body);
            World world(spec);
            advanceBy(world, 0.5);
            const double way =
                glm::dot(motionOf(world, "solid.body").centre, dvec3(std::cos(angle), -std::sin(angle), 0.0));
            const double roll = g * std::sin(angle) / (isBall ? 1.4 : 1.5);
            const double slide = g * (std::sin(angle) - friction * std::cos(angle));
            EXPECT_NEAR(way / (0.5 * std::max(roll, slide) * 0.25), 1.0, isBall ? 0.01 : 1e-3) << friction;
        }
}

// Thrown along the ground it slows down by μ g, and rolls from 5/7 of its speed on.
TEST(SolidBall, SlidesAndThenRolls) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0, 0.2)};
    SolidSpec thrown = ball("ball", {0.0, 0.1, 0.0});
    thrown.velocity = {3.0, 0.0, 0.0};
    spec.bodies.add(thrown);
    World world(spec);
    advanceBy(world, 0.25);
    EXPECT_NEAR(motionOf(world, "solid.ball").velocity.x, 3.0 - 0.2 * g * 0.25, 1e-3);
    advanceBy(world, 1.75);
    const core::RigidMotion end = motionOf(world, "solid.ball");
    EXPECT_NEAR(end.velocity.x / (3.0 * 5 / 7), 1.0, 1e-3);
    EXPECT_NEAR(-0.1 * end.spin.z / end.velocity.x, 1.0, 1e-3);
    EXPECT_NEAR(end.centre.y, 0.1, 1e-5);
}

// Contact uses a prism of 24 sides, which would lose two thirds of its energy in a turn. On the faces and edges of a
// board it rolls three turns as a round body does.
TEST(SolidCylinder, RollsOverABoardWithoutLoss) {
    world::SceneSpec spec = scene(0.4);
    spec.colliders = {ground(0.0, 0.4)};
    SolidSpec board = box("board", {1.0, 0.025, 0.0}, {2.6, 0.05, 0.6});
    board.density = 5000.0;
    SolidSpec wheel = round("cylinder", "wheel", {0.0, 0.15, 0.0}, 0.1, 0.3);
    wheel.rotation.x = core::radians(90.0);
    wheel.velocity.x = 1.0;
    wheel.spin.z = -10.0;
    spec.bodies.add(board);
    spec.bodies.add(wheel);
    World world(spec);
    advanceBy(world, 2.0);
    const core::RigidMotion end = motionOf(world, "solid.wheel");
    EXPECT_NEAR(end.velocity.x, 1.0, 1e-6);
    EXPECT_NEAR(end.spin.z, -10.0, 1e-5);
    EXPECT_NEAR(end.centre.x, 2.0, 1e-6);
    EXPECT_NEAR(end.centre.y, 0.15, 1e-6);
}

// Three logs in a pile stand where friction between them is at least tan 15°.
TEST(SolidCylinder, LiesInAPileIfFrictionIsEnough) {
    for (const double friction : {0.25, 0.285}) {
        world::SceneSpec spec = scene(friction);
        spec.colliders = {ground(0.0, 0.5)};
        const double up = 0.1 * std::sqrt(3.0);
        const dvec3 places[] = {{-0.1, 0.1, 0.0}, {0.1, 0.1, 0.0}, {0.0, 0.1 + up, 0.0}};
        for (int k = 0; k < 3; ++k) {
            SolidSpec log = round("cylinder", std::to_string(k), places[k], 0.1, 0.4);
            log.rotation.x = core::radians(90.0);
            spec.bodies.add(log);
        }
        World world(spec);
        advanceBy(world, 1.0);
        const double sunk = 0.1 + up - motionOf(world, "solid.2").centre.y;
        if (friction < std::tan(core::radians(15.0)))
            EXPECT_GT(sunk, 0.1);
        else
            EXPECT_LT(std::abs(sunk), 1e-4);
    }
}

// Cans on each other, each a little aside and turned, so that their prisms do not fit.
TEST(SolidCylinder, StandsOnItsLike) {
    world::SceneSpec spec = scene(0.5);
    spec.colliders = {ground(0.0, 0.5)};
    for (int k = 0; k < 5; ++k) {
        SolidSpec can = round("cylinder", std::to_string(k), {k % 2 * 0.003, 0.05 + 0.1 * k, 0.0}, 0.05, 0.1);
        can.rotation.y = 0.1 * k;
        spec.bodies.add(can);
    }
    World world(spec);
    advanceBy(world, 1.0);
    for (int k = 0; k < 5; ++k)
        EXPECT_LT(glm::distance(motionOf(world, "solid." + std::to_string(k)).centre,
                                dvec3(k % 2 * 0.003, 0.05 + 0.1 * k, 0.0)),
                  1e-5);
}

// It lies on the ground and rolls about its tip: Ω about the vertical, -Ω cot α about the line on which it lies.
TEST(SolidCone, RollsAroundItsTip) {
    const double radius = 0.1, height = 0.25, half = std::atan(radius / height), turning = 1.5;
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0, 1.0)};
    const dvec3 out(std::cos(half), std::sin(half), 0.0);  // from its tip along its axis
    SolidSpec cone = round("cone", "cone", 0.5 * height * out, radius, height);
    cone.rotation.z = core::radians(90.0) + half;
    cone.spin.x = -turning / std::tan(half);
    cone.velocity = glm::cross(cone.spin, 0.75 * height * out);
    spec.bodies.add(cone);
    World world(spec);
    advanceBy(world, 2.0);
    const dvec3 centre = motionOf(world, "solid.cone").centre;
    const double away = 0.75 * height * std::cos(half), angle = 2.0 * turning;
    EXPECT_NEAR(std::atan2(-centre.z, centre.x), angle, 0.01 * angle);  // 0.3 %, of the order of an instant
    EXPECT_NEAR(std::hypot(centre.x, centre.z), away, 0.005 * away);
    EXPECT_NEAR(centre.y, 0.75 * height * std::sin(half), 1e-4);
}

// A brick with edges rounded by r tips over where tan θ is above (b/2 - r) / (h/2), and a can over any place of its
// rim. The can rocks until one place bears it: from 0.005 to 0.01 rad below the angle on it tips, too.
TEST(SolidBox, TipsOverAtItsAngle) {
    for (const std::string shape : {"box", "cylinder"})
        for (const double beside : {shape == "box" ? -0.005 : -0.015, 0.005}) {  // [rad]
            SolidSpec brick = round(shape, "brick", dvec3(0.0), 0.05, 0.2);
            brick.size = {0.1, 0.2, 0.1};
            brick.thickness = 0.001;
            const double angle = std::atan((0.05 - 0.001) / 0.1) + beside;
            brick.position = 0.1 * dvec3(std::sin(angle), std::cos(angle), 0.0);
            brick.rotation.z = -angle;
            if (shape == "cylinder") brick.rotation.y = core::radians(22.5);  // between two corners of its octagon
            world::SceneSpec spec = scene();
            spec.colliders = {slope(angle, 2.0)};
            spec.bodies.add(brick);
            World world(spec);
            advanceBy(world, 1.5);
            const double height = glm::dot(motionOf(world, "solid.brick").centre, spec.colliders[0].normal);
            EXPECT_NEAR(height, beside < 0 ? 0.1 : 0.05, 0.002) << shape << ' ' << beside;
        }
}

// An incoming ball leaves at the other end: a row of five that touch, without loss.
TEST(SolidBall, PassesItsMomentumOnThroughARow) {
    world::SceneSpec spec = scene();
    spec.world.gravity = dvec3(0.0);
    spec.contact.restitution = 1.0;
    SolidSpec first = ball("0", {-0.3, 0.0, 0.0});
    first.velocity = {2.0, 0.0, 0.0};
    spec.bodies.add(first);
    for (int i = 1; i < 5; ++i) spec.bodies.add(ball(std::to_string(i), {0.2 * i, 0.0, 0.0}));
    World world(spec);
    advanceBy(world, 0.5);
    for (int i = 0; i < 4; ++i)
        EXPECT_LT(glm::length(motionOf(world, "solid." + std::to_string(i)).velocity), 1e-9) << i;
    EXPECT_NEAR(motionOf(world, "solid.4").velocity.x, 2.0, 1e-9);
}

// The hull around the corners of a box and a point within it, in a file without faces, is that box.
TEST(SolidHull, OfABoxIsTheBox) {
    SolidSpec crate = box("box", {0.3, 0.2, 0.1}, {0.4, 0.2, 0.6}), hull = crate;
    hull.shape = "hull";
    const auto mesh = std::make_shared<world::MeshData>();
    for (int i = 0; i < 8; ++i)
        mesh->positions.push_back(0.5 * crate.size *
                                  dvec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
    mesh->positions.emplace_back(0.01, 0.02, 0.03);
    hull.meshData = mesh;
    const mechanics::Model a = crate.build({}), b = hull.build({});
    ASSERT_EQ(b.pointCount(), a.pointCount());
    EXPECT_EQ(b.triangles.size(), a.triangles.size());
    const std::vector<dvec3> still(a.masses.size(), dvec3(0.0));
    const core::RigidMotion one = core::rigidMotionOf(a.masses, a.positions, still);
    const core::RigidMotion other = core::rigidMotionOf(b.masses, b.positions, still);
    EXPECT_NEAR(other.mass / one.mass, 1.0, 1e-12);
    EXPECT_LT(glm::distance(one.centre, other.centre), 1e-12);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(other.inverseInertia[k][k] / one.inverseInertia[k][k], 1.0, 1e-9);
}

// A weld of all points makes one rigid body, and so does a compound: two halves fly, fall and lie as the whole does,
// apart from rounding, and do not touch each other.
TEST(SolidBox, MadeOfHalvesMovesAsTheWhole) {
    const dvec3 velocity(0.4, 1.0, 0.0), spin(2.0, 0.7, 4.0), place(0.0, 0.4, 0.0);
    const auto thrown = [&](const std::string& name, double side, double length) {
        SolidSpec part = box(name, place + dvec3(0.5 * side * length, 0.0, 0.0), {length, 0.1, 0.06});
        part.spin = spin;
        part.velocity = velocity + glm::cross(spin, part.position - place);
        return part;
    };
    world::SceneSpec whole = scene(), halves = scene(), compound = scene();
    whole.colliders = halves.colliders = compound.colliders = {ground(0.0, 0.5)};
    whole.bodies.add(thrown("whole", 0.0, 0.3));
    SolidSpec parts = thrown("parts", 0.0, 0.3);
    parts.shape = "compound";
    for (const double side : {-1.0, 1.0})
        parts.parts.push_back(box("", {0.5 * side * 0.15, 0.0, 0.0}, {0.15, 0.1, 0.06}));
    compound.bodies.add(parts);
    halves.bodies.add(thrown("left", -1.0, 0.15));
    halves.bodies.add(thrown("right", 1.0, 0.15));
    world::WeldJoint weld;
    weld.a = "solid.left@all";
    weld.b = "solid.right@all";
    halves.joints.add(weld);
    World one(whole), two(halves), three(compound);
    double furthest = 0;
    for (int tick = 0; tick < 150; ++tick) {
        for (World* world : {&one, &two, &three}) ASSERT_FALSE(world->advance());
        const dvec3 wanted = motionOf(one, "solid.whole").centre;
        const dvec3 middle = 0.5 * (motionOf(two, "solid.left").centre + motionOf(two, "solid.right").centre);
        for (const dvec3& centre : {middle, motionOf(three, "solid.parts").centre})
            furthest = std::max(furthest, glm::distance(centre, wanted));
        if (tick == 20) EXPECT_LT(furthest, 1e-11);  // in the air: a weld is settled to 1e-12 in each of 168 steps
        // The first impact, of an edge: two rows or four, which the solver settles to 1e-5 of the thickness. A body
        // that balances on an edge after it grows apart.
        if (tick == 28) EXPECT_LT(furthest, 2e-8);
    }
    constexpr double fallOfAnInstant = 9.81 / (240.0 * 240.0);  // [m] from rest: such gaps count as closed
    EXPECT_LT(glm::length(motionOf(one, "solid.whole").velocity), 1e-3);
    EXPECT_LT(furthest, fallOfAnInstant);
    EXPECT_NEAR(glm::distance(motionOf(two, "solid.left").centre, motionOf(two, "solid.right").centre), 0.15, 1e-12);
}

// Two balls on a rod: on a box and on the ground each is as high as its radius.
TEST(SolidCompound, RestsOnEachOfItsParts) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0, 0.5)};
    spec.bodies.add(box("box", {0.0, 0.1, 0.0}, {0.1, 0.2, 0.4}));
    SolidSpec dumbbell = box("dumbbell", {0.25, 0.3, 0.0}, dvec3(1.0));
    dumbbell.shape = "compound";
    dumbbell.parts = {ball("", {-0.25, 0.0, 0.0}, 0.05), ball("", {0.25, 0.0, 0.0}, 0.08),
                      round("capsule", "", dvec3(0.0), 0.01, 0.5)};
    dumbbell.parts.back().thickness = 0.01;
    dumbbell.parts.back().rotation = {0.0, 0.0, 0.5 * core::pi};
    spec.bodies.add(dumbbell);
    World world(spec);
    advanceBy(world, 2.0);
    const world::PointsNow points = world.points("solid.dumbbell");
    const double fallOfAnInstant = 9.81 / (240.0 * 240.0);
    EXPECT_NEAR(points.x[mechanics::innerPoints].y, 0.25, 2.0 * fallOfAnInstant);
    EXPECT_NEAR(points.x[mechanics::innerPoints + 1].y, 0.08, 2.0 * fallOfAnInstant);
}

// Two boxes with a corner each in one place, where their faces are nearer than their thickness: they turn about it as
// if they could not touch; they touch once it is released.
TEST(SolidBox, TouchesNoneThatAJointHoldsToIt) {
    world::SceneSpec spec = scene();
    spec.world.gravity = dvec3(0.0);
    SolidSpec one = box("one", {0.0, 0.0, 0.0}, {0.3, 0.1, 0.2}), other = box("other", {0.298, 0.0, 0.0}, one.size);
    one.spin = {0.0, 0.0, 5.0};
    one.drag = other.drag = 0.0;
    spec.bodies.add(one);
    spec.bodies.add(other);
    world::WeldJoint pin;
    pin.name = "pin";
    pin.a = "solid.one@#11";
    pin.b = "solid.other@#10";
    spec.joints.add(pin);
    World world(spec);
    const double start = world.metrics().energy();
    for (int tick = 0; tick < 30; ++tick) {
        ASSERT_FALSE(world.advance());
        EXPECT_EQ(world.metrics().bodyContacts, 0);
        EXPECT_NEAR(world.metrics().energy() / start, 1.0, 0.02) << tick;
    }
    world::ReleaseAction release;
    release.id = "pin";
    World apart(spec);
    release.perform(apart);
    world::PushAction push;
    push.target = "solid.other";
    push.impulse = {-10.0, 0.0, 0.0};
    push.perform(apart);
    ASSERT_FALSE(apart.advance());
    EXPECT_LT(motionOf(apart, "solid.one").velocity.x, -1.0);
}

// Of capsules, each from the end of the one before, level as it starts; the last link carries a ball of a hundred times
// its weight. Nothing of the energy is lost, and no end comes off by more than a thousandth of a link.
TEST(SolidCapsule, HangsInAChainUnderAHeavyLoad) {
    constexpr int links = 6;
    world::SceneSpec spec = scene();
    for (int i = 0; i <= links; ++i) {
        const std::string name = std::to_string(i);
        SolidSpec link = i < links ? round("capsule", name, {0.1 + 0.2 * i, 0.0, 0.0}, 0.02, 0.2)
                                   : ball(name, {0.2 * links, 0.0, 0.0});
        if (i < links) {
            link.thickness = 0.02;
            link.rotation.z = core::radians(90.0);
        }
        link.mass = i < links ? 0.1 : 10.0;
        link.drag = 0.0;
        link.touch = world::Touch::nothing;
        if (i == 0) link.hold = {"#7"};
        spec.bodies.add(link);
        if (i == 0) continue;
        world::WeldJoint pin;
        pin.a = "solid." + std::to_string(i - 1) + "@#6";
        pin.b = "solid." + name + (i < links ? "@#7" : "@#6");
        spec.joints.add(pin);
    }
    World world(spec);
    const double start = world.metrics().energy();
    double most = 0;
    for (int tick = 0; tick < 60; ++tick) {
        ASSERT_FALSE(world.advance());
        const world::Metrics now = world.metrics();
        most = std::max(most, now.kinetic);
        EXPECT_NEAR(now.energy(), start, 0.01 * most) << tick;
        for (int i = 1; i <= links; ++i) {
            const dvec3 end = world.points("solid." + std::to_string(i - 1)).x[6];
            EXPECT_LT(glm::distance(end, world.points("solid." + std::to_string(i)).x[i < links ? 7 : 6]), 2e-4) << i;
        }
    }
    EXPECT_GT(most, 100.0);  // 10 kg have fallen by more than a metre
}

// On a rod it hangs still where it starts, and a rod bears its weight and no more.
TEST(Solid, HangsOnARodByItsWeight) {
    for (const double share : {0.999, 1.001}) {
        world::SceneSpec spec = scene();
        world::ColliderSpec& beam = spec.colliders.emplace_back();
        beam.name = "beam";
        beam.position = {0.0, 1.0, 0.0};
        beam.radius = 0.1;
        SolidSpec can = round("cylinder", "can", dvec3(0.0), 0.1, 0.3);
        can.mass = 2.0;
        can.drag = 0.0;
        spec.bodies.add(can);
        world::RodJoint rod;
        rod.a = "solid.can@#31";  // the middle of its top
        rod.b = "collider.beam";
        rod.breakForce = share * 2.0 * 9.81;
        spec.joints.add(rod);
        World world(spec);
        advanceBy(world, 0.5);
        const double speed = glm::length(motionOf(world, "solid.can").velocity);
        if (share > 1)
            EXPECT_LT(speed, 1e-6);
        else
            EXPECT_GT(speed, 1.0);
    }
}

// A bar whose end is in the middle of a thin pin of a collider swings about it as if the pin were not there, whether it
// is held there or carried by the pin.
TEST(SolidCapsule, SwingsAboutThePinThatCarriesIt) {
    for (const char* how : {"held", "carried", "welded"}) {
        world::SceneSpec spec = scene();
        world::ColliderSpec& pin = spec.colliders.emplace_back();
        pin.name = "pin";
        pin.radius = 0.01;
        SolidSpec bar = round("capsule", "bar", {0.25, 0.0, 0.0}, 0.02, 0.5);
        bar.thickness = 0.02;
        bar.rotation.z = 0.5 * core::pi;
        bar.drag = 0.0;
        if (how != std::string("welded")) bar.hold = {"#7"};
        if (how == std::string("carried")) bar.holdOn = "collider.pin";
        spec.bodies.add(bar);
        if (how == std::string("welded")) {
            world::WeldJoint weld;
            weld.a = "solid.bar@#7";
            weld.b = "collider.pin";
            spec.joints.add(weld);
        }
        World world(spec);
        const double start = world.metrics().energy();
        double most = 0;
        for (int tick = 0; tick < 120; ++tick) {
            ASSERT_FALSE(world.advance());
            most = std::max(most, world.metrics().kinetic);
            EXPECT_NEAR(world.metrics().energy(), start, 0.01 * std::max(most, 0.01)) << how << tick;
        }
        const double mass = motionOf(world, "solid.bar").mass;
        EXPECT_NEAR(most / (mass * 9.81 * 0.25), 1.0, 0.02) << how;
    }
}

// Two bars of 0.5 m, the first on an axle at its lower edge, the second on a hinge between their lower edges: at the
// step "auto" they follow Lagrange's equations, integrated here by Runge and Kutta's method, to 1 mm, and the hinge
// stays closed to 1e-4 of a bar.
TEST(SolidBox, OfADoublePendulumFollowsLagrangesEquations) {
    constexpr double length = 0.5, width = 0.04, weight = 9.81, seconds = 3.5;
    world::SceneSpec spec = scene();
    spec.solver.precision = world::Precision::double_;
    for (const double x : {0.25, 0.75}) {
        SolidSpec& bar =
            static_cast<SolidSpec&>(spec.bodies.add(box(x < 0.5 ? "a" : "b", {x, 1.0, 0.0}, {length, width, width})));
        bar.thickness = 0.0;
        bar.drag = 0.0;
        if (x < 0.5) bar.hold = {"#6", "#10"};
    }
    world::WeldJoint hinge;
    hinge.a = std::vector<std::string>{"solid.a@#7", "solid.a@#11"};
    hinge.b = std::vector<std::string>{"solid.b@#6", "solid.b@#10"};
    spec.joints.add(hinge);
    World world(spec);
    double opening = 0;
    for (int tick = 0; tick < 210; ++tick) {
        ASSERT_FALSE(world.advance());
        opening = std::max(opening, glm::distance(world.points("solid.a").x[7], world.points("solid.b").x[6]));
    }
    EXPECT_LT(opening, 1e-4 * length);

    // In the axes of a bar, from its axle or hinge at the lower edge: the middle, and the other lower edge.
    using Angles = std::vector<double>;  // of the two bars, and their rates
    const std::complex<double> middle(length / 2, width / 2), edge(length, 0.0);
    const double inertia = (length * length + width * width) / 12 + std::norm(middle);  // over the mass
    const auto rates = [&](const Angles& at, Angles& rate, double) {
        const std::complex<double> a = std::polar(1.0, at[0]), b = std::polar(1.0, at[1]);
        const double along = std::real(std::conj(a * edge) * b * middle),
                     across = std::imag(std::conj(a * edge) * b * middle);
        const double first = across * at[3] * at[3] - weight * std::real(a * (middle + edge)),
                     second = -across * at[2] * at[2] - weight * std::real(b * middle);
        const double own = inertia + std::norm(edge), det = own * inertia - along * along;
        rate = {at[2], at[3], (first * inertia - second * along) / det, (second * own - first * along) / det};
    };
    Angles angles(4);
    boost::numeric::odeint::integrate_const(boost::numeric::odeint::runge_kutta4<Angles>(), rates, angles, 0.0, seconds,
                                            1e-4);
    const std::complex<double> end = std::complex<double>(0.0, 1.0 - width / 2) + std::polar(1.0, angles[0]) * edge +
                                     std::polar(1.0, angles[1]) * edge;
    const dvec3 there = world.points("solid.b").x[7];
    EXPECT_LT(std::hypot(there.x - end.real(), there.y - end.imag()), 1e-3);
}

// A wall carries a crate and releases it again: a world restored in between has the same bits.
TEST(SolidBox, IsCarriedByAWallAsInARestoredWorld) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0, 0.5)};
    world::ColliderSpec& wall = spec.colliders.emplace_back();
    wall.name = "wall";
    wall.shape = "box";
    wall.position = {0.59, 0.0, 0.0};
    spec.bodies.add(box("crate", {0.0, 0.1, 0.0}, dvec3(0.2)));
    World whole(spec);
    advanceBy(whole, 0.1);
    world::HoldAction hold;
    hold.target = "solid.crate@right";
    hold.holdOn = "collider.wall";
    hold.perform(whole);
    const auto isSameFrom = [&](std::span<const std::byte> saved) {
        World restored(spec);
        restored.restore(saved);
        advanceBy(restored, 0.1);
        advanceBy(whole, 0.1);
        return restored.stateHash() == whole.stateHash();
    };
    advanceBy(whole, 0.1);
    EXPECT_TRUE(isSameFrom(whole.save()));
    world::FreeAction free;
    free.target = hold.target;
    free.perform(whole);
    advanceBy(whole, 0.1);
    EXPECT_TRUE(isSameFrom(whole.save()));
    EXPECT_LT(motionOf(whole, "solid.crate").centre.x, 1e-3);  // it touches the wall again
}

// It comes off one wall and meets the other within an instant, again and again.
TEST(SolidBall, BouncesBetweenWallsThatAreNear) {
    world::SceneSpec spec = scene(0.0);
    spec.world.gravity = dvec3(0.0);
    spec.contact.restitution = 1.0;
    for (const double side : {-1.0, 1.0}) {
        world::ColliderSpec& wall = spec.colliders.emplace_back();
        wall.name = side < 0 ? "left" : "right";
        wall.shape = "box";
        wall.size = {0.2, 3.0, 3.0};
        wall.position = {0.175 * side, 0.0, 0.0};
        wall.restitution = 1.0;
    }
    SolidSpec thrown = ball("ball", dvec3(0.0), 0.06);
    thrown.velocity = {32.0, 0.0, 0.0};
    thrown.drag = 0.0;
    spec.bodies.add(thrown);
    World world(spec);
    for (int tick = 0; tick < 60; ++tick) {
        ASSERT_FALSE(world.advance());
        EXPECT_LT(std::abs(motionOf(world, "solid.ball").centre.x), 0.015 + 0.1 * 0.06) << tick;
    }
    EXPECT_NEAR(std::abs(motionOf(world, "solid.ball").velocity.x), 32.0, 1e-3);
}

// At the longest step that a tick may have, 600 rad/s would be two and a half radians.
TEST(SolidCylinder, KeepsASpinThatIsFastForTheTick) {
    world::SceneSpec spec = scene();
    spec.world.gravity = dvec3(0.0);
    SolidSpec wheel = round("cylinder", "wheel", dvec3(0.0), 0.1, 0.05);
    wheel.spin = {0.0, 600.0, 0.0};
    wheel.drag = 0.0;
    spec.bodies.add(wheel);
    World world(spec);
    const world::Metrics start = world.metrics();
    advanceBy(world, 0.5);
    EXPECT_NEAR(world.metrics().energy() / start.energy(), 1.0, 1e-4);
    EXPECT_NEAR(world.metrics().angularMomentum.y / start.angularMomentum.y, 1.0, 1e-4);
}

// Without gravity: a ball and a point of a net against a wall, and two balls head on. The restitution of two bodies or
// a body and a collider is the product of the two factors.
TEST(Solid, BouncesByTheFactorsOfBothSides) {
    world::SceneSpec spec = scene();
    spec.world.gravity = dvec3(0.0);
    spec.contact.restitution = 0.9;
    spec.colliders = {ground(0.0)};
    spec.colliders[0].restitution = 0.8;
    for (int k = 0; k < 3; ++k) {
        SolidSpec one = ball("ball" + std::to_string(k), {0.0, k == 0 ? 0.3 : 1.0 + 0.5 * k, 0.0});
        one.velocity = {0.0, k == 1 ? 1.0 : -1.0, 0.0};
        one.restitution = k == 2 ? 1.0 : 0.5;
        spec.bodies.add(one);
    }
    world::NetSpec net;
    net.name = "net";
    net.points = {{"only", {2.0, 0.3, 0.0}, 0.05, false, {}}};
    net.velocity = {0.0, -1.0, 0.0};
    net.drag = 0.0;
    net.restitution = 0.25;
    spec.bodies.add(net);
    World world(spec);
    advanceBy(world, 0.5);
    EXPECT_NEAR(motionOf(world, "solid.ball0").velocity.y, 0.8 * 0.5, 1e-9);
    EXPECT_NEAR(motionOf(world, "solid.ball2").velocity.y - motionOf(world, "solid.ball1").velocity.y, 2.0 * 0.9 * 0.5,
                1e-9);
    EXPECT_NEAR(world.points("net.net").v[0].y, 0.8 * 0.25, 1e-9);
}

// Nothing passes a plate of a millimetre, whoever moves, however far it would come in an instant.
TEST(Solid, StaysOnItsSideOfAThinPlate) {
    for (const auto& [speed, isPlateMoving] : {std::pair{12.0, false}, {600.0, false}, {12.0, true}, {90.0, true}}) {
        world::SceneSpec spec = scene();
        spec.world.gravity = dvec3(0.0);
        const std::vector<SolidSpec> solids{box("box", {0.0, 1.0, 0.0}, dvec3(0.2)), ball("ball", {1.0, 1.0, 0.0}),
                                            round("cylinder", "cylinder", {2.0, 1.0, 0.0}, 0.1, 0.2),
                                            round("capsule", "capsule", {3.0, 1.0, 0.0}, 0.05, 0.3)};
        for (SolidSpec solid : solids) {
            solid.rotation = {0.5, 0.3, 0.2};
            if (!isPlateMoving) solid.velocity = {0.0, -speed, 0.0};
            spec.bodies.add(solid);
        }
        world::ColliderSpec& plate = spec.colliders.emplace_back();
        plate.name = "plate";
        plate.shape = "box";
        plate.size = {100.0, 0.001, 100.0};
        if (isPlateMoving)
            plate.keys = {{.t = 0.0, .position = dvec3(0.0)},
                          {.t = 2.0 / speed, .position = {0.0, 2.0, 0.0}, .ease = world::Ease::linear}};
        World world(spec);
        advanceBy(world, 2.0 / speed + 0.05);
        constexpr double leastHalfWidth = 0.05;
        for (const SolidSpec& solid : solids) {
            const dvec3 centre = motionOf(world, "solid." + solid.name).centre;
            EXPECT_GT(centre.y, (isPlateMoving ? 2.0 : 0.0) + leastHalfWidth) << solid.name << " at " << speed;
            EXPECT_LT(glm::distance(centre, solid.position), 3.0 + 0.1 * speed) << solid.name << " at " << speed;
        }
    }
}

// Aslant, one ball gives another of its mass its velocity along the line between their centres when they meet, and
// bounces off a fixed one by twice of that, however far it comes in an instant.
TEST(SolidBall, BouncesAlongTheLineBetweenTheCentres) {
    for (const double speed : {1.0, 30.0, 100.0}) {
        constexpr double aside = 0.1;
        world::SceneSpec spec = scene(0.0);
        spec.world.gravity = dvec3(0.0);
        spec.contact.restitution = 1.0;
        for (const double z : {0.0, 1.0}) {
            SolidSpec thrown = ball(z > 0 ? "bounces" : "gives", {-1.03, aside, z});
            thrown.velocity = {speed, 0.0, 0.0};
            spec.bodies.add(thrown);
        }
        spec.bodies.add(ball("gets", dvec3(0.0)));
        world::ColliderSpec& peg = spec.colliders.emplace_back();
        peg.name = "peg";
        peg.radius = 0.1;
        peg.position = {0.0, 0.0, 1.0};
        peg.friction = 0.0;
        peg.restitution = 1.0;
        World world(spec);
        advanceBy(world, 1.2 / speed + 0.1);
        const dvec3 line(std::sqrt(1.0 - 0.25), -0.5, 0.0), before(speed, 0.0, 0.0);
        const dvec3 along = glm::dot(before, line) * line;
        const auto error = [&](const std::string& name, const dvec3& expected) {
            return glm::length(motionOf(world, "solid." + name).velocity - expected) / speed;
        };
        EXPECT_LT(error("gets", along), 1e-8) << speed;
        EXPECT_LT(error("gives", before - along), 1e-8) << speed;
        EXPECT_LT(error("bounces", before - 2.0 * along), 1e-8) << speed;
    }
}

// Newton's law for an impact of a whole face: its corners give back their share at once, so that nothing turns.
TEST(SolidBox, BouncesOffAFaceWithoutTurning) {
    world::SceneSpec spec = scene();
    spec.world.gravity = dvec3(0.0);
    spec.colliders = {ground(0.0, 0.5)};
    spec.colliders[0].restitution = 0.8;
    SolidSpec one = box("one", {0.0, 0.3, 0.0}, dvec3(0.2));
    one.velocity = {0.0, -2.0, 0.0};
    spec.bodies.add(one);
    World world(spec);
    advanceBy(world, 0.2);
    const core::RigidMotion motion = motionOf(world, "solid.one");
    EXPECT_LT(glm::length(motion.velocity - dvec3(0.0, 0.8 * 2.0, 0.0)), 1e-6);
    EXPECT_LT(glm::length(motion.spin), 1e-6);
}

// On its corners, with friction. A tick's energy is known but for the work of gravity in it.
TEST(SolidBox, GainsNoEnergyWhereItBouncesAndTurns) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0, 0.5)};
    spec.colliders[0].restitution = 0.95;
    SolidSpec one = box("one", {0.0, 0.6, 0.0}, {0.3, 0.2, 0.1});
    one.rotation = {0.3, 0.2, 0.5};
    spec.bodies.add(one);
    World world(spec);
    const double start = world.metrics().energy();
    for (int tick = 0; tick < 120; ++tick) {
        advanceBy(world, world.tickSeconds());
        EXPECT_LT(world.metrics().energy(), 1.01 * start) << tick;
    }
}

// Round ones hit each other and a box in free space: with a rim, a side, a tip.
TEST(Solid, KeepsMomentaWhereItIsRound) {
    world::SceneSpec spec = scene(0.5);
    spec.world.gravity = dvec3(0.0);
    const auto add = [&](SolidSpec body, const dvec3& turned, const dvec3& velocity) {
        body.rotation = turned;
        body.velocity = velocity;
        body.spin = {4.0, -3.0, 5.0};
        spec.bodies.add(body);
    };
    add(round("cylinder", "a", {-0.2, 0.0, 0.0}, 0.06, 0.16), {0.3, 0.0, 0.5}, {1.0, 0.0, 0.0});
    add(round("cylinder", "b", {0.0, 0.02, 0.01}, 0.08, 0.1), {1.2, 0.4, 0.0}, {0.0, 0.0, 0.0});
    add(round("cone", "c", {0.2, 0.0, 0.02}, 0.07, 0.15), {0.1, 0.2, 0.9}, {-1.0, 0.1, 0.0});
    add(box("d", {0.02, 0.25, 0.0}, dvec3(0.12)), {0.5, 0.1, 0.3}, {0.0, -1.0, 0.0});
    World world(spec);
    struct Sums {
        dvec3 along{0.0}, turning{0.0};
        double energy = 0;
    };
    const auto sums = [&] {
        Sums all;
        for (const char* name : {"solid.a", "solid.b", "solid.c", "solid.d"}) {
            const world::PointsNow points = world.points(name);
            for (std::size_t i = 0; i < points.x.size(); ++i) {
                all.along += points.mass[i] * points.v[i];
                all.turning += points.mass[i] * glm::cross(points.x[i], points.v[i]);
                all.energy += 0.5 * points.mass[i] * glm::dot(points.v[i], points.v[i]);
            }
        }
        return all;
    };
    const Sums start = sums();
    advanceBy(world, 0.75);
    const Sums end = sums();
    EXPECT_LT(end.energy, 0.8 * start.energy);  // they have met
    EXPECT_LT(glm::length(end.along - start.along) / glm::length(start.along), 1e-9);
    // Overlaps are taken back as shifts of places, which have no momentum but change arms.
    EXPECT_LT(glm::length(end.turning - start.turning) / glm::length(start.turning), 0.005);
}

// A ball, a box and a cylinder fall on a free cloth in free space: neither momentum is lost, nothing crosses.
TEST(Solid, KeepsMomentaWithACloth) {
    world::SceneSpec spec = scene(0.5);
    spec.contact.detections = 32;  // steps that change while bodies press would lose momentum
    spec.world.gravity = dvec3(0.0);
    spec.bodies.add(sheet("cloth", {-0.2, 0.0, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 10));
    SolidSpec thrown = ball("ball", {0.05, 0.15, 0.02}, 0.05);
    thrown.velocity = {0.3, -1.5, 0.0};
    thrown.spin = {0.0, 0.0, 10.0};
    SolidSpec crate = box("crate", {-0.05, -0.15, -0.03}, dvec3(0.08));
    crate.rotation = {0.3, 0.2, 0.5};
    crate.velocity = {0.0, 1.5, 0.1};
    spec.bodies.add(thrown);
    spec.bodies.add(crate);
    SolidSpec can = round("cylinder", "can", {-0.03, 0.2, -0.08}, 0.04, 0.1);
    can.rotation.x = 1.2;
    can.velocity = {0.0, -1.5, 0.0};
    can.spin = {0.0, 20.0, 0.0};
    spec.bodies.add(can);
    World world(spec);
    const PiercingWitness witness(spec, {"cloth.cloth", "solid.crate", "solid.can"});
    const auto momenta = [&] {
        dvec3 sum(0.0), turning(0.0);
        for (const char* name : {"cloth.cloth", "solid.ball", "solid.crate", "solid.can"}) {
            const world::PointsNow points = world.points(name);
            for (std::size_t i = 0; i < points.x.size(); ++i) {
                sum += points.mass[i] * points.v[i];
                turning += points.mass[i] * glm::cross(points.x[i], points.v[i]);
            }
        }
        return std::pair{sum, turning};
    };
    const auto start = momenta();
    for (int i = 0; i < 40; ++i) {
        ASSERT_FALSE(world.advance());
        ASSERT_EQ(witness.count(world), 0) << i;
    }
    const auto end = momenta();
    const double size = 0.26 * 1.5;                                // [N s] of the ball
    EXPECT_GT(motionOf(world, "solid.ball").velocity.y, -1.3);     // they have met
    EXPECT_LT(glm::length(end.first - start.first) / size, 1e-9);  // rounding of springs: 4e-12 a tick
    // Friction acts on points of the cloth, half a thickness off where it acts on the solids.
    EXPECT_LT(glm::length(end.second - start.second) / (size * 0.1), 0.02);
}

// A wedge of a round arch with an inner radius of 1 m, between two angles. It keeps its thickness clear of others.
SolidSpec wedge(const std::string& name, double from, double to, double depth) {
    SolidSpec spec;
    spec.name = name;
    spec.shape = "mesh";
    spec.thickness = 0.001;
    spec.position.y = spec.thickness;
    const auto mesh = std::make_shared<world::MeshData>();
    for (const double z : {-0.2, 0.2})
        for (const double angle : {from, to})
            for (const double radius : {1.0, 1.0 + depth}) {
                const double clear = angle == from ? spec.thickness : -spec.thickness;
                mesh->positions.emplace_back(radius * std::cos(angle) - clear * std::sin(angle),
                                             radius * std::sin(angle) + clear * std::cos(angle), z);
            }
    for (const auto& [a, b, c, d] :
         {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        mesh->triangles.push_back({a, b, c});
        mesh->triangles.push_back({a, c, d});
    }
    spec.meshData = mesh;
    return spec;
}

// A half-round arch without mortar stands where its depth is at least 0.1075 of its mean radius (Milankovitch 1907;
// Heyman 1969 has 0.106). Eleven wedges, 5 % on either side.
TEST(SolidMesh, AnArchOfWedgesStandsFromItsLeastDepthOn) {
    for (const double share : {1.05, 0.95}) {
        const double depth = 0.1075 * share / (1.0 - 0.5 * 0.1075 * share);
        world::SceneSpec spec = scene(0.6);
        spec.colliders = {ground(0.0, 0.8)};
        constexpr int count = 11;
        for (int i = 0; i < count; ++i)
            spec.bodies.add(wedge(std::to_string(i), core::pi * i / count, core::pi * (i + 1) / count, depth));
        World world(spec);
        const double top = motionOf(world, "solid.5").centre.y;
        advanceBy(world, 1.0);
        EXPECT_EQ(std::abs(motionOf(world, "solid.5").centre.y - top) < 0.01, share > 1.0) << share;
    }
}

// A body that starts within another comes apart, no faster than crossings do, and neither gains more momentum than the
// other.
TEST(SolidBox, ComesOutOfOneThatItStartsIn) {
    for (const dvec3& offset : {dvec3(0.0), dvec3(0.05, 0.03, 0.02)}) {
        world::SceneSpec spec = scene();
        spec.world.gravity = dvec3(0.0);
        spec.bodies.add(box("one", dvec3(0.0), dvec3(0.2)));
        spec.bodies.add(box("other", offset, dvec3(0.2)));
        World world(spec);
        for (int i = 0; i < 60; ++i) {
            ASSERT_FALSE(world.advance());
            const core::RigidMotion one = motionOf(world, "solid.one"), other = motionOf(world, "solid.other");
            EXPECT_LT(glm::length(one.velocity), 1.0);
            EXPECT_LT(glm::length(one.velocity + other.velocity), 1e-9);
        }
    }
}

// Ten boxes of 0.1 m, each turned and a little aside, under which friction holds every one. They lean by less than
// allowed, and then sleep. A ball that is dropped on them wakes all within its tick.
TEST(SolidBox, StandsInAStackAndSleeps) {
    constexpr int count = 10;
    world::SceneSpec spec = scene();
    spec.solver.sleepError = 1e-3;
    spec.colliders = {ground(0.0, 0.6)};
    for (int k = 0; k < count; ++k) {
        SolidSpec crate =
            box("box" + std::to_string(k), {0.002 * (k % 3), 0.05 + 0.1001 * k, 0.001 * (k % 2)}, dvec3(0.1));
        crate.rotation = {0.0, 0.05 * k, 0.0};
        crate.thickness = 0.01;
        spec.bodies.add(crate);
    }
    World world(spec);
    advanceBy(world, 0.25);
    std::vector<dvec3> settled;
    for (int k = 0; k < count; ++k) settled.push_back(motionOf(world, "solid.box" + std::to_string(k)).centre);
    advanceBy(world, 1.25);
    EXPECT_EQ(world.asleepShare(), 1.0);
    for (int k = 0; k < count; ++k) {
        const dvec3 centre = motionOf(world, "solid.box" + std::to_string(k)).centre;
        EXPECT_LT(glm::distance(centre, settled[k]), 2e-5) << k;
    }

    SolidSpec dropped = ball("ball", {0.03, 0.1 * count + 0.15, 0.0}, 0.05);
    dropped.touch = world::Touch::others;
    world.spawn(dropped);
    double before = -1.0;
    for (int i = 0; i < 20 && before < 0; ++i) {
        EXPECT_EQ(world.metrics("solid.box*").kinetic, 0.0);
        ASSERT_FALSE(world.advance());
        const double speed = motionOf(world, "solid.ball").velocity.y;
        if (i > 0 && speed > before) break;
        before = speed;
    }
    EXPECT_EQ(world.metrics("solid.box*").asleep, 0);
}

// Bricks of 0.1 m in rows on a plane that goes down towards x, each on two.
std::vector<SolidSpec> wall(int width, double angle) {
    const dvec3 along(std::cos(angle), -std::sin(angle), 0.0), up(std::sin(angle), std::cos(angle), 0.0);
    std::vector<SolidSpec> bricks;
    for (int row = 0; row < width; ++row)
        for (int k = 0; k < width - row; ++k) {
            const dvec3 centre = 0.105 * (k + 0.5 * row) * along + (0.05 + 0.1 * row) * up;
            SolidSpec& brick = bricks.emplace_back(box("brick" + std::to_string(bricks.size()), centre, dvec3(0.1)));
            brick.rotation = {0.0, 0.0, -angle};
            brick.thickness = 0.01;
        }
    return bricks;
}
dvec3 centreOf(World& world, const SolidSpec& solid) {
    return motionOf(world, "solid." + solid.name).centre;
}

// A wall of ten bricks stands. Two touch at the four corners of the rectangle that they share, though eight or more
// corners and edges meet there; so do the lowest and the ground.
TEST(SolidBox, StandsInAWallOnItsCorners) {
    constexpr int width = 4;
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0, 0.5)};
    const std::vector<SolidSpec> bricks = wall(width, 0.0);
    for (const SolidSpec& brick : bricks) spec.bodies.add(brick);
    World world(spec);
    advanceBy(world, 0.5);
    for (const SolidSpec& brick : bricks) EXPECT_LT(glm::distance(centreOf(world, brick), brick.position), 1e-5);
    EXPECT_LE(world.contact().lastImpulses, 4 * (width * (width - 1) + width));
}

// On a slope that is too steep for its lowest bricks it slides as one, as Coulomb says: g (sin θ - μ cos θ).
TEST(SolidBox, SlidesInAWallAsOne) {
    constexpr double angle = core::pi / 6.0, friction = 0.3, seconds = 0.5;
    world::SceneSpec spec = scene(1.0);
    spec.colliders = {slope(angle, friction)};
    const std::vector<SolidSpec> bricks = wall(4, angle);
    for (const SolidSpec& brick : bricks) spec.bodies.add(brick);
    World world(spec);
    advanceBy(world, seconds);
    const double way = 0.5 * g * (std::sin(angle) - friction * std::cos(angle)) * seconds * seconds;
    for (const SolidSpec& brick : bricks) {
        const dvec3 gone = centreOf(world, brick) - brick.position;
        EXPECT_NEAR(glm::length(gone), way, 0.001 * way) << brick.name;
        EXPECT_NEAR(std::sin(angle) * gone.x + std::cos(angle) * gone.y, 0.0, 1e-4) << brick.name;
    }
}

// Light boxes carry one that weighs a thousand times as much as each of them.
TEST(SolidBox, IsCarriedByFarLighterOnes) {
    constexpr int count = 5;
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0, 0.5)};
    for (int k = 0; k < count; ++k) {
        SolidSpec crate = box("box" + std::to_string(k), {0.0, 0.05 + 0.1 * k, 0.0}, dvec3(0.1));
        crate.density = k < count - 1 ? 50.0 : 50000.0;
        crate.thickness = 0.01;
        spec.bodies.add(crate);
    }
    World world(spec);
    advanceBy(world, 1.0);
    EXPECT_NEAR(motionOf(world, "solid.box4").centre.y, 0.45, 1e-3);
}

struct Dominoes {
    double height, depth, gap, friction;  // [m], [m], [m]; between them
};

// [s] that each domino of a row falls until it meets the next, with all before it leaning on it, which turn about their
// feet: van Leeuwen, "The domino effect", Am. J. Phys. 78 (2010). Lengths are heights. The corner of the one behind
// slides down the back of the one before it: sin(θ' - θ) = pitch cos θ - depth, so that θ of the head says all.
// Forces between them go out with the right weights; the rest says how the head falls, and how it meets the next.
std::vector<double> timesOfDominoes(const Dominoes& row, double spin, int count) {
    const double depth = row.depth / row.height, gap = row.gap / row.height, pitch = depth + gap;
    const double inertia = (1 + depth * depth) / 3, second = std::sqrt(row.height / g), last = std::asin(gap);
    struct Sums {
        double inertia = 0, change = 0, torque = 0;  // Σ w dθ_i / dθ, Σ w d²θ_i / dθ², Σ w torque
    };
    const auto sumsAt = [&](double angle, int leaning) {
        Sums sums;
        double weight = 1, ratio = 1, bend = 0;
        for (int i = 0; i < leaning; ++i) {
            sums.inertia += weight * ratio;
            sums.change += weight * bend;
            sums.torque += weight * 0.5 * (std::sin(angle) - depth * std::cos(angle)) / inertia;
            const double sine = pitch * std::cos(angle) - depth, cosine = std::sqrt(1 - sine * sine);
            const double slope = -pitch * std::sin(angle) / cosine;
            const double curve = (slope * slope * sine - pitch * std::cos(angle)) / cosine;
            weight *= (cosine - pitch * std::sin(angle) - row.friction * depth) / (cosine + row.friction * sine);
            bend = bend * (1 + slope) + ratio * ratio * curve;
            ratio *= 1 + slope;
            angle += std::asin(sine);
        }
        return sums;
    };
    std::vector<double> times;
    double energy = 0.5 * spin * spin * second * second;  // of the head: half the square of its spin
    for (int leaning = 1; leaning <= count; ++leaning) {
        const auto growthAt = [&](double angle, double has) {
            const Sums sums = sumsAt(angle, leaning);
            return (sums.torque - 2 * has * sums.change) / sums.inertia;
        };
        constexpr int parts = 200;
        const double part = last / parts;
        times.push_back(0);
        for (int k = 0; k < parts; ++k) {
            const double half = energy + part / 2 * growthAt(k * part, energy);
            energy += part * growthAt((k + 0.5) * part, half);
            times.back() += second * part / std::sqrt(2 * half);
        }
        const double share = 1 - 1 / sumsAt(0, leaning + 1).inertia;
        energy *= share * share;
    }
    return times;
}

// A row of dominoes that do not slip, with friction between them: the wave from the fourth to the last takes as long.
TEST(SolidBox, TopplesInARowAtTheSpeedOfTheory) {
    constexpr int count = 10;
    const Dominoes row{0.5, 0.075, 0.35, 0.2};
    const double push = 1.8 * std::sqrt(g / row.height), begun = 0.002 * row.height;
    world::SceneSpec spec = scene();
    spec.run.fps = 240;
    spec.contact.friction = row.friction;
    spec.colliders = {ground(0.0, 5.0)};
    std::vector<dvec3> places;
    for (int k = 0; k < count; ++k) {
        places.emplace_back((row.depth + row.gap) * k, row.height / 2, 0.0);
        SolidSpec one = box(std::to_string(k), places.back(), {row.depth, row.height, 0.2});
        if (k == 0) {  // it turns about its foot
            one.spin = {0.0, 0.0, -push};
            one.velocity = 0.5 * push * dvec3(row.height, row.depth, 0.0);
        }
        spec.bodies.add(one);
    }
    World world(spec);
    std::vector<double> starts;  // [s] at which the centres have gone so far as `begun`
    double before = 0;
    while (world.time() < 3.0 && std::ssize(starts) < count) {
        ASSERT_FALSE(world.advance());
        const std::size_t k = starts.size();
        const double way = glm::distance(motionOf(world, "solid." + std::to_string(k)).centre, places[k]);
        if (way > begun) starts.push_back(world.time() - world.tickSeconds() * (way - begun) / (way - before));
        before = way > begun ? 0.0 : way;
    }
    ASSERT_EQ(std::ssize(starts), count);
    const std::vector<double> theory = timesOfDominoes(row, push, count);
    const double time = std::accumulate(theory.begin() + 3, theory.begin() + count - 1, 0.0);
    EXPECT_NEAR((starts[count - 1] - starts[3]) / time, 1.0, 0.01);
}

// A ball is a point that keeps its radius from other surfaces, from cords too: it lies on four of them.
TEST(SolidBall, LiesOnCords) {
    world::SceneSpec spec = scene();
    std::vector<std::string> cords;
    for (const double side : {-0.03, 0.03})
        for (const bool isAlong : {false, true}) {
            world::RopeSpec cord;
            cord.name = std::to_string(cords.size());
            const double height = isAlong ? 0.0 : -2.0 * keep;
            cord.start = isAlong ? dvec3(-0.4, height, side) : dvec3(side, height, -0.4);
            cord.end = isAlong ? dvec3(0.4, height, side) : dvec3(side, height, 0.4);
            cord.segments = 16;
            cord.mass = 0.05;
            cord.hold = {"ends"};
            cord.thickness = keep / 2;
            cord.touch = world::Touch::others;
            spec.bodies.add(cord);
            cords.push_back("rope." + cord.name);
        }
    SolidSpec light = ball("ball", {0.01, 0.1, -0.005}, 0.08);
    light.density = 100;
    spec.bodies.add(light);
    World world(spec);
    for (int i = 0; i < 90; ++i) {
        ASSERT_FALSE(world.advance());
        const dvec3 centre = motionOf(world, "solid.ball").centre;
        EXPECT_GT(centre.y, 0.0);
        for (const std::string& name : cords) {
            const std::vector<dvec3> x = positionsOf(world, name);
            for (std::size_t k = 1; k < x.size(); ++k) {
                const dvec3 way = x[k] - x[k - 1], from = centre - x[k - 1];
                const double share = glm::clamp(glm::dot(from, way) / glm::dot(way, way), 0.0, 1.0);
                EXPECT_GT(glm::length(from - share * way), 0.08 + 0.95 * keep / 2) << name << ' ' << i;
            }
        }
    }
}

// A crate stands on a cloth that is pulled away: as long as the cloth is faster, the crate gains μ g.
TEST(SolidBox, IsDraggedByAClothThatIsPulledAway) {
    world::SceneSpec spec = scene();
    spec.materials["linen"].stretch = 2000.0;  // so that it does not stick and slip
    spec.colliders = {ground(0.0, 0.2)};
    world::ColliderSpec bar;
    bar.name = "bar";
    bar.shape = "box";
    bar.size = {0.02, 0.02, 0.4};
    bar.keys = {{.t = 0.0, .position = {-0.6, 0.02, 0.0}}, {.t = 0.3, .position = {-1.5, 0.02, 0.0}}};
    spec.colliders.push_back(bar);
    world::ClothSpec cloth = sheet("cloth", {-0.55, keep / 2, -0.15}, {1.2, 0, 0}, {0, 0, 0.3}, 36);
    cloth.hold = {"left"};
    cloth.holdOn = "collider.bar";
    spec.bodies.add(cloth);
    SolidSpec crate = box("crate", {-0.1, 0.0, 0.0}, {0.16, 0.12, 0.16});
    crate.thickness = keep / 2;
    crate.position.y = keep + 0.06;
    spec.bodies.add(crate);
    World world(spec);
    advanceBy(world, 0.05);
    const double before = motionOf(world, "solid.crate").velocity.x;
    advanceBy(world, 0.1);
    EXPECT_NEAR((before - motionOf(world, "solid.crate").velocity.x) / (spec.contact.friction * g * 0.1), 1.0, 0.05);
}

// A plate that two of its corners hold swings as a physical pendulum, T = 2π √(I / m g d).
TEST(SolidBox, SwingsAboutHeldPoints) {
    SolidSpec plate = box("plate", dvec3(0.0), {0.3, 0.4, 0.2});
    plate.thickness = 0.01;
    plate.collide = false;
    plate.touch = world::Touch::nothing;
    plate.hold = {"#8", "#12"};  // the upper corners at the left
    plate.rotation.z = 0.02 - std::atan2(0.14, 0.19);
    world::SceneSpec spec = exactScene(1.0 / 600);
    spec.bodies.add(plate);
    World world(spec);
    const std::vector<dvec3> start = world.points("solid.plate").x;
    const dvec3 axis = 0.5 * (start[8] + start[12]);
    const double mass = 500 * 0.3 * 0.4 * 0.2, arm = std::hypot(0.14, 0.19);
    const double period =
        2 * 3.14159265358979 * std::sqrt((mass * (0.09 + 0.16) / 12 + mass * arm * arm) / (mass * g * arm));
    std::vector<double> turns;
    double before = 0;
    for (int i = 0; i < 2400; ++i) {
        ASSERT_FALSE(world.advance());
        const double now = motionOf(world, "solid.plate").centre.x - axis.x;
        if (i > 0 && before < 0 && now >= 0) turns.push_back((i + before / (before - now)) / 600);
        before = now;
    }
    ASSERT_GE(turns.size(), 3U);
    EXPECT_NEAR((turns.back() - turns.front()) / static_cast<double>(turns.size() - 1) / period, 1.0, 1e-3);
    EXPECT_EQ(world.points("solid.plate").x[8], start[8]);
}

}  // namespace
}  // namespace taut::test::touching
