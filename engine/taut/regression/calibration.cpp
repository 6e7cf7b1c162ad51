#include "taut/regression/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "taut/core/error.h"
#include "taut/image/read.h"
#include "taut/pipeline/run_parts.h"
#include "taut/regression/judging.h"
#include "taut/regression/mutants.h"
#include "taut/regression/playing.h"
#include "taut/regression/tape_compare.h"
#include "taut/world/world.h"

namespace taut::regression {
namespace {

using report::CalibrationRow;

render::Backend otherThan(render::Backend backend) {
    return backend == render::Backend::osmesa ? render::Backend::egl : render::Backend::osmesa;
}

// The software renderer compiles for the processor that it finds, and reads only once which instructions it may use:
// older processors are seen in processes of their own.
const std::vector<Apart>& processesApart() {
    static const std::vector<Apart> all = {
        {"1 thread", 1, ""}, {"4 threads", 4, ""}, {"SSE2", 1, "sse2"}, {"SSE4.1", 1, "sse4.1"}, {"AVX", 1, "avx"},
    };
    return all;
}

class Calibration {
  public:
    Calibration(const CalibrationOptions& options, const std::atomic<bool>& stop)
        : options_(options), stop_(stop), drawer_(options.drawing) {
        DrawingOptions drawing = options.drawing;
        drawing.shadows = false;
        shadowless_.emplace(drawing);
        drawing.shadows = true;
        drawing.backends = {otherThan(options.drawing.backends.front())};
        drawing.device.reset();
        other_.emplace(drawing);
    }

    void run(const Scenario& scenario) {
        scenario_ = &scenario;
        right_ = playScenario(scenario, drawer_, {.endsWithLastGolden = true}, stop_);
        if (stop_) return;
        again();
        apart();
        otherBackend();
        for (const Mutant& mutant : mutants())
            if (!stop_) mutant.isOfState() ? ofState(mutant) : ofPicture(mutant);
    }

    std::vector<CalibrationRow> rows() { return std::move(rows_); }

  private:
    // A row about one picture; none for `now`: this picture cannot be had.
    CalibrationRow row(const PlayedPicture& right, const std::string& what, const image::Image* now) const {
        CalibrationRow row;
        row.scenario = scenario_->name;
        row.picture = right.request.key();
        row.what = what;
        row.hasPicture = now != nullptr && now->isWhole() && right.picture.isWhole();
        if (!row.hasPicture) return row;
        const image::Comparison comparison = image::compare(right.picture, *now, options_.tolerance);
        row.share = comparison.share;
        row.tileShare = comparison.worstTileShare;
        row.offset = comparison.offset;
        row.largest = comparison.largest;
        row.pictureDiffers = !comparison.within;
        return row;
    }

    void addNoise(CalibrationRow row) {
        const image::Tolerance& tolerance = options_.tolerance;
        if (row.hasPicture &&
            (noiseMargin * row.share > tolerance.share || noiseMargin * row.tileShare > tolerance.tileShare ||
             noiseMargin * std::abs(row.offset) > tolerance.offset))
            row.refusal = fmt::format(
                "the thresholds ({}) are less than {} times this noise ({:.4f} % of the pixels, {:.1f} % of a tile, "
                "{:.4f} of the mean): a picture of the same state {}",
                thresholds(), noiseMargin, 100.0 * row.share, 100.0 * row.tileShare, row.offset,
                row.pictureDiffers ? "fails" : "might fail elsewhere");
        if (row.hasState && row.stateDiffers)
            row.refusal = "the state differs between runs: its goldens cannot be calibrated";
        rows_.push_back(std::move(row));
    }

    // In this process, with renderers of its own.
    void again() {
        Drawer drawer(options_.drawing);
        const Played played = playScenario(*scenario_, drawer, {.threads = 1, .endsWithLastGolden = true}, stop_);
        if (stop_) return;
        const bool differs = firstDifference(right_.tape, played.tape).has_value();
        for (std::size_t i = 0; i < std::min(right_.pictures.size(), played.pictures.size()); ++i) {
            CalibrationRow noise = row(right_.pictures[i], "again", &played.pictures[i].picture);
            noise.stateDiffers = differs;
            addNoise(noise);
        }
    }

