#include "game/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace taut::game {
std::string clockText(double seconds) {
    const long all = std::lround(seconds);
    if (all >= 3600) return fmt::format("{}:{:02}:{:02}", all / 3600, all / 60 % 60, all % 60);
    return fmt::format("{}:{:02}", all / 60, all % 60);
}

Progress::Progress(const ProgressFacts& facts, bool quiet) : facts_(facts), line_(quiet) {}

void Progress::frameDone(const pipeline::FrameRecord& record) {
    const auto now = Clock::now();
    const double left = secondsLeft(record, now);
    if (record.metrics && !facts_.firstEnergy) facts_.firstEnergy = record.metrics->energy();
    if (line_.isDue(record.frame + 1 == facts_.frames))
        line_.show(line(record, std::chrono::duration<double>(now - start_).count(), left));
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
std::string Progress::line(const pipeline::FrameRecord& record, double elapsed, double left) {
    const auto done = static_cast<double>(record.frame + 1);
    std::string text =
        fmt::format("frame {}/{} {:3.0f} %  {} left  simulation {:.1f}", record.frame + 1, facts_.frames,
                    100.0 * done / static_cast<double>(facts_.frames), clockText(left), 1e3 * record.simulating);
    if (record.pictured)
        text += fmt::format(" picture {:.0f} file {:.0f}", 1e3 * record.drawing, 1e3 * record.encoding);
    text += fmt::format(" ms  {:.2f} x real time  h {}", done / facts_.fps / std::max(elapsed, 1e-9),
                        pipeline::stepText(facts_.step));
    if (record.metrics) {
        const world::Metrics& m = *record.metrics;
        const double energy = m.energy();
        text += fmt::format("  strain {:.1f} %  energy {:.4g} J, drift {:+.2g} J", 100.0 * m.maxStrain, energy,
                            energy - facts_.firstEnergy.value_or(energy));
    }
    return text;
}

}  // namespace taut::game
