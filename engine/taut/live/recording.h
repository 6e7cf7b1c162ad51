// Writes the actions of the user since the start of a run as a scenario file that repeats them. Independent of the
// world and of files.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "taut/spec/kinds.h"
#include "taut/spec/run_spec.h"

namespace taut::live {

struct Recording {
    std::string scene;                   // that was played, as the file names it: a path beside it, or a shipped one
    std::vector<std::string> overrides;  // "solver.dt=1e-4": further overrides
    world::RunSpec run;
    double ticksPerSecond = 60.0;
    int ticksPerFrame = 1;
    std::int64_t endTick = 0;                                                // a frame's; every deed is earlier
    std::uint64_t hash = 0;                                                  // of the state then, chained over ticks
    world::Specs<world::ActionSpec> timeline;                                // the scene's own
    world::Specs<world::ActionSpec> deeds;                                   // of the hand, ascending
    std::shared_ptr<const world::KindTable<world::ActionSpec>> actionKinds;  // of the timeline; none: the engine's own
    bool hasClaims = false;  // the scene has checks or goldens of its own

    // The largest strain that was seen of each body.
    std::vector<std::pair<std::string, double>> strains;
};

// The file's text, TOML. A file cannot override an element of a list: such overrides become comments. Throws
// core::Error(badContent) for an action of a kind that is not in the table.
std::string scenarioText(const Recording& recording);

// An action as an element of `at`, at t [s]. 0, false and empty texts are left out if they are the default. Throws
// core::Error(badContent) for an action of a kind that is not in the table.
std::string actionText(const world::ActionSpec& action, double t, const world::KindTable<world::ActionSpec>& kinds);

// "solver.dt = 1e-4" for "solver.dt=1e-4", with quotes around a plain word. Empty for an element of a list and for a
// key with a *.
std::string overrideLine(const std::string& text);

}  // namespace taut::live
