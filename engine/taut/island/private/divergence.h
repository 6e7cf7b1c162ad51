// Says in words why a run diverged and which step would hold.
#pragma once

#include <string>
#include <string_view>

#include "taut/island/private/island.h"
#include "taut/island/private/step_choice.h"

namespace taut::world {

std::string explainDivergence(const Divergence& d, const Fault& fault, const StepChoice& choice, const IslandPlan& plan,
                              std::string_view methodTitle);

// Warns that solves of a method did not reach their tolerance.
std::string unconvergedWarning(const ode::Work& work, const IslandPlan& plan);

// The diagnosis in one line, for an island that is frozen.
std::string explainFreeze(const FrozenIsland& frozen, const StepChoice& choice, std::string_view methodTitle);

}  // namespace taut::world
