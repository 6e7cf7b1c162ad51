// What the joints of a scene tie, what they name and do not tie, and what lets go.
#pragma once

#include <string>
#include <vector>

#include "taut/bodies/island_plan.h"

namespace taut::world {

struct JointInfo;
struct WorldImpl;

// Tells of them as they tied bodies, and of those with colliders.
void takeJoints(WorldImpl& w, const std::vector<JointReport>& reports);

bool isJoint(const WorldImpl& w, const std::string& name);
void releaseJoints(WorldImpl& w, const std::string& name);
// What the last tick has overloaded lets go. Between two ticks, so that no tick that is taken again has to hold it again.
void breakJoints(WorldImpl& w);
int jointsLeft(const WorldImpl& w, const JointInfo& info);  // ties that hold

}  // namespace taut::world
