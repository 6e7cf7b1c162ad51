// A refinement study as text: CSV and JSON for programs, a table for people.
#pragma once

#include <string>

#include "taut/study/refinement.h"
#include "taut/study/work_precision_text.h"

namespace taut::study {

// A row a run; units stand in the names of the columns.
std::string refinementCsv(const RefinementStudy& study);

std::string refinementJson(const RefinementStudy& study, const MachineFacts& machine);

// A line a body and treatment: the error at each resolution in per cent, and the order.
std::string refinementSummary(const RefinementStudy& study);

}  // namespace taut::study
