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

Progress::Progress(const ProgressFacts& facts, bool quiet) : facts_(facts), quiet_(quiet), live_(isLiveTerminal()) {}

Progress::~Progress() {
    if (lineOpen_) fmt::print(stderr, "\n");
}

void Progress::frameDone(const pipeline::FrameRecord& record) {
    if (quiet_) return;
    const auto now = Clock::now();
    const double left = secondsLeft(record, now);
    const bool last = record.frame + 1 == facts_.frames;
    if (!last && now - lastShown_ < (live_ ? std::chrono::nanoseconds(liveInterval) : plainInterval)) return;
    lastShown_ = now;
    const std::string text = line(record, std::chrono::duration<double>(now - start_).count(), left);
    if (live_) {
        fmt::print(stderr, "\r{}\x1b[K", cutToTerminal(text));
        std::fflush(stderr);
        lineOpen_ = true;
    } else {
        fmt::print(stderr, "{}\n", text);
    }
}

double Progress::secondsLeft(const pipeline::FrameRecord& record, Clock::time_point now) {
    if (record.pictured && !pictured_) {
        pictured_ = true;
        paceStart_ = now - std::chrono::duration_cast<Clock::duration>(
                               std::chrono::duration<double>(record.simulating + record.drawing + record.encoding));
        paceFrame_ = record.frame - 1;
    }
    const double spent = std::chrono::duration<double>(now - paceStart_).count();
    return spent / static_cast<double>(record.frame - paceFrame_) *
           static_cast<double>(facts_.frames - 1 - record.frame);
}

// The most wanted first: a narrow terminal cuts the rest.
std::string Progress::line(const pipeline::FrameRecord& record, double elapsed, double left) const {
    const auto done = static_cast<double>(record.frame + 1);
    std::string text =
        fmt::format("frame {}/{} {:3.0f} %  {} left  simulation {:.1f}", record.frame + 1, facts_.frames,
                    100.0 * done / static_cast<double>(facts_.frames), clockText(left), 1e3 * record.simulating);
    if (record.pictured)
        text += fmt::format(" picture {:.0f} file {:.0f}", 1e3 * record.drawing, 1e3 * record.encoding);
    text += fmt::format(" ms  {:.2f} x real time  h {:.3g} of {:.3g} ms", done / facts_.fps / std::max(elapsed, 1e-9),
                        1e3 * facts_.step, 1e3 * facts_.stepLimit);
    if (record.metrics) {
        const world::Metrics& m = *record.metrics;
        text += fmt::format("  strain {:.1f} %  energy {:.4g} J", 100.0 * m.maxStrain,
                            m.kinetic + m.elastic + m.gravitational);
    }
    return text;
}

}  // namespace taut::game
