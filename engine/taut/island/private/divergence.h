// Says in words why a run diverged and what would hold.
#pragma once

#include <string>
#include <string_view>

#include "taut/island/private/island.h"
#include "taut/island/private/step_choice.h"

namespace taut::world {

std::string explainDivergence(const Divergence& d, const Fault& fault, const StepChoice& choice, const IslandPlan& plan,
                              std::string_view methodTitle);

// Says that a method's solves did not reach their tolerance.
std::string unconvergedWarning(const ode::Work& work, const IslandPlan& plan);

// The same in one line, for an island that is kept as it was.
std::string explainFreeze(const FrozenIsland& frozen, const StepChoice& choice, std::string_view methodTitle);

}  // namespace taut::world
