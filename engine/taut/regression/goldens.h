// Changes goldens: the results of a scenario become its goldens, with the reason. It judges nothing.
#pragma once

#include <string>
#include <vector>

#include "taut/regression/manifest.h"
#include "taut/regression/playing.h"
#include "taut/regression/scenario.h"

namespace taut::regression {

// Writes the chain and the pictures of the scenario that are missing or differ from their goldens, drops the ones that
// it no longer needs, and gives each change the reason; equal files stay the same to the last byte, except for the
// number of bits. Returns a line for each change. Throws core::Error(inputOutput). Expects a scenario that was played
// to its end with saved states.
std::vector<std::string> updateGoldens(const Scenario& scenario, const Played& played, const GoldenFolder& folder,
                                       Manifest& manifest, const std::string& why);

// The state that a restart picture is drawn from; none when there is none. Throws core::Error(badContent, inputOutput).
std::optional<std::vector<std::byte>> storedState(const GoldenFolder& folder, const std::string& scenario,
                                                  const std::string& key);

}  // namespace taut::regression
