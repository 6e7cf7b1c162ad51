// Compares the results of a scenario with its goldens. It plays nothing and writes nothing.
#pragma once

#include "taut/regression/manifest.h"
#include "taut/regression/playing.h"
#include "taut/regression/scenario.h"
#include "taut/report/test_report.h"

namespace taut::regression {

// The goldens and rules for scenarios.
struct Goldens {
    const GoldenFolder& folder;
    const Manifest& manifest;
    int bits = world::resultBits;  // of the results
};

// Whether the scenario has goldens of other bits: they cannot be compared.
bool isOutdated(const Scenario& scenario, const Goldens& goldens);

// The pictures of the result are PNG files as bytes. A scenario without pictures, with checks, that was never recorded
// passes by its checks, unless goldens are required of each. Of an outdated one the checks are judged; differences are
// in the pictures' figures and fail nothing.
report::TestScenario judged(const Scenario& scenario, const Played& played, const Goldens& goldens,
                            bool requiresGoldens);

// Of a scenario that was interrupted: failed, with how far it came.
report::TestScenario unfinished(const Scenario& scenario, const Played& played);

// Of a scenario that could not be played at all.
report::TestScenario brokenScenario(const Scenario& scenario, const std::string& fault);
report::TestScenario unreadScenario(const UnreadScenario& scenario);

// Goldens that no scenario of that name uses any more: "000120".
std::vector<std::string> leftOver(const Scenario& scenario, const Manifest& manifest);

// When a picture is right: "at most 0.11 % of its pixels are off by …".
std::string inWords(const image::Tolerance& tolerance);

// Of pictures that another renderer drew than their goldens, and the tolerance that they have; empty where there are
// none.
std::string otherRendererNote(const report::TestReport& report, const Manifest& manifest);

}  // namespace taut::regression
