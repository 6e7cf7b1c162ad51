// Says in words why a run diverged and what would hold.
#pragma once

#include <string>
#include <string_view>

#include "world/island.h"
#include "world/step_choice.h"

namespace taut::world {

std::string explainDivergence(const Divergence& d, const Fault& fault, const StepChoice& choice,
                              const IslandPlan& plan, std::string_view methodTitle);

}  // namespace taut::world
