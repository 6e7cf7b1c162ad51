// Points that are tied to colliders and move with them: the additions of `hold_on`, joints and the action hold to a
// plan. It knows no tick. World moves the grips that it makes.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

class JointSide;
struct JointSpec;
struct SceneSpec;

// The carriers of points, by name: "collider.pole", and joints and faces of figures (parseCollider()).
struct Holders {
    // The present pose; nothing if there is none of that name.
    std::function<std::optional<collision::Pose>(const std::string& holder)> poseOf;
    // The part of a collider that carries a point at x [m]: the nearest face of a figure, else the named part.
    std::function<std::string(const std::string& collider, const dvec3& x)> nearest;
};

bool isCollider(const std::string& target);
bool isCollider(const JointSide& side);
// Whether a joint ties points to a collider; then, which side is the collider and which the points.
bool isTie(const JointSpec& joint);
const std::string& colliderOf(const JointSpec& joint);
const JointSide& pointsOf(const JointSpec& joint);

// Adds grips of the plan's points for the bodies' `hold_on` and the scene's joints. Throws core::Error(badContent) if
// there is no such collider or a point would be tied twice.
void addTies(IslandPlan& plan, const SceneSpec& spec, const Holders& holders);

// Checks that each joint with a collider names one collider and points of some body. Throws core::Error(badContent).
void checkTies(const SceneSpec& spec, std::span<Body* const> bodies, const Holders& holders);

// Throws core::Error(badContent) if a joint of a plan with all its ties is open further than a weld reaches, and both
// sides are held, so that nothing closes it.
void expectClosable(const IslandPlan& plan, const SceneSpec& spec, const Holders& holders);

// Ties points (ascending) to the collider at their present positions x (all points of the plan) [m]: one grip for each
// holder. Expects that the collider is there and that none is tied yet.
std::vector<Grip> tieTo(const Holders& holders, const std::string& collider, std::span<const int> points,
                        std::span<const dvec3> x);
// The grip by which a collider carries a point; null: none does.
const Grip* carrierOf(const IslandPlan& plan, int point);
// Frees the points from the grips of colliders. Returns whether any was tied.
bool untie(IslandPlan& plan, std::span<const int> points);
// Throws core::Error(badContent) if a side of a joint that mount() makes names a place of a rigid body that is `away`
// [m] from the joint's.
void expectAtPlace(const JointSpec& joint, const JointSide& side, double away);
// Whether a side names bodies as a whole, without points.
bool isWhole(const JointSide& side);
// Whether a side of a joint names points of the body, and how many of its points or places the joint ties.
bool names(const JointSide& side, const Body& body);
int countTied(const JointSpec& joint, const JointSide& side, const Body& body);

// The path of a collider during a tick that starts at t0 [s].
mechanics::PosePath pathOf(const collision::Pose& from, const collision::Pose& to, double t0, double ticksPerSecond);
// Whether two velocities or spins differ by more than rounding.
bool isOther(const dvec3& a, const dvec3& b);
// Whether the second path continues the first at t [s] with the same pose and velocity, up to rounding.
bool goesOn(const mechanics::PosePath& before, const mechanics::PosePath& after, double t);

}  // namespace taut::world
