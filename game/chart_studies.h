// `taut chart refinement` and `taut chart contact`: studies that compare no methods, as tables and pictures.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "taut/study/contact_study_text.h"
#include "taut/study/refinement_text.h"

namespace taut::game {

// Prints the table and writes CSV and, if gnuplot runs, the pictures into the folder. `note` stands at the foot
// of the pictures. Returns the exit code. Throws core::Error(inputOutput) if gnuplot is missing, after writing the
// rest. `settings` select the study; stop and progress are set in them.
int chartRefinement(const std::filesystem::path& folder, const std::string& note, bool isQuiet,
                    study::RefinementSettings settings = {});
int chartContact(const std::filesystem::path& folder, const std::string& note, bool isQuiet,
                 study::ContactSettings settings = {});

struct ChartStudy {
    const char* name;
    const char* draws;     // "error against resolution"
    const char* about;     // its problems
    const char* compares;  // "bodies at rest"
    int (*chart)(const std::filesystem::path& folder, const std::string& note, bool isQuiet);
};
std::span<const ChartStudy> chartStudies();

}  // namespace taut::game
