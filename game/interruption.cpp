#include "game/interruption.h"

#include <cstdint>
#include <ctime>

#include "game/exit_code.h"

namespace taut::game {
namespace {

// A signal handler can reach static data only.
std::atomic<bool> asked{false};
volatile std::sig_atomic_t received = 0;
std::atomic<std::int64_t> receivedAt{0};
constexpr std::int64_t together = 1000;  // [ms]

// [ms] of a clock that only goes on.
std::int64_t now() {
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return std::int64_t{time.tv_sec} * 1000 + time.tv_nsec / 1000000;
}

// The first ends the run in order. One that follows at once belongs to it: timeout(1) sends its signal to the process
// and to its group, a terminal and a supervisor may both send theirs. One that comes later means it.
extern "C" void noteSignal(int signal) {
    if (asked) {
        if (now() - receivedAt <= together) return;
        ::signal(signal, SIG_DFL);
        ::raise(signal);
        return;
    }
    receivedAt = now();
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
    action.sa_flags = static_cast<int>(SA_RESTART);
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
