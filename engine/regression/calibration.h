// Measures what the tolerance of golden pictures lets through: pictures of the same state that differ by noise, which
// it should, and those with a mistake in them, which it must not. It changes no golden.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "taut/image/compare.h"
#include "taut/regression/drawer.h"
#include "taut/regression/scenario.h"
#include "taut/report/test_report.h"

namespace taut::regression {

struct CalibrationOptions {
    DrawingOptions drawing;
    image::Tolerance tolerance;
    // Draws one golden picture in a process of its own that uses so many threads, into a PNG file, and returns the
    // state hash there; empty where that is not possible.
    std::function<std::string(const Scenario&, const GoldenRequest&, int threads, const std::filesystem::path& png)>
        drawApart{};
    std::filesystem::path scratch;  // a folder for those files
    std::function<void(double done, const std::string& doing)> progress{};
};

// For every golden picture of the scenarios the noise and the mutants. A row is refused when noise would fail the test,
// when a mutant of the picture would pass it, and when a mutant of the state leaves the chain of hashes as it is.
std::vector<report::CalibrationRow> calibrate(const std::vector<Scenario>& scenarios, const CalibrationOptions& options,
                                              const std::atomic<bool>& stop);

}  // namespace taut::regression
