#include "game/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

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

std::string clockText(double seconds) {
    const long all = std::lround(seconds);
    if (all >= 3600) return fmt::format("{}:{:02}:{:02}", all / 3600, all / 60 % 60, all % 60);
    return fmt::format("{}:{:02}", all / 60, all % 60);
}

Progress::Progress(std::int64_t frames, double fps, double step, bool quiet)
    : frames_(frames), fps_(fps), step_(step), quiet_(quiet), live_(isLiveTerminal()), lastShown_(start_) {}

Progress::~Progress() {
    if (lineOpen_) fmt::print(stderr, "\n");
}

void Progress::frameDone(const pipeline::FrameRecord& record) {
    if (quiet_) return;
    const auto now = Clock::now();
    const bool last = record.frame + 1 == frames_;
    if (!last && now - lastShown_ < (live_ ? std::chrono::nanoseconds(liveInterval) : plainInterval)) return;
    lastShown_ = now;
    const std::string text = line(record, std::chrono::duration<double>(now - start_).count());
    if (live_) {
        fmt::print(stderr, "\r{}\x1b[K", cutToTerminal(text));
        std::fflush(stderr);
        lineOpen_ = true;
    } else {
        fmt::print(stderr, "{}\n", text);
    }
}

std::string Progress::line(const pipeline::FrameRecord& record, double elapsed) const {
    const auto done = static_cast<double>(record.frame + 1);
    const auto all = static_cast<double>(frames_);
    const double left = elapsed / done * (all - done);
    std::string text = fmt::format("frame {}/{}  {:3.0f} %  simulation {:.1f} ms", record.frame + 1, frames_,
                                   100.0 * done / all, 1e3 * record.simulating);
    if (record.pictured)
        text += fmt::format("  picture {:.0f} ms  file {:.0f} ms", 1e3 * record.drawing, 1e3 * record.encoding);
    text += fmt::format("  {:.2f} x real time  {} left  h {:.3g} ms", done / fps_ / std::max(elapsed, 1e-9),
                        clockText(left), 1e3 * step_);
    return text;
}

}  // namespace taut::game
