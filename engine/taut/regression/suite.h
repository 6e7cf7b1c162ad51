// Plays many scenarios side by side and judges each. It knows neither the command line nor where a report goes.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "taut/regression/drawer.h"
#include "taut/regression/manifest.h"
#include "taut/regression/playing.h"
#include "taut/regression/scenario.h"
#include "taut/report/test_report.h"

namespace taut::regression {

struct SuiteOptions {
    int sideBySide = 1;   // scenarios at the same time
    int threadsEach = 0;  // of a world; 0: as many as the machine has
    DrawingOptions drawing;
    GoldenFolder goldens;
    bool requiresGoldens = false;  // checks alone do not pass
    int bits = world::resultBits;  // of the results
    // Called as scenarios end, one at a time.
    std::function<void(int done, const report::TestScenario& scenario)> scenarioDone{};
};

// In the order of the scenarios; `renderer` becomes the one in use. A scenario that cannot be built fails alone; throws
// core::Error(noRenderer) if pictures are needed and there is no renderer. After `stop` scenarios that have not begun
// are left out.
std::vector<report::TestScenario> runSuite(const std::vector<Scenario>& scenarios, const SuiteOptions& options,
                                           const Manifest& manifest, std::string& renderer,
                                           const std::atomic<bool>& stop);

// By falling cost, so that no long one is left alone at the end.
std::vector<std::size_t> longestFirst(const std::vector<Scenario>& scenarios);

// The goldens of a folder as where restart pictures take their states from.
std::function<std::optional<std::vector<std::byte>>(const GoldenRequest&)> storedStates(const GoldenFolder& folder,
                                                                                        const Scenario& scenario);

}  // namespace taut::regression
