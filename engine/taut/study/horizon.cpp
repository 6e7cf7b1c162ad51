#include "taut/study/horizon.h"

#include <algorithm>
#include <cmath>

#include "taut/core/private/parallel.h"
#include "taut/ode/method_table.h"
#include "taut/study/errors.h"

namespace taut::study {
namespace {
constexpr double mostSteps = 1e7;
}

Horizon findHorizon(const Subject& subject, double duration, double shift) {
    RunPlan plan;
    plan.grid = subject.grid(duration, duration / 12);  // some 120 looks
    for (const char* method : {"rk4", "sdirk2"}) {
        plan.method = method;
        const double step = std::min(subject.stepLimit(*ode::findMethod(method)) / 4, duration / 500);
        if (duration / step > mostSteps) continue;
        plan.stepsPerSample = stepsPerSample(subject, plan.grid, step);
        break;
    }

    const std::unique_ptr<Trial> plain = subject.begin(plan);
    plan.perturbation = shift;
    const std::unique_ptr<Trial> moved = subject.begin(plan);
    Horizon horizon{plan.grid.duration(), false, 1.0};
    const double start = rmsDifference(plain->observe().values, moved->observe().values, subject.dimensions());
    if (!(start > 0)) return horizon;
    for (int sample = 1; sample <= plan.grid.samples; ++sample) {
        bool runs[2] = {true, true};
        core::parallelFor(2, [&](int i) { runs[i] = (i == 0 ? plain : moved)->advance(); });
        const double growth =
            runs[0] && runs[1]
                ? rmsDifference(plain->observe().values, moved->observe().values, subject.dimensions()) / start
                : HUGE_VAL;
        horizon.growth = std::isfinite(growth) ? std::max(horizon.growth, growth) : HUGE_VAL;
        if (growth < horizonGrowth) continue;  // written so that NaN ends it
        horizon.seconds = plan.grid.spacing * (sample - 1);
        horizon.isReached = true;
        break;
    }
    return horizon;
}

}  // namespace taut::study
