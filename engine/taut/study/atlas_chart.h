// The pictures of the atlas, as descriptions that report draws.
#pragma once

#include <string>
#include <vector>

#include "taut/report/chart.h"
#include "taut/study/phase_plane.h"
#include "taut/study/stability_map.h"
#include "taut/study/threshold.h"

namespace taut::study {

// A panel a method, and one that compares them for equal work. `notes` stand at the foot: the program.
report::Chart stabilityChart(const StabilityMap& map, const std::vector<std::string>& notes);

// A panel a method: the vector field, the exact circle, and where the steps lead.
report::Chart phasePlaneChart(const std::vector<PhasePath>& paths, const std::vector<std::string>& notes);

// A line a method: the threshold measured, and where the bounds and theory have it.
report::Chart thresholdChart(const SceneThresholds& thresholds, const std::vector<std::string>& notes);

}  // namespace taut::study
