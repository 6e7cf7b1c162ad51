#include "taut/study/plan_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "taut/core/error.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"
#include "taut/study/fehlberg78.h"
#include "taut/study/plan_search.h"

namespace taut::study {
namespace {

constexpr double leastOfExtrapolated = 0.1;  // of the error that extrapolation takes away, is taken to be left
constexpr double finerShare = 20;            // as leastShareOfReference, where that costs little more
constexpr double shareOfSteps = 50;          // and that of its steps
constexpr double leastShare = 1e-3;          // of the target: the tolerance of a method that controls its error
constexpr double shareOfReference = 0.5;     // of the effort
constexpr double littleMore = 0.05;          // of the effort
constexpr int leastFinerOfContacts = 8;      // times finer than the step that "auto" finds
constexpr int mostFinerOfSmooth = 8;         // the same, before a method of high order does better
constexpr int mostTimesFiner = 64;           // than the scene as written
// Orders between which a measured one is believed: sagging cloth has about 1 to 1.5, theory ends at 2.
constexpr double leastOrder = 0.5, mostOrder = 2.0;

struct ExactMethod {
    Candidate candidate;
    StepFacts facts;
    double evaluations = 0;  // a step
};

// Leap-frog, unless its largest stable step makes it many times as expensive as a method with more steps of the same
// error.
ExactMethod exactMethod(const PlanContext& context, int count) {
    ExactMethod best;
    double least = HUGE_VAL;
    for (const auto& [method, handicap] : {std::pair{"leapfrog", 1.0}, {"rk4", 8.0}, {"sdirk2", 3e4}}) {
        ExactMethod exact;
        exact.candidate.count = count;
        exact.candidate.method = method;
        exact.facts = stepFacts(modelOf(context.spec, context.resolution, exact.candidate));
        exact.evaluations = ode::findMethod(method)->evaluations;
        const double cost = handicap * exact.evaluations * exact.facts.stepCost;
        if (!exact.facts.isPossible || cost >= least) continue;
        least = cost;
        best = exact;
    }
    return best;
}

// Cells along the longest edge, from two on, each about twice the one before, the scene's own among them.
std::vector<int> ladder(int count, int most) {
    std::vector<int> counts;
    if (count == 0) return {0};  // nothing to refine
    for (int c = count; c >= 2; c = (c + 1) / 2) {
        counts.push_back(c);
        if (c == 2) break;
    }
    if (counts.empty()) counts.push_back(count);
    std::ranges::reverse(counts);
    for (int c = 2 * count; c <= std::min(mostTimesFiner * count, most); c *= 2) counts.push_back(c);
    if (most < mostTimesFiner * count && most > counts.back()) counts.push_back(most);
    return counts;
}

// Richardson's: beyond the finer run by a factor of the difference of the two.
PlanRun extrapolatedRun(const PlanRun& coarse, const PlanRun& fine, double factor) {
    PlanRun run = fine;
    for (std::size_t s = 0; s < run.at.size(); ++s)
        for (std::size_t i = 0; i < run.at[s].size(); ++i) run.at[s][i] += factor * (fine.at[s][i] - coarse.at[s][i]);
    return run;
}

// [m/s]
double toleranceOf(const PlanContext& context) {
    return leastShare * context.target / std::max(context.grid.seconds(), context.grid.tick);
}

// By a method that controls its own error, at two tolerances of which one is a hundredth of the other.
ExactRun controlledRun(const PlanContext& context, int count) {
    Candidate candidate;
    candidate.count = count;
    candidate.method = fehlberg78;
    world::SceneSpec model = modelOf(context.spec, context.resolution, candidate);
    model.solver.methods = referenceMethods();
    model.solver.cgTolerance = 100 * toleranceOf(context);
    const PlanRun coarse = context.run(model);
    model.solver.cgTolerance = toleranceOf(context);
    ExactRun result{context.run(model), HUGE_VAL,
                    fmt::format("Fehlberg 7(8) at a tolerance of {:.2g} m/s", toleranceOf(context))};
    // The error of the finer run is a hundredth of that; the factor of ten is room for its growth with the motion.
    result.error = difference(coarse, result.run) / 10;
    return result;
}

// At ever shorter steps until halving them tells no more, or they are so many times finer than "auto" finds.
ExactRun steppedRun(const PlanContext& context, const ExactMethod& exact, double effortShare, int mostFiner) {
    const auto runAt = [&](int finer) {
        Candidate candidate = exact.candidate;
        candidate.substeps = finer * exact.facts.leastSubsteps;
        return context.run(sceneOf(context, candidate));
    };
    ExactRun result{runAt(1), HUGE_VAL, ""};
    double before = 0;
    for (int finer = 2; finer <= mostFiner; finer *= 2) {
        if (finer > 2 && context.left(effortShare) < 3 * result.run.effort) break;
        PlanRun next = runAt(finer);
        if (!next.hasEnded()) break;
        const double change = difference(result.run, next);
        // Halving shrinks the error by 2 to 16, as the order is 1 to 4: as the last halvings have shown, or as little
        // as may be. Where points touch something two runs may agree by chance: the halving before has a say.
        const double shrinks = before > 0 ? std::clamp(before / std::max(change, 1e-300), 2.0, 16.0) : 2.0;
        result.run = std::move(next);
        result.error = std::max(change / (shrinks - 1), result.run.hasContacts ? before / 2 : 0.0);
        result.method = fmt::format("{} at steps of {:.3g} s", exact.candidate.method, result.run.step);
        before = change;
        const int least = result.run.hasContacts ? leastFinerOfContacts : 2;
        if (finer >= least && result.error < context.target / shareOfSteps) break;
    }
    return result;
}

void expectWhole(const PlanContext& context, const ExactRun& exact) {
    if (exact.run.isTooExpensive) failForEffort(context);
    if (!exact.run.hasEnded())
        throw core::Error(core::ErrorKind::diverged, context.spec.file + ": even the reference: " + exact.run.failure);
}

}  // namespace

void PlanContext::tell(const std::string& doing, double done) const {
    if (settings.listener.isStopped())
        throw core::Error(core::ErrorKind::interrupted, "interrupted before a plan was found");
    settings.listener.report(done, doing);
}

void failForEffort(const PlanContext& context) {
    throw core::Error(core::ErrorKind::usage,
                      context.spec.file + ": the effort does not suffice for a single run: a larger --effort");
}

PlanRun PlanContext::run(const world::SceneSpec& model, double most) const {
    if (left() <= 0) {
        PlanRun none;
        none.isTooExpensive = true;
        isCutShort = true;
        return none;
    }
    PlanRun run = play(model, resolution, grid, {.cost = most, .effort = std::max(left(), 0.0)});
    if (run.isTooExpensive && run.cost <= most) isCutShort = true;
    spent.fetch_add(static_cast<std::int64_t>(run.effort), std::memory_order_relaxed);
    return run;
}

double exactEffort(const PlanContext& context, int count) {
    const ExactMethod exact = exactMethod(context, count);
    return exact.evaluations > 0 ? 3 * exact.evaluations * exact.facts.stepCost * context.grid.ticks() : HUGE_VAL;
}

ExactRun exactRun(const PlanContext& context, int count, double effortShare) {
    const ExactMethod exact = exactMethod(context, count);
    const bool isSmooth =
        exact.candidate.method != "sdirk2" && context.spec.colliders.empty() && !world::bodiesTouch(context.spec);
    ExactRun stepped =
        steppedRun(context, exact, effortShare, isSmooth ? mostFinerOfSmooth : std::numeric_limits<int>::max() / 2);
    if (isSmooth && stepped.error > context.target / shareOfSteps) {
        ExactRun controlled = controlledRun(context, count);
        if (controlled.run.work.unconverged == 0 && controlled.error < stepped.error) return controlled;
    }
    return stepped;
}

PlanReference makePlanReference(const PlanContext& context) {
    PlanReference reference;
    double before = 0, spent = 0;  // change between the two resolutions before; effort of the last of them
    for (const int count : ladder(context.resolution.count, context.resolution.most)) {
        const bool isFirst = reference.runs.empty();
        // Four resolutions at least: with two there is no order, with three it may be chance.
        const bool isEnough = reference.runs.size() > 3 && reference.error < context.target / leastShareOfReference;
        if (isEnough && reference.error < context.target / finerShare) break;
        if (!isFirst) {
            const double wanted = spent * exactEffort(context, count) / exactEffort(context, reference.count);
            if (wanted > (isEnough ? littleMore * context.settings.effort : context.left(shareOfReference))) {
                context.isCutShort = context.isCutShort || !isEnough;
                break;
            }
        }
        context.tell(count > 0 ? fmt::format("reference, {} cells", count) : "reference",
                     0.3 + 0.03 * static_cast<double>(reference.runs.size()));
        spent = context.left();
        ExactRun exact = exactRun(context, count, shareOfReference);
        spent -= context.left();
        if (isFirst) expectWhole(context, exact);
        if (!exact.run.hasEnded()) break;
        reference.runs[count] = exact.run;
        reference.limit = exact.run;
        reference.error = reference.unknown = exact.error;
        if (isFirst && count > 0) reference.unknown = reference.error = HUGE_VAL;  // the error of cells is unknown
        if (!isFirst) {
            const double apart = difference(reference.run, exact.run);
            const double finer = std::log(static_cast<double>(count) / reference.count);
            if (before > 0) reference.order = std::log(before / std::max(apart, 1e-300)) / finer;
            // With a lower one no limit is within reach, as of cloth held at a corner, which gives way the more the
            // finer it is: then the change by doubling the cells is used.
            const double order = before > 0 ? std::clamp(reference.order, 0.0, mostOrder) : 1.0;
            const double shrinks = std::exp(order * finer);
            const double beyond = order < leastOrder ? 1 / shrinks : 1 / (shrinks - 1);
            reference.limit = extrapolatedRun(reference.run, exact.run, beyond);
            reference.unknown += leastOfExtrapolated * beyond * apart;
            reference.error += beyond * apart;
            before = apart;
        }
        reference.run = std::move(exact.run);
        reference.count = count;
        reference.method = exact.method;
    }
    return reference;
}

std::optional<int> leastCount(const PlanContext& context, PlanReference& reference) {
    const auto isEnough = [&](int count) {
        const auto found = reference.runs.find(count);
        if (found == reference.runs.end()) {
            context.tell(fmt::format("{} cells", count), 0.55);
            reference.runs[count] = exactRun(context, count, shareOfReference).run;
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
