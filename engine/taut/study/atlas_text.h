// The atlas as text: CSV and JSON for programs, tables for people.
#pragma once

#include <string>
#include <vector>

#include "taut/study/phase_plane.h"
#include "taut/study/stability_map.h"
#include "taut/study/threshold.h"
#include "taut/study/work_precision_text.h"

namespace taut::study {

// A row a damping ratio of each method and kind of damping: the boundary predicted and measured.
std::string boundariesCsv(const StabilityMap& map);
// A row a point of the maps.
std::string growthCsv(const StabilityMap& map);
// A line a method and kind of damping: limits at some ζ, and the largest gap.
std::string stabilitySummary(const StabilityMap& map);

// A row a step of each method.
std::string phasePlaneCsv(const std::vector<PhasePath>& paths);

std::string thresholdsCsv(const SceneThresholds& thresholds);
std::string thresholdsJson(const SceneThresholds& thresholds, const MachineFacts& machine);
// Frequencies of the islands, a line a method, and the notes on them.
std::string thresholdsSummary(const SceneThresholds& thresholds);

}  // namespace taut::study
