// `taut chart refinement`: the study of ever finer bodies, as tables and pictures.
#pragma once

#include <filesystem>
#include <string>

#include "taut/study/refinement_text.h"

namespace taut::game {

inline constexpr const char* refinementName = "refinement";
inline constexpr const char* refinementAbout = "ropes, cloths and blocks at rest, at four resolutions, against theory";

// Prints the table and writes CSV, JSON and, if gnuplot runs, the pictures into the folder. `note` stands at the foot
// of the pictures. Returns the exit code. Throws core::Error(inputOutput) if gnuplot is missing, after writing the
// rest. `settings` select the study; it sets stop and progress in them.
int chartRefinement(const std::filesystem::path& folder, const study::MachineFacts& machine, const std::string& note,
                    bool isQuiet, study::RefinementSettings settings = {});

}  // namespace taut::game
