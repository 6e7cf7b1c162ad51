// Holds what a scenario did against its goldens. It plays nothing and writes nothing.
#pragma once

#include "taut/regression/manifest.h"
#include "taut/regression/playing.h"
#include "taut/regression/scenario.h"
#include "taut/report/test_report.h"

namespace taut::regression {

// The pictures of the result are PNG files as bytes.
report::TestScenario judged(const Scenario& scenario, const Played& played, const GoldenFolder& folder,
                            const Manifest& manifest);

// Of a scenario that could not be played at all.
report::TestScenario brokenScenario(const Scenario& scenario, const std::string& fault);

// What has a golden and is asked for by no scenario of that name any more: "000120".
std::vector<std::string> leftOver(const Scenario& scenario, const Manifest& manifest);

std::string hexadecimal(std::uint64_t hash);  // 16 digits

}  // namespace taut::regression
