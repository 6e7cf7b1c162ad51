#include "taut/study/threshold.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "taut/core/private/contains.h"
#include "taut/core/private/parallel.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"
#include "taut/study/one_method.h"
#include "taut/study/subject.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

constexpr double longestRun = 0.5;              // [s] of motion in each run unless asked for more
constexpr double mostStep = 1.0 / 60;           // [s] no tick is longer
constexpr double stir = 1e-9;                   // [m]
constexpr double apart = 1.01;                  // at which bisection ends
constexpr double leastShareOfLimit = 1.0 / 32;  // of leap-frog's limit: the shortest step tried, or
constexpr double belowTheory = 0.5;             // of the predicted limit where that is less, but
constexpr double mostRunSteps = 1e6;            // in a run, however short that limit
constexpr double beyondTheory = 1.05;           // of the predicted limit: beyond it a run that stands only fails later
constexpr int lookEvery = 16;                   // steps between looks at the energy
constexpr int patience = 1000;                  // steps for which a failed run is followed, to find the cause
constexpr double slowSpeed = 0.1;               // [m/s] up to which everything may always move

// The scene with one step a tick of exactly h, or, with h = 0, with the steps that it would choose.
world::SceneSpec inSteps(const world::SceneSpec& spec, std::string_view method, double h) {
    world::SceneSpec scene = byMethod(spec, method, world::Precision::double_, stir);
    scene.solver.safety = 0.3;
    if (h > 0) {
        scene.solver.dt = atMost(h);
        scene.run.fps = 1 / h;
    }
    return scene;
}

double smaller(double a, double b) {
    return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::quiet_NaN() : std::min(a, b);
}

class ThresholdSearch {
  public:
    ThresholdSearch(const world::SceneSpec& spec, const ThresholdSettings& settings, SceneThresholds& result)
        : spec_(spec), settings_(settings), result_(result) {}

    void run() {
        settings_.listener.report(0.0, "the reference run");
        lookAtIslands();
        playReference();
        for (const ode::MethodInfo& method : chosenMethods(settings_.methods)) {
            MethodThreshold threshold;
            threshold.method = method.name;
            threshold.title = method.title;
            threshold.predicted = predictedFor(method);
            result_.methods.push_back(std::move(threshold));
        }
        parts_.assign(result_.methods.size(), 0.0);
        core::parallelFor(static_cast<int>(result_.methods.size()), [&](int i) { find(static_cast<std::size_t>(i)); });
        for (MethodThreshold& threshold : result_.methods) threshold.note = noteOn(threshold);
        result_.isInterrupted = isStopped();
    }

  private:
    bool isStopped() const { return settings_.listener.isStopped(); }

    void lookAtIslands() {
        const world::World world(inSteps(spec_, "leapfrog", mostStep));
        for (const world::IslandInfo& info : world.islands()) {
            IslandFrequencies island;
            island.name = info.name;
            island.bodies = info.bodies;
            island.points = info.points;
            island.boundAnywhere = info.omegaBound;
            island.boundHere = info.omegaNow;
            island.lanczos = info.omegaEstimate;
            island.mode = info.fastest;
            island.closedForm = closedFormFrequency(spec_, info.bodies, island.formula);
            result_.islands.push_back(std::move(island));
        }
    }

    void playReference() {
        world::World world(inSteps(spec_, "rk4", 0.0), {.keepsSteps = true});
        const auto ticks = static_cast<long long>(std::ceil(result_.seconds / world.tickSeconds()));
        double mass = 0;
        for (const world::IslandInfo& info : world.islands()) mass += info.mass;
        for (long long tick = 0; tick < ticks && !isStopped(); ++tick) {
            if (world.advance()) break;
            result_.kinetic = std::max(result_.kinetic, world.metrics(world::Measures::butCrossings).kinetic);
        }
        result_.allowance = 4 * result_.kinetic + 0.5 * mass * slowSpeed * slowSpeed;
        result_.criterion = fmt::format(
            "a step stands when within {:.3g} s no point is faster than 3000 m/s and the kinetic energy stays below "
            "{:.3g} J, four times the most of a run of RK4 at a fraction of its limit, and {} m/s for all points",
            result_.seconds, result_.allowance, slowSpeed);
    }

    PredictedSteps predictedFor(const ode::MethodInfo& method) const {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        PredictedSteps steps{infinite, infinite, infinite, infinite};
        for (const IslandFrequencies& island : result_.islands) {
            const auto by = [&](double omega) {
                if (std::isnan(omega)) return omega;
                ode::FastestMode mode = island.mode;
                mode.omega = omega;
                return method.largestStep(mode);
            };
            steps.boundAnywhere = std::min(steps.boundAnywhere, by(island.boundAnywhere));
            steps.boundHere = std::min(steps.boundHere, by(island.boundHere));
            steps.lanczos = std::min(steps.lanczos, by(island.lanczos));
            steps.closedForm = smaller(steps.closedForm, by(island.closedForm));
        }
        return steps;
    }

