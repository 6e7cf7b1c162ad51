#include "taut/study/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/core/private/stopwatch.h"
#include "taut/ode/method_table.h"
#include "taut/study/errors.h"
#include "taut/study/fehlberg78.h"

namespace taut::study {
namespace {

constexpr double selfCheck = 100;  // a charted error is to be so many times larger than the reference's own
// RK4 errs by (ωh)⁴/120 a radian: at limit/2048, ωh = 1.4e-3, below the rounding of double.
constexpr int finest = 2048;

// Two runs of one motion, the second one finer.
struct Pair {
    std::vector<Observation> coarse, fine;
};

bool hasTouched(const std::vector<Observation>& seen) {
    return std::ranges::any_of(seen, &Observation::hasTouched);
}

// Empty when it diverged.
std::vector<Observation> play(const Subject& subject, const RunPlan& plan) {
    const std::unique_ptr<Trial> trial = subject.begin(plan);
    std::vector<Observation> seen;
    for (int i = 0; i < plan.grid.samples; ++i) {
        if (!trial->advance()) return {};
        seen.push_back(trial->observe());
    }
    return seen;
}

Pair playBoth(const Subject& subject, const RunPlan& coarse, const RunPlan& fine) {
    Pair runs;
    core::parallelFor(2, [&](int i) { (i == 0 ? runs.fine : runs.coarse) = play(subject, i == 0 ? fine : coarse); });
    return runs;
}

double secondsOf(const Subject& subject, RunPlan plan) {
    plan.grid.samples = std::max(1, plan.grid.samples / 10);
    const std::unique_ptr<Trial> trial = subject.begin(plan);
    const core::Stopwatch watch;
    for (int i = 0; i < plan.grid.samples; ++i)
        if (!trial->advance()) break;
    return watch.seconds() * 10;
}

void measureScales(const Subject& subject, Reference& reference) {
    const auto d = static_cast<std::size_t>(subject.dimensions());
    std::vector<double> least(d, HUGE_VAL), most(d, -HUGE_VAL);
    for (const Observation& seen : reference.at) {
        for (std::size_t i = 0; i < seen.values.size(); ++i) {
            least[i % d] = std::min(least[i % d], seen.values[i]);
            most[i % d] = std::max(most[i % d], seen.values[i]);
        }
        if (std::isfinite(seen.kinetic)) reference.kinetic = std::max(reference.kinetic, seen.kinetic);
    }
    double square = 0;
    for (std::size_t p = 0; p < d; ++p) square += (most[p] - least[p]) * (most[p] - least[p]);
    reference.extent = std::sqrt(square);
}

Pair controlledRuns(const Subject& subject, const Grid& grid, double seconds, Reference& reference) {
    constexpr double usual = 1e-12, loose = 1e-9;  // [unit/s]
    RunPlan fine;
    fine.method = fehlberg78;
    fine.grid = grid;
    fine.stepsPerSample = subject.quantum(grid);
    fine.tolerance = usual;
    if (secondsOf(subject, fine) > seconds) fine.tolerance = loose;
    // Inner steps end where steps do: were those alike, the two runs could be the same, and tell nothing.
    RunPlan coarse = fine;
    coarse.tolerance *= 100;
    fine.stepsPerSample *= 2;
    reference.tolerance = fine.tolerance;
    return playBoth(subject, coarse, fine);
}

Pair steppedRuns(const Subject& subject, const Grid& grid, double seconds, Reference& reference) {
    RunPlan coarse;
    coarse.method = "rk4";
    coarse.grid = grid;
    const double limit = std::min(subject.stepLimit(*ode::findMethod("rk4")), grid.spacing / 4);
    coarse.stepsPerSample = stepsPerSample(subject, grid, limit / 4);
    const double once = secondsOf(subject, coarse);
    for (int finer = 8; finer < finest && once * finer / 4 < seconds; finer *= 2) coarse.stepsPerSample *= 2;
    RunPlan fine = coarse;
    fine.stepsPerSample *= 2;
    reference.step = fine.step();
    Pair runs = playBoth(subject, coarse, fine);
    if (runs.fine.empty() || runs.coarse.empty())
        throw core::Error(core::ErrorKind::diverged,
                          subject.name() + ": even the reference, RK4 with a step far below its limit, diverged");
    return runs;
}

}  // namespace

std::string methodOf(const Reference& reference, const std::string& unit) {
    if (reference.isExact) return "exact";
    if (!reference.isControlled)
        return fmt::format("RK4 at steps of {:.3g} and {:.3g} s", 2 * reference.step, reference.step);
    return fmt::format("Fehlberg 7(8) at tolerances of {:.3g} and {:.3g} {}/s", 100 * reference.tolerance,
                       reference.tolerance, unit);
}

Reference makeReference(const Subject& subject, const Grid& grid, int window, double seconds) {
    Reference reference;
    if (subject.exact(0.0)) {
        reference.isExact = true;
        for (int i = 1; i <= grid.samples; ++i) reference.at.push_back(*subject.exact(grid.spacing * i));
        measureScales(subject, reference);
        return reference;
    }
    Pair runs = controlledRuns(subject, grid, seconds, reference);
    reference.isControlled = !runs.fine.empty() && !runs.coarse.empty() && !hasTouched(runs.coarse);
    if (!reference.isControlled) runs = steppedRuns(subject, grid, seconds, reference);
    double square = 0;
    for (std::size_t i = 0; i < runs.fine.size(); ++i) {
        reference.energyDifference =
            std::max(reference.energyDifference, std::abs(runs.fine[i].energy - runs.coarse[i].energy));
        if (i >= static_cast<std::size_t>(window)) continue;
        const double rms = rmsDifference(runs.fine[i].values, runs.coarse[i].values, subject.dimensions());
        square += rms * rms;
    }
    const double share = reference.isControlled ? 0.1 : 1.0;
    reference.difference = std::sqrt(square / window);
    reference.error = share * reference.difference;
    reference.floor = selfCheck * reference.error;
    reference.energyFloor = selfCheck * share * reference.energyDifference;
    reference.at = std::move(runs.fine);
    measureScales(subject, reference);
    return reference;
}

}  // namespace taut::study
