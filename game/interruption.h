// Ctrl-C and the request to terminate, as a flag that long work checks.
#pragma once

#include <atomic>
#include <csignal>
#include <optional>

#include "game/exit_code.h"
#include "taut/core/error.h"

namespace taut::game {

// While it lives, the first SIGINT or SIGTERM sets the flag. A further one more than a second later ends the program.
// Only one may live at a time.
class Interruption {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    const std::atomic<bool>& flag() const;

    // The program's exit code: interrupted (130), terminated (143), or none.
    std::optional<ExitCode> exitCode() const;

  private:
    struct sigaction beforeInterrupt_ = {};
    struct sigaction beforeTerminate_ = {};
};

}  // namespace taut::game
