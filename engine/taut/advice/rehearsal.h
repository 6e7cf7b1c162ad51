// Finds before the first tick what a run will refuse later. It knows no files.
#pragma once

#include <string>
#include <vector>

#include "taut/core/finding.h"

namespace taut::world {

struct SceneSpec;

struct Rehearsal {
    std::vector<core::Finding> faults;    // they end the run
    std::vector<core::Finding> warnings;  // of the world at its start, and of what may end the run, depending on
                                          // where bodies are by then
    std::vector<std::string> advice;      // what would allow longer steps; how far the look ahead went
};

// Whether its bodies have too many points to build them only to look ahead: more than 100 000, which take some five
// seconds.
bool isTooLarge(const SceneSpec& scene);

// Performs the timeline on bodies that stay at their starting places. This shows what can be held, cut or pushed at
// all. Where the verdict depends on the later place of a body, it plays the scene up to there if that is cheap. It
// plays the first second too, to see what leaves the picture. All of it takes two seconds of processor time at most; if
// building the world takes longer, it plays nothing. Steps that will diverge are faults too. Throws core::Error if the
// scene cannot be built.
Rehearsal rehearse(const SceneSpec& scene);

}  // namespace taut::world
