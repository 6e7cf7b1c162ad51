// Actions built in code, and a scene in which everything happens that can, for tests of the world.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/small_scenes.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/forces/anchor.h"
#include "taut/forces/wind.h"
#include "taut/spec/actions.h"
#include "taut/world/world.h"

namespace taut::support {

inline constexpr double g = 9.81;  // [m/s²]

inline void run(world::World& world, int ticks) {
    for (int i = 0; i < ticks; ++i) {
        const auto divergence = world.advance();
        ASSERT_FALSE(divergence) << divergence->message;
    }
}

// At t [s], on the target if it takes one.
template <class Own>
Own action(double t, const std::string& target = "") {
    Own spec;
    spec.t = t;
    if constexpr (requires { spec.target; }) spec.target = target;
    spec.source = {"timeline.toml", 7, 3};
    return spec;
}

inline world::GrabAction grab(double t, const std::string& target, bool rigid = false) {
    auto spec = action<world::GrabAction>(t, target);
    spec.id = "hand";
    spec.rigid = rigid;
    return spec;
}
inline world::MoveAction moveHand(double t, world::dvec3 to, double over, world::Ease ease = world::Ease::smooth) {
    auto spec = action<world::MoveAction>(t);
    spec.id = "hand";
    spec.to = to;
    spec.over = over;
    spec.ease = ease;
    return spec;
}
inline world::ReleaseAction release(double t) {
    auto spec = action<world::ReleaseAction>(t);
    spec.id = "hand";
    return spec;
}
inline world::PushAction push(double t, const std::string& target, world::dvec3 impulse) {
    auto spec = action<world::PushAction>(t, target);
    spec.impulse = impulse;
    return spec;
}
inline world::CutAction cutPlane(double t, const std::string& target, world::dvec3 point, world::dvec3 normal) {
    auto spec = action<world::CutAction>(t, target);
    spec.planePoint = point;
    spec.planeNormal = normal;
    return spec;
}
inline world::CutAction cutSegment(double t, const std::string& target, world::dvec2 from, world::dvec2 upTo) {
    auto spec = action<world::CutAction>(t, target);
    spec.from = from;
    spec.upTo = upTo;
    return spec;
}

// A number that `at` finds in the scene.
template <class At>
struct NumberAt final : world::RampField {
    explicit NumberAt(At finder) : at(finder) {}
    std::vector<double> read(const world::SceneSpec& s) const override {
        return {at(const_cast<world::SceneSpec&>(s))};
    }
    void write(world::SceneSpec& s, const std::vector<double>& v) const override { at(s) = v.front(); }
    At at;
};

template <class At>
world::RampAction ramp(double t, const std::string& key, fields::Affects affects, double value, double over,
                       world::Ease ease, At at) {
    auto spec = action<world::RampAction>(t);
    spec.key = key;
    spec.value = {value};
    spec.over = over;
    spec.ease = ease;
    auto field = std::make_shared<NumberAt<At>>(at);
    field->affects = affects;
    field->owner = key.substr(0, key.rfind('.'));
    spec.field = std::move(field);
    return spec;
}

// Half a second of everything: a cloth in the wind that is cut and torn, a rope in a hand, a bar that bends for good,
// a net led rigidly, a box that is moved, a ball with less and less friction, a rope that appears.
inline world::SceneSpec everythingHappens(const std::string& method = "leapfrog", bool isDouble = false) {
    using Affects = fields::Affects;
    using namespace world;
    world::SceneSpec scene;
    scene.solver.integrator = method;
    if (method == "implicit-euler") scene.solver.dt = 1.0 / 240;
    scene.solver.precision = isDouble ? world::Precision::double_ : world::Precision::single_;
    world::MaterialSpec linen;
    linen.stretch = 300;
    linen.dampingTime = 1e-3;
    linen.plasticity.breakStrain = 0.2;
    scene.materials["linen"] = linen;
    scene.bodies.add(cloth("sheet", 6));
    scene.bodies.of<world::ClothSpec>()[0].material = "linen";
    scene.bodies.of<world::ClothSpec>()[0].hold = {"top"};
    scene.bodies.add(rope("late", {3, 2, 0}, {4, 2, 0}, 5));
    scene.bodies.add(rope("line", {-2, 2, 0}, {-1, 2, 0}, 8));
    for (world::RopeSpec& r : scene.bodies.of<world::RopeSpec>()) {
        r.hold = {"start"};
        r.dampingTime = 1e-3;
        r.stretch = 400;
    }
    world::BlockSpec bar;
    bar.name = "bar";
    bar.size = {0.6, 0.1, 0.1};
    bar.cells = {6, 1, 1};
    bar.position = {0, 1.0, 2};
    bar.hold = {"left"};
    bar.plasticity.yieldStrain = 0.05;
    bar.workingStretch = 2;  // where it yields
    bar.dampingTime = 2e-3;
    scene.bodies.add(bar);
    world::WindSpec wind;
    wind.name = "breeze";
    wind.velocity = {3, 0, 1};
    wind.gustAmplitude = 1;
    scene.forces.add(wind);
    world::ColliderSpec box;
    box.name = "box";
    box.shape = "box";
    box.size = {0.4, 0.4, 0.4};
    box.position = {0.5, 1.4, -0.6};
    scene.colliders = {ball("ball", {-1.2, 1.2, 0}, 0.4), box};
    world::AnchorSpec anchor;
    anchor.name = "peg";
    anchor.target = "rope.line@end";
    anchor.at = {-1, 2, 0};
    anchor.stiffness = 30;
    anchor.damping = 0.1;
    scene.forces.add(anchor);

    auto rigid = grab(0.05, "block.bar@right", true);
    rigid.id = "vice";
    auto bend = moveHand(0.05, {0.2, 0.85, 2}, 0.2);
    bend.id = "vice";
    auto letGo = release(0.4);
    letGo.id = "vice";
    auto slide = action<MoveAction>(0.1, "collider.box");
    slide.to = world::dvec3{0.5, 1.4, 0.1};
    slide.rotation = world::dvec3{0, 0.5, 0};
    slide.over = 0.3;
    auto weight = action<AddMassAction>(0.2, "rope.line@50%");
    weight.mass = 0.3;
    auto pull = grab(0.1, "cloth.sheet@bottom-right");
    pull.radius = 0.2;
    pull.strength = 60;
    scene.actions = {
        rigid,
        bend,
        ramp(0.05, "anchor.peg.stiffness", Affects::forces, 60, 0.1, Ease::linear,
             [](world::SceneSpec& s) -> double& { return s.forces.of<world::AnchorSpec>()[0].stiffness; }),
        pull,
        slide,
        moveHand(0.12, {1.3, 0.9, 0.3}, 0.25),
        ramp(0.1, "world.gravity", Affects::forces, -4.0, 0.2, Ease::smooth,
             [](world::SceneSpec& s) -> double& { return s.world.gravity.y; }),
        ramp(0.1, "wind.breeze.velocity", Affects::forces, 9.0, 0.3, Ease::in,
             [](world::SceneSpec& s) -> double& { return s.forces.of<world::WindSpec>()[0].velocity.x; }),
        ramp(0.15, "wind.breeze.gust", Affects::forces, 3.0, 0.1, Ease::out,
             [](world::SceneSpec& s) -> double& { return s.forces.of<world::WindSpec>()[0].gustAmplitude; }),
        ramp(0.1, "material.linen.stretch", Affects::springs, 600, 0.2, Ease::linear,
             [](world::SceneSpec& s) -> double& { return s.materials["linen"].stretch; }),
        ramp(0.1, "collider.ball.friction", Affects::colliders, 0.0, 0.3, Ease::linear,
             [](world::SceneSpec& s) -> double& { return s.colliders[0].friction; }),
        ramp(0.1, "light.intensity", Affects::picture, 1.0, 0.3, Ease::linear,
             [](world::SceneSpec& s) -> double& { return s.light.intensity; }),
        push(0.15, "rope.line", {0, 0, 0.5}),
        action<FreeAction>(0.2, "cloth.sheet@top-left"),
        weight,
        cutSegment(0.2, "cloth.sheet", {0.3, 0.45}, {1.1, 0.45}),
        action<HoldAction>(0.25, "rope.line@end"),
        action<SpawnAction>(0.25, "rope.late"),
        release(0.35),
        letGo,
        action<FreeAction>(0.4, "rope.line@end"),
    };
    return scene;
}

}  // namespace taut::support
