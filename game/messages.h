// Errors and warnings on standard error. It knows no command.
#pragma once

#include <string>
#include <vector>

#include "taut/core/error.h"

namespace taut::game {

// Faults of a file come as FILE:LINE:COLUMN, which editors understand at the start of a line only; others are preceded
// by the name of the program.
void printError(const core::Error& error);
void printWarnings(const std::vector<std::string>& warnings);

}  // namespace taut::game
