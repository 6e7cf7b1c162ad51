#include "taut/study/reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/parallel.h"
#include "taut/ode/method_table.h"
#include "taut/study/errors.h"

namespace taut::study {
namespace {

constexpr double selfCheck = 100;  // a charted error is to be so many times larger than the reference's own
// RK4 errs by (ωh)⁴/120 a radian: at limit/2048, ωh = 1.4e-3, below the rounding of double.
constexpr int finest = 2048;

std::vector<Observation> play(const Subject& subject, const RunPlan& plan) {
    const std::unique_ptr<Trial> trial = subject.begin(plan);
    std::vector<Observation> seen;
    for (int i = 0; i < plan.grid.samples; ++i) {
        if (!trial->advance())
            throw core::Error(core::ErrorKind::diverged,
                              subject.name() + ": even the reference, RK4 with a step far below its limit, diverged");
        seen.push_back(trial->observe());
    }
    return seen;
}

double secondsOf(const Subject& subject, RunPlan plan) {
    plan.grid.samples = std::max(1, plan.grid.samples / 10);
    const std::unique_ptr<Trial> trial = subject.begin(plan);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < plan.grid.samples; ++i)
        if (!trial->advance()) break;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * 10;
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

}  // namespace

Reference makeReference(const Subject& subject, const Grid& grid, int window, double seconds) {
    Reference reference;
    if (subject.exact(0.0)) {
        reference.isExact = true;
        for (int i = 1; i <= grid.samples; ++i) reference.at.push_back(*subject.exact(grid.spacing * i));
        measureScales(subject, reference);
        return reference;
    }
    RunPlan plan;
    plan.method = "rk4";
    plan.grid = grid;
    const double limit = std::min(subject.stepLimit(*ode::findMethod("rk4")), grid.spacing / 4);
    plan.stepsPerSample = stepsPerSample(subject, grid, limit / 4);
    const double once = secondsOf(subject, plan);
    for (int finer = 8; finer < finest && once * finer / 4 < seconds; finer *= 2) plan.stepsPerSample *= 2;
    RunPlan half = plan;
    half.stepsPerSample *= 2;
    std::vector<Observation> coarse;
    core::parallelFor(2, [&](int i) { (i == 0 ? reference.at : coarse) = play(subject, i == 0 ? half : plan); });
    reference.step = half.step();
    double square = 0;
    for (std::size_t i = 0; i < reference.at.size(); ++i) {
        reference.energyDifference =
            std::max(reference.energyDifference, std::abs(reference.at[i].energy - coarse[i].energy));
        if (i >= static_cast<std::size_t>(window)) continue;
        const double rms = rmsDifference(reference.at[i].values, coarse[i].values, subject.dimensions());
        square += rms * rms;
    }
    reference.difference = std::sqrt(square / window);
    reference.floor = selfCheck * reference.difference;
    reference.energyFloor = selfCheck * reference.energyDifference;
    measureScales(subject, reference);
    return reference;
}

}  // namespace taut::study
