// A piece of work for each instruction set, to be timed.
#pragma once

namespace taut::core {

// x and f are three planes of trialPoints + trialReach numbers; each point pulls at trialOffsets others.
inline constexpr int trialPoints = 512, trialReach = 64, trialOffsets = 4;

}  // namespace taut::core
