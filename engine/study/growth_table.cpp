#include "taut/study/growth_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "taut/ode/method_table.h"
#include "taut/study/problems.h"

namespace taut::study {

double growthError(const std::string& method, long long steps) {
    RunPlan plan;
    plan.method = method;
    plan.grid = {1.0, 1};
    plan.stepsPerSample = steps;
    const std::unique_ptr<Subject> growth = makeGrowth();
    const std::unique_ptr<Trial> trial = growth->begin(plan);
    trial->advance();
    return std::abs(trial->observe().values.front() - std::numbers::e);
}

std::vector<GrowthRow> growthTable(double tolerance, const std::vector<std::string>& methods) {
    const auto isWanted = [&](std::string_view name) {
        return methods.empty() || std::find(methods.begin(), methods.end(), name) != methods.end();
    };
    std::vector<GrowthRow> rows;
    for (const ode::MethodInfo& info : ode::methods()) {
        if (!info.isFirstOrder() || !isWanted(info.name)) continue;
        GrowthRow row;
        row.method = info.name;
        row.tolerance = tolerance;
        // The error falls with the number of steps: double it until it is enough, then halve the interval.
        long long tooFew = 0, enough = 1;
        while (growthError(row.method, enough) >= tolerance) tooFew = enough, enough *= 2;
        while (enough - tooFew > 1) {
            const long long middle = tooFew + (enough - tooFew) / 2;
            (growthError(row.method, middle) < tolerance ? enough : tooFew) = middle;
        }
        row.steps = enough;
        row.evaluations = enough * info.evaluations;
        row.error = growthError(row.method, enough);
        row.stepsForFour = 4 / info.evaluations;
        row.errorForFour = growthError(row.method, row.stepsForFour);
        rows.push_back(row);
    }
    return rows;
}

}  // namespace taut::study
