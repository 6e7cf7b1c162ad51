// A work-precision study as text: CSV and JSON for programs, a table for people.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "taut/study/steps_table.h"
#include "taut/study/work_precision.h"

namespace taut::study {

// The machine of the study: names and values, such as {"processor", "…"}.
using MachineFacts = std::vector<std::pair<std::string, std::string>>;

// A row a run, failed ones included; units stand in the names of the columns.
std::string workPrecisionCsv(const WorkPrecision& study);

// Everything but the observations, with the machine. `growth` may be empty.
std::string workPrecisionJson(const WorkPrecision& study, const std::vector<StepsRow>& steps,
                              const MachineFacts& machine);

// A line per method and precision: limit, measured order, cost of its best run and of the cheapest within 1 % and 0.1 %
// of the motion.
std::string workPrecisionSummary(const WorkPrecision& study);

std::string stepsSummary(const std::vector<StepsRow>& rows);

}  // namespace taut::study
