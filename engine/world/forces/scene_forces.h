// The forces that a scene file knows: gravity of [world], [wind.NAME] and [anchor.NAME].
#pragma once

#include <memory>

#include "taut/world/forces/force.h"
#include "taut/world/spec.h"

namespace taut::world {

// m g on every point.
std::shared_ptr<const Force> gravityForce(const WorldSpec& world);

// Air of the world's density on the triangles of the bodies that it names, every cloth if none; null where it has
// neither drag nor lift.
std::shared_ptr<const Force> windForce(const WindSpec& wind, double airDensity);

// Springs of no length from the target's points to the place.
std::shared_ptr<const Force> anchorForce(const AnchorSpec& anchor);
// Whether the anchor's target names a point of the body.
bool hasPointIn(const AnchorSpec& anchor, const Body& body);

// All of a scene, in their order.
ForceList sceneForces(const SceneSpec& spec);

}  // namespace taut::world
