// Points that are tied to colliders and move with them: what `hold_on`, joints and the action hold add to a plan. It
// knows no tick. World moves the grips that it makes.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/bodies/island_plan.h"

namespace taut::world {

class JointSide;
struct JointSpec;
struct SceneSpec;

// The present pose of the collider "collider.pole"; nothing if there is none.
using FindPose = std::function<std::optional<collision::Pose>(const std::string& collider)>;

bool isCollider(const std::string& target);
bool isCollider(const JointSide& side);
// Whether a joint ties points to a collider; then, which side is the collider and which the points.
bool isTie(const JointSpec& joint);
const std::string& colliderOf(const JointSpec& joint);
const JointSide& pointsOf(const JointSpec& joint);

// Adds grips of the plan's points for the bodies' `hold_on` and the scene's joints. Throws core::Error(badContent) if
// there is no such collider or a point would be tied twice.
void addTies(IslandPlan& plan, const SceneSpec& spec, const FindPose& find);

// Checks that each joint with a collider names one collider and points of some body. Throws core::Error(badContent).
void checkTies(const SceneSpec& spec, std::span<Body* const> bodies, const FindPose& find);

// Ties points (ascending) to the collider at their present positions x (all points of the plan) [m]. Expects that none
// is tied yet.
Grip tieTo(const std::string& collider, const collision::Pose& pose, std::vector<int> points, std::span<const dvec3> x);
// Frees the points from the grips of colliders. Returns whether any was tied.
bool untie(IslandPlan& plan, std::span<const int> points);
// Whether a side of a joint names points of the body, and how many.
bool names(const JointSide& side, const Body& body);
int countNamed(const JointSide& side, const Body& body);

// The path of a collider during a tick that starts at t0 [s].
mechanics::PosePath pathOf(const collision::Pose& from, const collision::Pose& to, double t0, double ticksPerSecond);
// Whether two velocities or spins differ by more than rounding.
bool isOther(const dvec3& a, const dvec3& b);
// Whether the second path continues the first at t [s] with the same pose and velocity, up to rounding.
bool goesOn(const mechanics::PosePath& before, const mechanics::PosePath& after, double t);

}  // namespace taut::world
