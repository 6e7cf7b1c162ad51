// Exit codes of the program.
#pragma once

#include <stdexcept>
#include <string>

#include "taut/core/error.h"

namespace taut::game {

enum class ExitCode : int {
    ok = 0,
    checkFailed = 1,
    usage = 2,
    badContent = 3,
    diverged = 4,
    needNotMet = 5,
    inputOutput = 6,
    noRenderer = 7,
    noMemory = 7,
    goldenMissing = 8,  // or recorded by other bits
    interrupted = 130,
    terminated = 143,
};

constexpr ExitCode exitCodeOf(core::ErrorKind kind) {
    switch (kind) {
        case core::ErrorKind::usage: return ExitCode::usage;
        case core::ErrorKind::badContent: return ExitCode::badContent;
        case core::ErrorKind::diverged: return ExitCode::diverged;
        case core::ErrorKind::inputOutput: return ExitCode::inputOutput;
        case core::ErrorKind::noRenderer: return ExitCode::noRenderer;
        case core::ErrorKind::interrupted: return ExitCode::interrupted;
    }
    return ExitCode::usage;
}

// A run whose checks failed; its message says which.
struct CheckFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace taut::game
