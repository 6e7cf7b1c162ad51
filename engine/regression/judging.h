// Holds what a scenario did against its goldens. It plays nothing and writes nothing.
#pragma once

#include "taut/regression/manifest.h"
#include "taut/regression/playing.h"
#include "taut/regression/scenario.h"
#include "taut/report/test_report.h"

namespace taut::regression {

// The pictures of the result are PNG files as bytes. A scenario that asks for no pictures, has checks and was never
// recorded passes by its checks, unless goldens are required of each.
report::TestScenario judged(const Scenario& scenario, const Played& played, const GoldenFolder& folder,
                            const Manifest& manifest, bool requiresGoldens);

// Of a scenario that was interrupted: failed, with how far it came.
report::TestScenario unfinished(const Scenario& scenario, const Played& played);

// Of a scenario that could not be played at all.
report::TestScenario brokenScenario(const Scenario& scenario, const std::string& fault);
report::TestScenario unreadScenario(const UnreadScenario& scenario);

// What has a golden and is asked for by no scenario of that name any more: "000120".
std::vector<std::string> leftOver(const Scenario& scenario, const Manifest& manifest);

std::string hexadecimal(std::uint64_t hash);  // 16 digits

}  // namespace taut::regression
