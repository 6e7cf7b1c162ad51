// What taut and theory say, as text: CSV for programs, a table for people, a page for browsers.
#pragma once

#include <string>

#include "taut/reality/comparison.h"

namespace taut::reality {

// A row a line of the table; units stand in the names of the columns.
std::string csv(const Comparison& comparison);
// Γ and H/W of every curve of the chart.
std::string droopsCsv(const Comparison& comparison);
std::string summary(const Comparison& comparison);

// One HTML page that needs nothing besides. `svg`: the chart; empty: none. `note`: the machine.
std::string page(const Comparison& comparison, const std::string& svg, const std::string& note);

}  // namespace taut::reality
