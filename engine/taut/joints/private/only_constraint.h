// The one constraint of its sort in a plan, such as all rods, which it solves for together.
#pragma once

#include <memory>

#include "taut/plan/constraint.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

// Calls change(own) with it; makes it if there is none. If others share it, a changed copy replaces it in this plan.
template <class Own, class Change>
void changeOnly(IslandPlan& plan, const Change& change) {
    for (auto& constraint : plan.constraints)
        if (const auto* own = dynamic_cast<const Own*>(constraint.get())) {
            if (constraint.use_count() == 1) return change(const_cast<Own&>(*own));  // while the plan is made
            auto changed = std::make_shared<Own>(*own);
            change(*changed);
            constraint = std::move(changed);
            return;
        }
    auto made = std::make_shared<Own>();
    change(*made);
    plan.constraints.push_back(std::move(made));
}

}  // namespace taut::world
