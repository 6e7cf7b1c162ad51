// Finds the first tick, body and point in which two tapes differ. It knows neither how they came about nor where they
// are kept.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "taut/regression/tape.h"

namespace taut::regression {

enum class TapeFault {
    rates,  // the ticks are not of the same length: nothing can be compared
    cast,   // other bodies are there
    state,  // the state differs
    chain,  // every body agrees and the chain does not: its seed or its order differs
    length  // the shorter one agrees as far as it goes
};

struct TapeDifference {
    TapeFault fault = TapeFault::state;
    std::int64_t tick = 0;
    double time = 0;         // [s]
    std::int64_t frame = 0;  // the first picture that can show it
    std::string body;        // the first of them, "cloth.flag"; with `cast` the one that only one tape has
    int bodies = 0;          // how many differ at that tick
    int point = -1;          // the first of that body, in the order of authoring; -1: not recorded in both
    int points = 0;          // how many of its points differ at that tick
};

// None when they agree in all that both of them hold, to the same last tick.
std::optional<TapeDifference> firstDifference(const Tape& a, const Tape& b);

// "tick 313 (5.217 s, frame 313): cloth.flag differs first, from point 17 on (12 of its points differ)".
std::string describe(const TapeDifference& difference);

}  // namespace taut::regression
