// The length of a run, its picture rate, and the kept state with which it begins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "taut/spec/source.h"

namespace taut::world {

// The bytes of World::save() of an earlier run.
struct StartState {
    std::int64_t tick = 0;  // the run goes on from it
    std::vector<std::byte> bytes;
};

struct RunSpec {
    double fps = 60.0;                               // pictures a second of scene time
    double seconds = 5.0;                            // length
    std::string start{};                             // path of a kept state, resolved by the loader; empty: none
    std::shared_ptr<const StartState> startState{};  // content of the file; null: the initial state of the scene
    Source startSource{};
};

}  // namespace taut::world
