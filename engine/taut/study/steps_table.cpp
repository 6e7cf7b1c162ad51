#include "taut/study/steps_table.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/ode/method_table.h"

namespace taut::study {

double endError(const Subject& subject, const std::string& method, long long steps) {
    RunPlan plan;
    plan.method = method;
    plan.grid = {1.0, 1};
    plan.stepsPerSample = steps;
    const auto exact = subject.exact(plan.grid.duration());
    TAUT_EXPECTS(exact.has_value());
    const std::unique_ptr<Trial> trial = subject.begin(plan);
    trial->advance();
    return std::abs(trial->observe().values.front() - exact->values.front());
}

std::vector<StepsRow> stepsTable(const Subject& subject, double tolerance, const std::vector<std::string>& methods) {
    const auto error = [&](const std::string& method, long long steps) { return endError(subject, method, steps); };
    std::vector<StepsRow> rows;
    for (const ode::MethodInfo& info : chosenMethods(methods)) {
        if (!info.isFirstOrder()) continue;
        StepsRow row;
        row.method = info.name;
        row.tolerance = tolerance;
        // The error falls with the number of steps: double it until it is enough, then halve the interval.
        long long tooFew = 0, enough = 1;
        while (error(row.method, enough) >= tolerance) tooFew = enough, enough *= 2;
        while (enough - tooFew > 1) {
            const long long middle = tooFew + (enough - tooFew) / 2;
            (error(row.method, middle) < tolerance ? enough : tooFew) = middle;
        }
        row.steps = enough;
        row.evaluations = enough * info.evaluations;
        row.error = error(row.method, enough);
        row.stepsForFour = 4 / info.evaluations;
        row.errorForFour = error(row.method, row.stepsForFour);
        rows.push_back(row);
    }
    return rows;
}

}  // namespace taut::study
