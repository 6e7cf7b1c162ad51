// The source text of a scenario, kept beside its goldens so that a failure can show its changes.
#pragma once

#include <string>
#include <vector>

#include "taut/core/private/file_batch.h"
#include "taut/regression/manifest.h"
#include "taut/regression/scenario.h"
#include "taut/report/text_changes.h"

namespace taut::regression {

// The scenario's file and the one that it builds on, as they are now. Throws core::Error(inputOutput).
std::string scenarioText(const Scenario& scenario);

// Its changes since its goldens were accepted; empty if there are none, or their text was not kept.
std::vector<report::TextChange> changedText(const Scenario& scenario, const GoldenFolder& folder);

// Keeps the text; true if another one was kept or none.
bool keepText(const Scenario& scenario, const GoldenFolder& folder, core::FileBatch& files);

}  // namespace taut::regression
