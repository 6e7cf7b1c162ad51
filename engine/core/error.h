// What goes wrong for a reason the user can mend: an exception with a message and the exit code it leads to.
#pragma once

#include <stdexcept>
#include <string>

namespace taut::core {

// Exit codes of the program; every Error carries one.
enum class ExitCode : int {
    ok = 0,
    checkFailed = 1,
    usage = 2,
    badContent = 3,  // a file says something wrong, or asks for more than the machine has
    diverged = 4,
    needNotMet = 5,
    inputOutput = 6,  // a file is missing, unreadable, unwritable; the disk is full; a program did not run
    noRenderer = 7,
    goldenMissing = 8,
    interrupted = 130,
    terminated = 143,
};

class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

// Ends the program with a message: a programmer's mistake, never a user's.
[[noreturn]] void failCheck(const char* condition, const char* file, int line);

}  // namespace taut::core

// Checks what the caller promised; stays on in every build because it stands outside hot loops.
#define TAUT_EXPECTS(condition) ((condition) ? void() : ::taut::core::failCheck(#condition, __FILE__, __LINE__))
