// Ctrl-C and the request to terminate, as a flag that long work looks at.
#pragma once

#include <atomic>
#include <csignal>
#include <optional>

#include "game/exit_code.h"
#include "taut/core/error.h"

namespace taut::game {

// While it lives, the first SIGINT or SIGTERM sets the flag, and one that comes more than a second later ends the
// program. One at a time.
class Interruption {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    const std::atomic<bool>& flag() const;

    // What the program is to end with: interrupted (130), terminated (143), or none.
    std::optional<ExitCode> exitCode() const;

  private:
    struct sigaction beforeInterrupt_ = {};
    struct sigaction beforeTerminate_ = {};
};

}  // namespace taut::game
