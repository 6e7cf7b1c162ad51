// Points that are tied to colliders and move with them: what `hold_on`, joints and the action hold add to a plan. It
// knows no tick; World moves the grips that it makes.
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

// Where the collider of that title, "collider.pole", is now; nothing where there is none.
using FindPose = std::function<std::optional<collision::Pose>(const std::string& collider)>;

bool isCollider(const std::string& target);
bool isCollider(const JointSide& side);
// Whether a joint ties points to a collider; then which is the collider and which the points.
bool isTie(const JointSpec& joint);
const std::string& colliderOf(const JointSpec& joint);
const JointSide& pointsOf(const JointSpec& joint);

// Adds the grips of the colliders that have hold of points of the plan by its bodies' `hold_on` and the scene's joints.
// Throws core::Error(badContent) where there is no such collider, or a point would be tied twice.
void addTies(IslandPlan& plan, const SceneSpec& spec, const FindPose& find);

// That each joint with a collider names points of some body and one collider. Throws core::Error(badContent).
void checkTies(const SceneSpec& spec, std::span<Body* const> bodies, const FindPose& find);

// Ties points (ascending) to the collider, at the positions x (all points of the plan) [m] that they have now. Expects
// that none is tied yet.
Grip tieTo(const std::string& collider, const collision::Pose& pose, std::vector<int> points, std::span<const dvec3> x);
// Frees the points from what colliders hold them by grips. Returns whether any was tied.
bool untie(IslandPlan& plan, std::span<const int> points);
// Whether a joint ties the body; of it, how many points it names.
bool names(const JointSide& side, const Body& body);
int countNamed(const JointSide& side, const Body& body);

// The path of a collider during a tick that begins at t0 [s].
mechanics::PosePath pathOf(const collision::Pose& from, const collision::Pose& to, double t0, double ticksPerSecond);
// Whether two velocities or spins differ by more than rounding.
bool isOther(const dvec3& a, const dvec3& b);
// Whether the second path continues the first at t [s] with the same pose and velocity, up to rounding.
bool goesOn(const mechanics::PosePath& before, const mechanics::PosePath& after, double t);

}  // namespace taut::world
