// Calibrates golden pictures for a command: it runs processes for other numbers of threads and other processors. It
// knows neither goldens nor reports.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "taut/regression/calibration.h"

namespace taut::game {

struct CalibrationRequest {
    const std::vector<regression::Scenario>& scenarios;
    regression::DrawingOptions drawing;
    image::Tolerance tolerance;
    std::string gl;  // as in the flag --gl; empty: the first that works
    bool quiet = false;
};

// Throws core::Error(inputOutput) when one of these processes fails.
std::vector<report::CalibrationRow> runCalibration(const CalibrationRequest& request, const std::atomic<bool>& stop);

}  // namespace taut::game
