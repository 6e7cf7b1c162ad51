// Results of taut and of theory as text: CSV for programs, a table for people, a page for browsers.
#pragma once

#include <string>
#include <vector>

#include "taut/reality/comparison.h"

namespace taut::reality {

// A row a line of the table; units stand in the names of the columns.
std::string csv(const Comparison& comparison);
// Γ and H/W of every curve of the chart.
std::string droopsCsv(const Comparison& comparison);
// Drape coefficient, its spread and the number of folds of every fabric and weight.
std::string drapesCsv(const Comparison& comparison);
std::string summary(const Comparison& comparison);

// One HTML page that needs nothing besides. `charts`: as SVG. `note`: the machine.
std::string page(const Comparison& comparison, const std::vector<std::string>& charts, const std::string& note);

}  // namespace taut::reality
