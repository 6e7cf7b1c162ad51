#include "game/live_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "game/messages.h"
#include "taut/core/private/utf8.h"

namespace taut::game {
namespace {

constexpr std::chrono::milliseconds liveInterval(100);
constexpr std::chrono::seconds plainInterval(5);

bool isLiveTerminal() {
    const char* kind = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

// A line longer than the terminal would scroll instead of being overwritten.
std::string cutToTerminal(const std::string& text) {
    winsize window{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0) return text;
    return text.substr(0, window.ws_col - 1U);
}

}  // namespace

LiveLine::LiveLine(bool quiet) : quiet_(quiet), live_(isLiveTerminal()) {}

LiveLine::~LiveLine() {
    if (open_) printNote("\n");
}

bool LiveLine::isDue(bool last) {
    if (quiet_) return false;
    const auto now = std::chrono::steady_clock::now();
    if (!last && now - shown_ < (live_ ? std::chrono::nanoseconds(liveInterval) : plainInterval)) return false;
    shown_ = now;
    return true;
}

void LiveLine::show(const std::string& text) {
    if (live_) {
        writeNote("\r" + core::printable(cutToTerminal(text), true) + "\x1b[K");
        open_ = true;
    } else {
        printNote("{}\n", text);
    }
}

}  // namespace taut::game
