// The search among methods, steps and precisions for the cheapest that meets the need.
#pragma once

#include "taut/study/plan_reference.h"

namespace taut::study {

// Fills plan.trials and plan.chosen. `least` is the coarsest resolution that can do; where none can, the finest shows
// how near the scene comes. `without` are the sets of generators that a candidate may leave out, the first the safest.
void searchCandidates(const PlanContext& context, const PlanReference& reference, std::optional<int> least,
                      const std::vector<Generators>& without, Plan& plan);

// Discards the choice, which failed the verification, for the next cheapest that meets the need, if any.
void rejectChosen(Plan& plan);

// Says of each trial why it was not chosen.
void judgeTrials(const PlanContext& context, Plan& plan);

// The scene that a candidate stands for.
world::SceneSpec sceneOf(const PlanContext& context, const Candidate& candidate);

}  // namespace taut::study
