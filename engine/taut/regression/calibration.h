// Measures the tolerance of golden pictures: pictures of the same state that differ by noise, which must pass, and
// pictures with a deliberate error, which must not. It changes no golden.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "taut/image/private/compare.h"
#include "taut/regression/drawer.h"
#include "taut/regression/scenario.h"
#include "taut/report/test_report.h"

namespace taut::regression {

// The tolerance has to stand that many times above any noise: see image::Tolerance for why.
inline constexpr double noiseMargin = 2.0;

// A process of its own in which a picture is drawn otherwise than here.
struct Apart {
    std::string name;       // "4 threads", "SSE2"
    int threads = 1;        // of the world and the renderer
    std::string processor;  // the instructions that the renderer may use, as Mesa calls them: "sse2"; empty: all
};

struct CalibrationOptions {
    DrawingOptions drawing;
    image::Tolerance tolerance;
    // Draws one golden picture in such a process into a PNG file, and returns the state hash there; none where that is
    // not possible.
    std::function<std::string(const Scenario&, const GoldenRequest&, const Apart&, const std::filesystem::path& png)>
        drawApart{};
    std::filesystem::path scratch;  // a folder for those files
    std::function<void(double done, const std::string& doing)> progress{};
};

// For every golden picture of the scenarios the noise and the mutants. A row is refused when noise, noiseMargin times
// as much, would fail the test, when a mutant of the picture would pass it, and when a mutant of the state leaves the
// chain of hashes as it is.
std::vector<report::CalibrationRow> calibrate(const std::vector<Scenario>& scenarios, const CalibrationOptions& options,
                                              const std::atomic<bool>& stop);

}  // namespace taut::regression
