// Joints at a place between two rigid bodies, made of pins: a ball joint is one, a hinge two on its axis; a slider is
// three that hold across its axis only (private/slide.h). Their limit is a leash between two spots that the bodies
// carry, so that one row ends a turn or a slide at either limit:
//
//          a         arm r of a at the middle of the limits, arm of b at the turn: the spots are
//         /          2 r sin(|turn - middle| / 2) apart
//        o----b
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/core/across.h"
#include "taut/core/error.h"
#include "taut/core/trig.h"
#include "taut/fields/private/problems.h"
#include "taut/joints/joints.h"
#include "taut/joints/private/axles.h"
#include "taut/joints/private/only_constraint.h"
#include "taut/joints/private/rods.h"
#include "taut/joints/private/slide.h"
#include "taut/plan/island_plan.h"
#include "taut/plan/mounting.h"
#include "taut/plan/private/pins.h"
#include "taut/spec/common_rows.h"

namespace taut::world {
namespace {

void pin(IslandPlan& plan, const Mounting& at, const dvec3& place, const Source& source) {
    changeOnly<Pins>(
        plan,
        [&](Pins& pins) { std::visit([&](const auto& end) { pins.tie(at.a(place), end, source); }, at.b(place)); });
}

// Keeps a spot of a, at `first`, within the length of one of b, at `second`.
void leash(IslandPlan& plan, const Mounting& at, const dvec3& first, const dvec3& second, double length,
           const Source& source) {
    changeOnly<Rods>(
        plan,
        [&](Rods& rods) {
            std::visit([&](const auto& end) { rods.tie(at.a(first), end, length, source, true); }, at.b(second));
        });
}

[[noreturn]] void failMount(const JointSpec& joint) {
    throw core::Error(core::ErrorKind::badContent, at(joint.source) + std::string(joint.title()) + " needs a place");
}

// Throws core::Error(badContent) if a side is a single point, which has no axis. off: a place beside the joint.
void expectAxes(const JointSpec& joint, const Mounting& at, const dvec3& off, const char* why) {
    const dvec3& middle = at.at.position;
    const Mounting::End there = at.b(middle), beside = at.b(off);
    const Spot* point = std::get_if<Spot>(&there);
    if (!(at.a(middle) == at.a(off)) && (point == nullptr || !(*point == std::get<Spot>(beside)))) return;
    throw core::Error(core::ErrorKind::badContent, world::at(joint.source) + std::string(joint.title()) + why +
                                                       " needs a rigid body or a collider on each side: a point has "
                                                       "no axis");
}

template <class Own>
Kind<JointSpec> mountedKind(std::string help, fields::FieldList<Own> own) {
    own.direction("axis", &Own::axis, "Its direction, in the same axes as `place`.");
    Kind<JointSpec> kind = jointKind<Own>(std::move(help), std::move(own));
    for (fields::Field& row : kind.section.fields)
        if (row.key == "place") row.required = true;
    return kind;
}

// Adds checks of the limits and of the motor: the key, the error and an example of each.
template <class Own>
void checkDrive(Kind<JointSpec>& kind, const char* limits, const char* notBetween, const char* pair, const char* motor,
                const char* noMost, const char* most) {
    kind.section.check = [=, rest = kind.section.check](const fields::CheckInput& input, void* target) {
        rest(input, target);
        const Own& own = *static_cast<const Own*>(target);
        if (own.limits && !(own.limits->x <= 0 && own.limits->y >= 0 && own.limits->x < own.limits->y))
            input.problems.addError(input.at(limits), notBetween, pair);
        if (own.motorSpeed != 0 && !(own.motorMost > 0)) input.problems.addError(input.at(motor), noMost, most);
    };
}

}  // namespace

void BallJoint::mount(IslandPlan& plan, const Mounting& at) const {
    const dvec3& middle = at.at.position;
    pin(plan, at, middle, source);
    if (!cone || *cone >= core::pi) return;
    const dvec3 end = middle + at.size * glm::normalize(at.at.rotation * axis);
    expectAxes(*this, at, end, " with cone_deg");
    leash(plan, at, end, end, 2.0 * at.size * core::sine(0.5 * *cone), source);
}

void BallJoint::carry(IslandPlan&, const Spot&, Grip) const {
    failMount(*this);
}

void HingeJoint::mount(IslandPlan& plan, const Mounting& at) const {
    const dvec3& middle = at.at.position;
    const dvec3 along = glm::normalize(at.at.rotation * axis), across = core::acrossOf(along);
    const dvec3 half = (0.5 * at.size) * along, arm = at.size * across;
    expectAxes(*this, at, middle + half, "");
    pin(plan, at, middle - half, source);
    pin(plan, at, middle + half, source);
    if (limits && limits->y - limits->x < 2.0 * core::pi) {
        const double mean = 0.5 * (limits->x + limits->y), range = 0.5 * (limits->y - limits->x);
        const dvec3 turned = core::cosine(mean) * arm + core::sine(mean) * glm::cross(along, arm);
        leash(plan, at, middle + turned, middle + arm, 2.0 * at.size * core::sine(0.5 * range), source);
    }
    if (friction > 0 || damping > 0 || motorMost > 0)
        plan.constraints.push_back(
            std::make_shared<Axle>(Constraint::Drive{{0, 0, 0}, {0, 0, 0}, damping, friction, motorSpeed, motorMost},
                                   at, std::array{middle - half, middle + half, middle + arm}));
}

void HingeJoint::carry(IslandPlan&, const Spot&, Grip) const {
    failMount(*this);
}

// As no body turns against the other, the axis may go through any place: the centre of one, where spots are exact.
void SliderJoint::mount(IslandPlan& plan, const Mounting& at) const {
    const dvec3& middle = at.centre;
    const dvec3 along = glm::normalize(at.at.rotation * axis);
    const dvec3 half = (0.5 * at.size) * along, arm = at.size * core::acrossOf(along);
    expectAxes(*this, at, middle + half, "");
    plan.constraints.push_back(
        std::make_shared<Slide>(Constraint::Drive{{0, 0, 0}, {0, 0, 0}, damping, friction, motorSpeed, motorMost}, at,
                                std::array{middle - half, middle + half, middle + arm}));
    if (limits)
        leash(plan, at, middle + 0.5 * (limits->x + limits->y) * along, middle, 0.5 * (limits->y - limits->x), source);
}

void SliderJoint::carry(IslandPlan&, const Spot&, Grip) const {
    failMount(*this);
}

Kind<JointSpec> ballKind() {
    return mountedKind<BallJoint>(
        "A ball joint holds two bodies together at `place`, about which they turn in any way. One or both are "
        "rigid; of others it is the nearest point of a side. Sides collide with each other only if `touch` is set.",
        fields::FieldList<BallJoint>().degrees("cone_deg", &BallJoint::cone, fields::Range{0.1, 180.0},
                                               "Largest angle between the axis of the one body and that of the other, "
                                               "which are one as the scene starts; any if not given."));
}

Kind<JointSpec> hingeKind() {
    Kind<JointSpec> kind = mountedKind<HingeJoint>(
        "A hinge holds two rigid bodies, or one and a collider, together at an axis through `place`. "
        "Sides collide with each other only if `touch` is set.",
        fields::FieldList<HingeJoint>()
            .vector(
                "limits_deg", &HingeJoint::limits, "degrees", fields::Range{-180.0, 180.0},
                "Least and largest turn of b about the axis since the start, counter-clockwise seen against it; any if "
                "not given. It stops there without a bounce.",
                core::radians(1.0))
            .number("friction_N_m", &HingeJoint::friction, "N m", fields::notNegative,
                    "Largest torque with which friction slows the turn, and holds.")
            .number("damping_N_m_s", &HingeJoint::damping, "N m s", fields::notNegative,
                    "Torque against the turn over its speed, as of a door closer.")
            .number("motor_rad_per_s", &HingeJoint::motorSpeed, "rad/s", fields::Range{-1e4, 1e4},
                    "Speed of b's turn that a motor seeks, with up to motor_N_m; 0: it holds.")
            .number("motor_N_m", &HingeJoint::motorMost, "N m", fields::notNegative,
                    "Largest torque of the motor; 0: there is none."));
    checkDrive<HingeJoint>(kind, "limits_deg", "the limits are turns since the start, which is 0 and between them",
                           "e.g. limits_deg = [0, 90]", "motor_rad_per_s", "a motor has a torque",
                           "e.g. motor_N_m = 10");
    return kind;
}

Kind<JointSpec> sliderKind() {
    Kind<JointSpec> kind = mountedKind<SliderJoint>(
        "A slider holds two rigid bodies, or one and a collider, so that b slides along an axis of a, without turning. "
        "`place` is in the axes of `axis`, and may be anywhere. Sides collide with each other only if `touch` is set.",
        fields::FieldList<SliderJoint>()
            .vector("limits_m", &SliderJoint::limits, "m", placeRange,
                    "Least and largest way of b along the axis since the start; any if not given. It stops there "
                    "without a bounce.")
            .number("friction_N", &SliderJoint::friction, "N", fields::notNegative,
                    "Largest force with which friction slows the slide, and holds.")
            .number("damping_N_s_per_m", &SliderJoint::damping, "N s/m", fields::notNegative,
                    "Force against the slide over its speed.")
            .number("motor_m_per_s", &SliderJoint::motorSpeed, "m/s", fields::Range{-1e3, 1e3},
                    "Speed of b along the axis that a motor seeks, with up to motor_N; 0: it holds.")
            .number("motor_N", &SliderJoint::motorMost, "N", fields::notNegative,
                    "Largest force of the motor; 0: there is none."));
    checkDrive<SliderJoint>(kind, "limits_m", "the limits are ways since the start, which is 0 and between them",
                            "e.g. limits_m = [0, 0.2]", "motor_m_per_s", "a motor has a force", "e.g. motor_N = 10");
    return kind;
}

}  // namespace taut::world
