// Evaluates the checks of a scenario while it is played, as a report has them. It knows neither goldens nor pictures.
#pragma once

#include <vector>

#include "taut/check/watcher.h"
#include "taut/report/test_report.h"

namespace taut::regression {

// As the scenario lists them; `broken` when the run ended before its end, so that some moments have not come.
std::vector<report::TestCheck> reported(const std::vector<check::Result>& results, bool broken);

}  // namespace taut::regression
