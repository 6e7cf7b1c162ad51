// A refinement study as text: CSV for programs, a table for people.
#pragma once

#include <string>

#include "taut/study/refinement.h"

namespace taut::study {

// A row a run; units stand in the names of the columns.
std::string refinementCsv(const RefinementStudy& study);

// A line a body and treatment: the error at each resolution in per cent, and the order.
std::string refinementSummary(const RefinementStudy& study);

}  // namespace taut::study
