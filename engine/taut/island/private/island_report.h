// What is told of an island: energies, frequencies, warnings, and why it stopped. It changes nothing.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "taut/island/private/island.h"

namespace taut::world {

// Adds the share, at the time of the tick, of the bodies of the island that `wanted` names; velocities synchronised.
void addMetrics(Island& island, const TickTime& time, const std::function<bool(const Body&)>& wanted, Metrics& metrics);

IslandInfo infoOf(const Island& island, const TickTime& time);

// What to say before the first tick, and what has changed since (a working stretch left).
std::vector<std::string> warningsOf(const Island& island);

// Expects that the state is the last good one.
Divergence diagnose(const Island& island, const Fault& fault, const TickTime& time);

}  // namespace taut::world
