#include "game/interruption.h"
#include "game/exit_code.h"

namespace taut::game {
namespace {

// A signal handler reaches nothing but what is static.
std::atomic<bool> asked{false};
volatile std::sig_atomic_t received = 0;

extern "C" void noteSignal(int signal) {
    received = signal;
    asked = true;
}

}  // namespace

Interruption::Interruption() {
    static_assert(std::atomic<bool>::is_always_lock_free);
    asked = false;
    received = 0;
    struct sigaction action = {};
    action.sa_handler = noteSignal;
    action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    ::sigaction(SIGINT, &action, &beforeInterrupt_);
    ::sigaction(SIGTERM, &action, &beforeTerminate_);
}

Interruption::~Interruption() {
    ::sigaction(SIGINT, &beforeInterrupt_, nullptr);
    ::sigaction(SIGTERM, &beforeTerminate_, nullptr);
}

const std::atomic<bool>& Interruption::flag() const {
    return asked;
}

std::optional<ExitCode> Interruption::exitCode() const {
    if (received == SIGINT) return ExitCode::interrupted;
    if (received == SIGTERM) return ExitCode::terminated;
    return std::nullopt;
}

}  // namespace taut::game
