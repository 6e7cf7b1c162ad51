// The report of an island: energies, frequencies, warnings, and why it stopped. It changes nothing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "taut/island/private/island.h"

namespace taut::world {

// Adds the share of the bodies that `wanted` names, at the time of the tick, velocities synchronised.
void addMetrics(Island& island, const TickTime& time, const std::function<bool(const Body&)>& wanted, Metrics& metrics);

IslandInfo infoOf(const Island& island, const TickTime& time);

// Warnings before the first tick, and of later changes (a working stretch exceeded).
std::vector<std::string> warningsOf(const Island& island);

// Expects that the island is in its last good state.
Divergence diagnose(const Island& island, const Fault& fault, const TickTime& time);

}  // namespace taut::world
