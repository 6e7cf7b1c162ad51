// A scene played in every way that may not matter. It knows no fuzzer.
#pragma once

#include <cstdint>
#include <string>

#include "taut/spec/spec.h"

namespace taut::fuzz {

struct PlayedScene {
    std::string fault;       // the difference, or the value that is not a number; empty: nothing
    bool wasPlayed = false;  // false: it was refused, or would have taken too long
    double gain = 0;         // of energy: support::Played::gain
};

// With one, two and seven threads and every instruction set; asked everything between the ticks; saved and restored
// before each. Throws core::Error where no world can be made of it.
PlayedScene playedScene(const world::SceneSpec& spec, std::int64_t ticks);

}  // namespace taut::fuzz
