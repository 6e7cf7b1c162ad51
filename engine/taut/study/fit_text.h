// A fit as text for people and as JSON.
#pragma once

#include <string>

#include "taut/study/fit.h"
#include "taut/study/work_precision_text.h"

namespace taut::study {

// Trials, numbers, targets and the verdict.
std::string fitSummary(const Fit& fit);

// In a few sentences: whether the targets are met, numbers that cannot be told apart, numbers at a bound.
std::string fitVerdict(const Fit& fit);

std::string fitJson(const Fit& fit, const MachineFacts& machine);

}  // namespace taut::study
