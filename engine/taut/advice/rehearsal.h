// Finds, before the first tick, errors that a run will meet later. Independent of files.
#pragma once

#include <string>
#include <vector>

#include "taut/core/finding.h"

namespace taut::world {

struct SceneSpec;

struct Rehearsal {
    std::vector<core::Finding> faults;    // they end the run
    std::vector<core::Finding> warnings;  // of the world at its start, and of actions that may end the run, depending
                                          // on the positions of bodies by then
    std::vector<std::string> advice;      // causes of short steps; the extent of the simulation
};

// Whether its bodies have too many points to build them only to look ahead: more than 100 000, which take some five
// seconds.
bool isTooLarge(const SceneSpec& scene);

// Performs the timeline on bodies in their initial places. This finds targets that cannot be held, cut or pushed. If
// the verdict depends on the later place of a body, it simulates up to there if that is cheap. It also simulates the
// first second, to find bodies that leave the picture, and energy that comes from nowhere. Everything takes at most two
// seconds of processor time; if building the world takes longer, nothing is simulated. Steps that will diverge are
// errors too. Throws core::Error if the scene cannot be built.
Rehearsal rehearse(const SceneSpec& scene);

}  // namespace taut::world
