// A plan as text: tables for people, JSON for programs.
#pragma once

#include <string>

#include "taut/study/plan.h"
#include "taut/study/work_precision_text.h"

namespace taut::study {

// Need, evidence and result; the last lines have the changes to make.
std::string planSummary(const Plan& plan);

// Everything in it, with the machine.
std::string planJson(const Plan& plan, const MachineFacts& machine);

// One sentence: met, or how near it came.
std::string planVerdict(const Plan& plan);

}  // namespace taut::study