    // Empty if the step stands, else the first failure.
    std::string failure(MethodThreshold& threshold, double h) const {
        ++threshold.runs;
        world::World world(inSteps(spec_, threshold.method, h));
        const auto steps = static_cast<long long>(std::ceil(result_.seconds / h));
        for (long long n = 1; n <= steps; ++n) {
            if (const auto divergence = world.advance()) return divergence->body;
            if (n % lookEvery != 0 && n != steps) continue;
            if (!(world.metrics(world::Measures::butCrossings).kinetic <= result_.allowance)) return firstToGo(world);
            if (isStopped()) break;
        }
        return "";
    }

    // Which island has too much energy: the only one, or the one with the body whose points leave all bounds.
    std::string firstToGo(world::World& world) const {
        if (result_.islands.size() == 1) return result_.islands.front().name;
        for (int n = 0; n < patience; ++n)
            if (const auto divergence = world.advance()) return divergence->body;
        return "energy";
    }

    void find(std::size_t index) {
        MethodThreshold& threshold = result_.methods[index];
        const double leapfrog = predictedFor(*ode::findMethod("leapfrog")).lanczos;
        const double base = std::min(std::isfinite(leapfrog) ? leapfrog : mostStep, mostStep);
        const double predicted = threshold.predicted.lanczos;
        double least = leastShareOfLimit * base;
        if (predicted > 0) least = std::min(least, std::max(belowTheory * predicted, result_.seconds / mostRunSteps));
        double h = predicted;
        if (!(h > least) || !std::isfinite(h)) h = base;
        h = std::min(h, mostStep);
        const auto stands = [&] {
            const std::string first = failure(threshold, h);
            (first.empty() ? threshold.stands : threshold.fails) = h;
            if (!first.empty()) threshold.limitedBy = first;
            return first.empty();
        };
        // Away from the prediction until one step stands and one fails.
        if (stands()) {
            while (threshold.fails == 0 && h < mostStep && !isStopped()) {
                h = std::min(1.3 * h, mostStep);
                stands();
            }
        } else {
            while (threshold.stands == 0 && h > least && !isStopped()) {
                h = std::max(h / 1.5, least);
                stands();
            }
        }
        tellPart(index, 0.5);
        threshold.kind = threshold.fails == 0    ? ThresholdKind::aboveMost
                         : threshold.stands == 0 ? ThresholdKind::belowLeast
                                                 : ThresholdKind::found;
        while (threshold.kind == ThresholdKind::found && threshold.fails > apart * threshold.stands && !isStopped()) {
            h = std::sqrt(threshold.stands * threshold.fails);
            stands();
        }
        tellPart(index, 1.0);
    }

    std::string noteOn(const MethodThreshold& threshold) const {
        const ode::MethodInfo& method = *ode::findMethod(threshold.method);
        std::string note;
        if (threshold.kind == ThresholdKind::aboveMost)
            note = fmt::format("stands {:.4g} ms, the longest tick of a scene; where it fails beyond is not tried",
                               1e3 * mostStep);
        else if (threshold.kind == ThresholdKind::belowLeast)
            note = fmt::format("fails at {:.3g} ms already, the shortest step tried", 1e3 * threshold.fails);
        const double predicted = threshold.predicted.lanczos;
        std::string because(method.caution);
        const auto add = [](std::string& text, const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
        if (predicted == 0)
            because =
                "has no threshold: motion that nothing damps grows at every step, the more slowly the shorter it is";
        else if (threshold.stands > beyondTheory * predicted)
            add(because,
                fmt::format("theory allows {:.4g} ms as the scene starts; beyond, growth is slow or comes late",
                            1e3 * predicted));
        if (!because.empty()) add(because, fmt::format("the measurement holds for {:.3g} s", result_.seconds));
        if (!because.empty()) add(note, because);
        return note;
    }

    void tellPart(std::size_t index, double part) {
        const std::lock_guard lock(mutex_);
        parts_[index] = part;
        double sum = 0;
        for (double p : parts_) sum += p;
        settings_.listener.report(sum / static_cast<double>(parts_.size()), result_.methods[index].title);
    }

    const world::SceneSpec& spec_;
    const ThresholdSettings& settings_;
    SceneThresholds& result_;
    std::mutex mutex_;
    std::vector<double> parts_;  // (methods) share done of each
};

}  // namespace

SceneThresholds findThresholds(const world::SceneSpec& spec, const std::string& name,
                               const ThresholdSettings& settings) {
    SceneThresholds result;
    result.name = name;
    result.title = spec.title.empty() ? name : spec.title;
    result.seconds = settings.seconds > 0 ? settings.seconds : std::min(spec.run.seconds, longestRun);
    result.mostStep = mostStep;
    ThresholdSearch(spec, settings, result).run();
    return result;
}

}  // namespace taut::study
