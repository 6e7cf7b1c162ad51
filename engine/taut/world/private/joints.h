// The joints of a scene: their ties, the sides that they could not tie, and the release of ties.
#pragma once

#include <string>
#include <vector>

#include "taut/plan/island_plan.h"

namespace taut::world {

struct JointInfo;
struct WorldImpl;

// Keeps the reports of how joints tied bodies, and adds the joints with colliders.
void takeJoints(WorldImpl& w, const std::vector<JointReport>& reports);

bool isJoint(const WorldImpl& w, const std::string& name);
void releaseJoints(WorldImpl& w, const std::string& name);
// Begins those whose time has come.
void beginJoints(WorldImpl& w);
// Releases the ties that the last tick overloaded. Runs between two ticks, so a repeated tick need not restore them.
void breakJoints(WorldImpl& w);
int jointsLeft(const WorldImpl& w, const JointInfo& info);  // ties that hold

}  // namespace taut::world
