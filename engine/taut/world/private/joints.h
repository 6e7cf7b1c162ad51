// What the joints of a scene tie, what they name but do not tie, and which ties let go.
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
// Lets go of the ties that the last tick overloaded. Runs between two ticks, so a repeated tick need not restore them.
void breakJoints(WorldImpl& w);
int jointsLeft(const WorldImpl& w, const JointInfo& info);  // ties that hold

}  // namespace taut::world
