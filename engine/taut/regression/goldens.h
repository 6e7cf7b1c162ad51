// Changes goldens: what a scenario did becomes what it has to do, with the reason. It judges nothing.
#pragma once

#include <string>
#include <vector>

#include "taut/regression/manifest.h"
#include "taut/regression/playing.h"
#include "taut/regression/scenario.h"

namespace taut::regression {

// Writes the chain and the pictures of the scenario that are missing or differ from their goldens, drops those that it
// asks for no more, and gives each that changes the reason; what agrees stays as it is, to the last byte but for the
// number of bits. Returns a line for each change. Throws core::Error(inputOutput). Expects a scenario that was played
// to its end with saved states.
std::vector<std::string> updateGoldens(const Scenario& scenario, const Played& played, const GoldenFolder& folder,
                                       Manifest& manifest, const std::string& why);

// The state that a restart picture is drawn from; none when there is none. Throws core::Error(badContent, inputOutput).
std::optional<std::vector<std::byte>> storedState(const GoldenFolder& folder, const std::string& scenario,
                                                  const std::string& key);

}  // namespace taut::regression