    void apart() {
        if (!options_.drawApart) return;
        for (const Apart& process : processesApart())
            for (const PlayedPicture& picture : right_.pictures) {
                const std::filesystem::path file =
                    options_.scratch / fmt::format("{}-{}.png", scenario_->name, picture.request.key());
                const std::string hash = options_.drawApart(*scenario_, picture.request, process, file);
                if (stop_) return;
                const image::Image now =
                    image::readImage(file, std::int64_t{picture.picture.width} * picture.picture.height);
                CalibrationRow noise = row(picture, process.name, &now);
                noise.stateDiffers = hash != pipeline::hexadecimal(picture.stateHash);
                addNoise(noise);
            }
    }

    void otherBackend() {
        for (const PlayedPicture& picture : right_.pictures) {
            std::optional<image::Image> now;
            try {
                now = other_->draw(picture.view, scenario_->spec.picture, picture.request.size);
            } catch (const core::Error& error) {
                if (error.kind() != core::ErrorKind::noRenderer) throw;
            }
            CalibrationRow noise =
                row(picture, now ? "the other GL backend" : "the other GL backend: not here", now ? &*now : nullptr);
            noise.hasState = false;
            addNoise(noise);
        }
    }

    void ofState(const Mutant& mutant) {
        const world::World world(scenario_->spec);
        const auto spec = mutant.ofScene(scenario_->spec, world.islands());
        if (!spec) return;
        Scenario wrong = *scenario_;
        wrong.spec = *spec;
        const Played played = playScenario(wrong, drawer_, {.endsWithLastGolden = true}, stop_);
        if (stop_) return;
        const bool differs = played.divergence || firstDifference(right_.tape, played.tape);
        for (std::size_t i = 0; i < right_.pictures.size(); ++i) {
            const bool isDrawn = i < played.pictures.size();
            CalibrationRow found =
                row(right_.pictures[i], mutant.name, isDrawn ? &played.pictures[i].picture : nullptr);
            found.isMutant = true;
            found.meantFor = "state";
            found.stateDiffers = differs;
            if (!differs) found.refusal = "the chain of state hashes does not notice it";
            rows_.push_back(std::move(found));
        }
    }

    void ofPicture(const Mutant& mutant) {
        Drawer& drawer = mutant.withoutShadows ? *shadowless_ : drawer_;
        for (const PlayedPicture& picture : right_.pictures) {
            view::FrameView view = picture.view;
            if (mutant.ofView) mutant.ofView(view, picture.request.size);
            const image::Image now = drawer.draw(view, scenario_->spec.picture, picture.request.size);
            CalibrationRow found = row(picture, mutant.name, &now);
            found.isMutant = true;
            found.hasState = false;
            found.meantFor = "picture";
            if (found.largest == 0)
                found.what += " (nothing of it to be seen)";
            else if (!found.pictureDiffers)
                found.refusal = fmt::format(
                    "the thresholds ({}) let this through: {:.4f} % of the pixels differ, {:.1f} % of a tile, the "
                    "mean by {:.4f}; thresholds below that find it",
                    thresholds(), 100.0 * found.share, 100.0 * found.tileShare, found.offset);
            rows_.push_back(std::move(found));
        }
    }

    std::string thresholds() const {
        const image::Tolerance& tolerance = options_.tolerance;
        return fmt::format(
            "at most {:.4g} % of the pixels off by more than {}, of a tile {:.3g} % by more than {}, the mean by "
            "{:.4g}",
            100.0 * tolerance.share, tolerance.channel, 100.0 * tolerance.tileShare, tolerance.tileChannel,
            tolerance.offset);
    }

    const CalibrationOptions& options_;
    const std::atomic<bool>& stop_;
    Drawer drawer_;
    std::optional<Drawer> shadowless_, other_;
    const Scenario* scenario_ = nullptr;
    Played right_;
    std::vector<CalibrationRow> rows_;
};

}  // namespace

std::vector<CalibrationRow> calibrate(const std::vector<Scenario>& scenarios, const CalibrationOptions& options,
                                      const std::atomic<bool>& stop) {
    Calibration calibration(options, stop);
    for (std::size_t i = 0; i < scenarios.size() && !stop; ++i) {
        if (scenarios[i].goldens.empty()) continue;
        if (options.progress)
            options.progress(static_cast<double>(i) / static_cast<double>(scenarios.size()), scenarios[i].name);
        calibration.run(scenarios[i]);
    }
    return calibration.rows();
}

}  // namespace taut::regression
