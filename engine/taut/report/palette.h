// Colours and marks of series: distinct for colour-blind people, in grey, and the same in every chart. It uses names,
// not their meaning.
#pragma once

#include <string_view>
#include <vector>

#include "taut/report/chart.h"

namespace taut::report {

// The style of a series by its name: methods have theirs for good, other names get one of the same kind by a hash.
Style styleOf(std::string_view name);

// A scale for growth per step: cool below 1 (stable), white at 1, warm above.
ColourScale divergingScale(double least, double middle, double most);

}  // namespace taut::report
