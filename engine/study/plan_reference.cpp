#include "taut/study/plan_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"

namespace taut::study {
namespace {

constexpr double share = 5;        // the reference's own error is to be so many times below the target
constexpr double longestRun = 25;  // [s] of wall time
constexpr int mostTimesFiner = 8;  // than the scene as written
// Orders between which a measured one is believed: sagging cloth has about 1 to 1.5, theory ends at 2.
constexpr double leastOrder = 0.5, mostOrder = 2.0;

Candidate exactCandidate(int count) {
    Candidate candidate;
    candidate.count = count;
    candidate.method = "rk4";
    return candidate;
}

PlanRun exactRunAt(const PlanContext& context, int count, int finer) {
    world::SceneSpec model = modelOf(context.spec, context.resolution, exactCandidate(count));
    const StepFacts facts = stepFacts(model);
    setSubsteps(model, facts, finer * facts.leastSubsteps);
    PlanRun run = play(model, context.resolution, context.grid);
    if (!run.isWhole())
        throw core::Error(
            core::ErrorKind::diverged,
            context.spec.file + ": even the reference, RK4 with a step far below its limit: " + run.failure);
    return run;
}

// Cells along the longest edge, from two on, each about twice the one before, the scene's own among them.
std::vector<int> ladder(int count) {
    std::vector<int> counts;
    for (int c = count; c >= 2; c = (c + 1) / 2) {
        counts.push_back(c);
        if (c == 2) break;
    }
    if (counts.empty()) counts.push_back(count);
    std::reverse(counts.begin(), counts.end());
    for (int c = 2 * count; c <= mostTimesFiner * count; c *= 2) counts.push_back(c);
    return counts;
}

PlanReference referenceOfOneResolution(const PlanContext& context) {
    PlanReference reference;
    reference.run = exactRunAt(context, context.resolution.count, 4);
    reference.error = difference(exactRunAt(context, context.resolution.count, 2), reference.run);
    return reference;
}

}  // namespace

void PlanContext::tell(const std::string& doing, double done) const {
    if (settings.stop != nullptr && *settings.stop)
        throw core::Error(core::ErrorKind::interrupted, "interrupted before a plan was found");
    if (settings.progress) settings.progress({doing, done});
}

double exactCost(const PlanContext& context, int count) {
    const StepFacts facts = stepFacts(modelOf(context.spec, context.resolution, exactCandidate(count)));
    return facts.isPossible ? facts.weightedSteps * 2 * 4 * context.grid.ticks() : HUGE_VAL;
}

PlanRun exactRun(const PlanContext& context, int count) {
    return exactRunAt(context, count, 2);
}

PlanReference makePlanReference(const PlanContext& context) {
    if (context.resolution.count == 0) return referenceOfOneResolution(context);
    PlanReference reference;
    double before = 0, costBefore = 0;
    for (const int count : ladder(context.resolution.count)) {
        const bool isFirst = reference.count == 0;
        const double cost = exactCost(context, count);
        // Contacts and what else takes time are seen from the resolution before.
        const double expected = isFirst ? 0.0 : reference.run.seconds * cost / costBefore;
        if (!isFirst && (cost > context.settings.effort || expected > longestRun)) break;
        costBefore = cost;
        context.tell(fmt::format("reference, {} cells", count),
                     0.3 + 0.03 * static_cast<double>(reference.runs.size()));
        PlanRun run = exactRun(context, count);
        if (!isFirst) {
            const double apart = difference(reference.run, run);
            const double ratio = std::log(static_cast<double>(count) / reference.count);
            if (before > 0) reference.order = std::log(before / std::max(apart, 1e-300)) / ratio;
            const double order = std::clamp(before > 0 ? reference.order : 1.0, leastOrder, mostOrder);
            reference.error = apart / (std::exp(order * ratio) - 1);
            before = apart;
        }
        reference.runs[count] = run;
        reference.run = std::move(run);
        reference.count = count;
        // Three resolutions at least: with two there is no order.
        if (reference.runs.size() > 3 && reference.error < context.target / share) break;
    }
    if (reference.runs.size() == 1) reference.error = HUGE_VAL;
    return reference;
}

std::optional<int> leastCount(const PlanContext& context, PlanReference& reference) {
    const auto isEnough = [&](int count) {
        const auto found = reference.runs.find(count);
        if (found == reference.runs.end()) {
            context.tell(fmt::format("{} cells", count), 0.55);
            reference.runs[count] = exactRun(context, count);
        }
        return reference.errorOf(reference.runs[count]) <= context.target;
    };
    std::vector<int> counts;
    for (const auto& [count, run] : reference.runs) counts.push_back(count);
    // From the finest down, as long as they are enough: a coarse one may come close by chance.
    int enough = 0, tooFew = 0;
    for (auto count = counts.rbegin(); count != counts.rend() && tooFew == 0; ++count)
        (isEnough(*count) ? enough : tooFew) = *count;
    if (enough == 0) return std::nullopt;
    while (tooFew > 0 && enough - tooFew > 1) {
        const int middle = (enough + tooFew) / 2;
        (isEnough(middle) ? enough : tooFew) = middle;
    }
    return enough;
}

}  // namespace taut::study
