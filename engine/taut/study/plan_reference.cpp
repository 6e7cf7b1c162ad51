#include "taut/study/plan_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"
#include "taut/study/fehlberg78.h"
#include "taut/study/plan_search.h"

namespace taut::study {
namespace {

constexpr double leastOfExtrapolated = 0.1;  // of the error that extrapolation takes away, is taken to be left
constexpr double share = 5;                  // the reference's own error is to be so many times below the target
constexpr double shareOfSteps = 20;          // and that of its steps
constexpr double leastShare = 1e-3;          // of the target: the tolerance of a method that controls its error
constexpr double shareOfReference = 0.5;
constexpr int leastFinerOfContacts = 32;  // times finer than the step that "auto" finds
constexpr int mostTimesFiner = 8;         // than the scene as written
// Orders between which a measured one is believed: sagging cloth has about 1 to 1.5, theory ends at 2.
constexpr double leastOrder = 0.5, mostOrder = 2.0;

struct ExactMethod {
    Candidate candidate;
    StepFacts facts;
    double evaluations = 0;  // a step
};

// RK4, unless its largest stable step makes it many times as dear as others, which need more steps to be as exact.
ExactMethod exactMethod(const PlanContext& context, int count) {
    ExactMethod best;
    double least = HUGE_VAL;
    for (const auto& [method, handicap] : {std::pair{"rk4", 1.0}, {"leapfrog", 30.0}, {"sdirk2", 1e6}}) {
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
    for (int c = count; c >= 2; c = (c + 1) / 2) {
        counts.push_back(c);
        if (c == 2) break;
    }
    if (counts.empty()) counts.push_back(count);
    std::reverse(counts.begin(), counts.end());
    for (int c = 2 * count; c <= std::min(mostTimesFiner * count, most); c *= 2) counts.push_back(c);
    if (most < mostTimesFiner * count && most > counts.back()) counts.push_back(most);
    return counts;
}

// Richardson's: beyond the finer run by a factor of what the two are apart.
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
    // What the finer run errs by is a hundredth of that; ten times more is room for what the motion makes of it.
    result.error = difference(coarse, result.run) / 10;
    return result;
}

// At ever shorter steps until halving them tells no more.
ExactRun steppedRun(const PlanContext& context, const ExactMethod& exact, double effortShare) {
    const auto runAt = [&](int finer) {
        Candidate candidate = exact.candidate;
        candidate.substeps = finer * exact.facts.leastSubsteps;
        return context.run(sceneOf(context, candidate));
    };
    ExactRun result{runAt(1), HUGE_VAL, ""};
    double before = 0;
    for (int finer = 2;; finer *= 2) {
        if (finer > 2 && context.left(effortShare) < 3 * result.run.effort) break;
        PlanRun next = runAt(finer);
        if (!next.isWhole()) break;
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
    if (exact.run.isTooDear) failForEffort(context);
    if (!exact.run.isWhole())
        throw core::Error(core::ErrorKind::diverged, context.spec.file + ": even the reference: " + exact.run.failure);
}

}  // namespace

void PlanContext::tell(const std::string& doing, double done) const {
    if (settings.stop != nullptr && *settings.stop)
        throw core::Error(core::ErrorKind::interrupted, "interrupted before a plan was found");
    if (settings.progress) settings.progress({doing, done});
}

void failForEffort(const PlanContext& context) {
    throw core::Error(core::ErrorKind::usage,
                      context.spec.file + ": the effort does not suffice for a single run: a larger --effort");
}

PlanRun PlanContext::run(const world::SceneSpec& model, double most) const {
    if (left() <= 0) {
        PlanRun none;
        none.isTooDear = true;
        isCutShort = true;
        return none;
    }
    PlanRun run = play(model, resolution, grid, {.cost = most, .effort = std::max(left(), 0.0)});
    if (run.isTooDear && run.cost <= most) isCutShort = true;
    spent.fetch_add(static_cast<std::int64_t>(run.effort), std::memory_order_relaxed);
    return run;
}

double exactEffort(const PlanContext& context, int count) {
    const ExactMethod exact = exactMethod(context, count);
    return exact.evaluations > 0 ? 3 * exact.evaluations * exact.facts.stepCost * context.grid.ticks() : HUGE_VAL;
}

ExactRun exactRun(const PlanContext& context, int count, double effortShare) {
    const ExactMethod exact = exactMethod(context, count);
    const bool isControlled =
        exact.candidate.method == "rk4" && context.spec.colliders.empty() && !world::bodiesTouch(context.spec);
    if (isControlled) {
        ExactRun run = controlledRun(context, count);
        if (run.run.isWhole() && run.run.work.unconverged == 0) return run;
    }
    return steppedRun(context, exact, effortShare);
}

PlanReference makePlanReference(const PlanContext& context) {
    PlanReference reference;
    if (context.resolution.count == 0) {
        ExactRun exact = exactRun(context, 0, shareOfReference);
        expectWhole(context, exact);
        reference.run = std::move(exact.run);
        reference.error = exact.error;
        reference.method = exact.method;
        return reference;
    }
    double before = 0, ofResolution = HUGE_VAL;
    PlanRun last;          // by the cells before
    PlanRun extrapolated;  // from those and the ones before them
    for (const int count : ladder(context.resolution.count, context.resolution.most)) {
        const bool isFirst = reference.count == 0;
        if (!isFirst && 2 * exactEffort(context, count) > context.left(shareOfReference)) {
            context.isCutShort = true;
            break;
        }
        context.tell(fmt::format("reference, {} cells", count),
                     0.3 + 0.03 * static_cast<double>(reference.runs.size()));
        ExactRun exact = exactRun(context, count, shareOfReference);
        if (isFirst) expectWhole(context, exact);
        if (!exact.run.isWhole()) break;
        PlanRun best = exact.run;
        if (!isFirst) {
            const double apart = difference(last, exact.run);
            const double ratio = std::log(static_cast<double>(count) / reference.count);
            if (before > 0) reference.order = std::log(before / std::max(apart, 1e-300)) / ratio;
            const double order = std::clamp(before > 0 ? reference.order : 1.0, leastOrder, mostOrder);
            const double factor = 1 / (std::exp(order * ratio) - 1);
            ofResolution = factor * apart;
            PlanRun next = extrapolatedRun(last, exact.run, factor);
            // What two extrapolations in a row differ by is more than the later one errs by.
            const double left = before > 0 && extrapolated.isWhole() && !extrapolated.at.empty()
                                    ? std::max(difference(extrapolated, next), leastOfExtrapolated * ofResolution)
                                    : HUGE_VAL;
            if (left < ofResolution) {
                best = next;
                ofResolution = left;
            }
            extrapolated = std::move(next);
            before = apart;
        }
        reference.runs[count] = exact.run;
        last = std::move(exact.run);
        reference.run = std::move(best);
        reference.count = count;
        reference.error = ofResolution + exact.error;
        reference.method = exact.method;
        // Three resolutions at least: with two there is no order.
        if (reference.runs.size() > 3 && reference.error < context.target / share) break;
    }
    return reference;
}

std::optional<int> leastCount(const PlanContext& context, PlanReference& reference) {
    if (reference.runs.empty()) return std::nullopt;
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
