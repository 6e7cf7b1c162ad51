#include "taut/study/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"
#include "taut/study/plan_changes.h"
#include "taut/study/plan_search.h"

namespace taut::study {
namespace {

constexpr int mostVerified = 4;            // of one search
constexpr double stricter = 0.75;          // a target after a verification that failed
constexpr double mostJitter = 1e-5;        // [m] a start is hardly known better
constexpr double leastGrowth = 0.1;        // of the target: a smaller one is shaken by that
constexpr double generatorShare = 0.1;     // of the target, for the sum of the generators that are always left out
constexpr double shareOfGenerators = 0.2;  // of the effort

Candidate plainCandidate(const PlanContext& context) {
    Candidate candidate;
    candidate.count = context.resolution.count;
    return candidate;
}

// Resolves percents and pixels, and whether the motion can be predicted at all. Sets grid and target.
PlanRun resolveNeed(PlanContext& context, Plan& plan) {
    checkNeed(context.spec);
    context.tell("scene as it is", 0.02);
    context.grid = planGrid(context.spec, resolvedNeed(context.spec, {1.0, 1.0}).horizon);
    const auto playWhole = [&](const world::SceneSpec& scene) {
        PlanRun run = play(scene, context.resolution, context.grid,
                           {.effort = std::max(context.left(), 0.0), .withScales = true});
        context.spent += static_cast<std::int64_t>(run.effort);
        if (run.isTooExpensive) failForEffort(context);
        return run;
    };
    world::SceneSpec model = modelOf(context.spec, context.resolution, plainCandidate(context));
    PlanRun base = playWhole(model);
    std::string failure = base.failure;
    // Where leap-frog cannot, another method may.
    for (const ode::MethodInfo& method : ode::methods()) {
        if (base.hasEnded()) break;
        model.solver.integrator = method.name;
        base = playWhole(model);
    }
    if (!base.hasEnded())
        throw core::Error(core::ErrorKind::diverged,
                          fmt::format("{}: leap-frog with the step found for it: {}", plan.name, failure));
    context.plainMethod = model.solver.integrator;
    plan.need = resolvedNeed(context.spec, base.scales);
    context.target = plan.need.target;

    context.tell("jitter", 0.08);
    plan.jitter = std::min(mostJitter, leastGrowth * context.target);
    for (world::BodySpec& body : model.bodies) body.jitter = plan.jitter;
    const PlanRun shaken = context.run(model);
    plan.jitterMoves = difference(base, shaken);
    if (plan.jitterMoves == 0)
        throw core::Error(core::ErrorKind::badContent, plan.name + ": error: nothing in the scene can move");
    plan.isChaotic = !shaken.isTooExpensive && plan.jitterMoves > context.target;
    plan.seconds = context.grid.tick * context.grid.every *
                   (plan.isChaotic ? samplesWithin(base, shaken, context.target) : context.grid.samples);
    return base;
}

// The generators that candidates may leave out, in every combination: all that together change next to nothing, and
// generators that change less than the target if the cost depends on them. The first set is that of all that change
// next to nothing.
std::vector<Generators> generatorsToDrop(const PlanContext& context, const PlanRun& base, Plan& plan) {
    const Generators all = generatorsOf(context.spec);
    const double most = context.left(shareOfGenerators) / static_cast<double>(all.size() + 1);
    const auto changeWithout = [&](const Generators& without) {
        Candidate candidate = plainCandidate(context);
        candidate.without = without;
        candidate.method = context.plainMethod;
        const PlanRun run = play(modelOf(context.spec, context.resolution, candidate), context.resolution, context.grid,
                                 {.effort = most});
        context.spent += static_cast<std::int64_t>(run.effort);
        return difference(base, run);
    };
    context.tell("force generators", 0.18);
    std::vector<double> change(all.size());
    core::parallelFor(static_cast<int>(all.size()), [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        change[k] = changeWithout({all[k]});
    });
    std::vector<std::size_t> order(all.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return change[a] < change[b]; });

    Generators idle, dear;
    for (const std::size_t i : order) {
        Generators more = idle;
        more.push_back(all[i]);
        if (change[i] < generatorShare * context.target &&
            (more.size() == 1 || changeWithout(more) < generatorShare * context.target))
            idle = more;
        else if (change[i] < context.target && all[i].setsCost)
            dear.push_back(all[i]);
        const bool isIdle = !idle.empty() && idle.back().name == all[i].name;
        plan.generators.push_back({all[i].name, change[i], isIdle, isIdle ? "left out" : "stays"});
    }
    std::vector<Generators> sets{{}};
    const auto addWithout = [&](const Generator& generator) {
        for (std::size_t k = 0, n = generator.setsCost ? sets.size() : 0; k < n; ++k) sets.push_back(sets[k]);
        for (std::size_t k = generator.setsCost ? sets.size() / 2 : 0; k < sets.size(); ++k)
            sets[k].push_back(generator);
    };
    std::for_each(idle.begin(), idle.end(), addWithout);
    std::swap(sets.front(), sets.back());  // without all of them
    std::for_each(dear.begin(), dear.end(), addWithout);
    return sets;
}

void judgeGenerators(Plan& plan) {
    if (!plan.chosen) return;
    const Generators& without = plan.trials[*plan.chosen].candidate.without;
    for (GeneratorTrial& trial : plan.generators) {
        trial.isLeftOut =
            std::ranges::any_of(without, [&](const Generator& generator) { return generator.name == trial.name; });
        trial.verdict = trial.isLeftOut                   ? "left out"
                        : trial.change < plan.need.target ? "stays: nothing that meets the need is cheaper without it"
                                                          : "needed: it changes more than the target";
    }
}

void listResolutions(const PlanContext& context, const PlanReference& reference, Plan& plan) {
    plan.order = reference.order;
    plan.referenceError = reference.error;
    plan.referenceMethod = reference.method;
    plan.referenceCount = reference.count;
    for (const auto& [count, run] : reference.runs) {
        const double error = reference.errorOf(run);
        plan.resolutions.push_back({count, run.springs, error, error <= context.target});
    }
}

// Against a quarter of the step, and against that at twice the resolution with every generator.
void verify(const PlanContext& context, Plan& plan) {
    const PlanTrial& trial = plan.trials[*plan.chosen];
    const auto withFinerSteps = [&](Candidate candidate) {
        const StepFacts facts = stepFacts(modelOf(context.spec, context.resolution, candidate));
        candidate.substeps = std::max(candidate.substeps, facts.leastSubsteps);
        return candidate;
    };
    const world::SceneSpec model = trial.isAsWritten ? withoutJitter(context.spec) : sceneOf(context, trial.candidate);
    context.tell("verification", 0.9);
    PlanRun chosen = context.run(model);
    std::vector<double> seconds{chosen.seconds};
    for (int i = 0; i < 2; ++i) seconds.push_back(context.run(model).seconds);
    std::ranges::sort(seconds);
    plan.trials[*plan.chosen].milliseconds = 1e3 * seconds[1] / context.grid.frames();
    plan.secondsAnEvaluation =
        seconds[1] / static_cast<double>(std::max<std::int64_t>(1, chosen.work.evaluations + chosen.work.iterations));

    Candidate quarter = trial.candidate;
    quarter.precision = Precision::double_;
    quarter.substeps = 4 * chosen.substeps;
    quarter = withFinerSteps(quarter);
    context.tell("verification, a quarter of the step", 0.92);
    plan.verification.step = difference(chosen, context.run(sceneOf(context, quarter)));
    plan.verification.isPassed = plan.verification.step <= plan.need.target;
    plan.verification.isCutShort = context.left() <= 0;
    if (context.resolution.count == 0) return;

    Candidate twice = quarter;
    twice.count = std::min(2 * trial.candidate.count, std::max(context.resolution.most, trial.candidate.count));
    twice.without.clear();
    twice = withFinerSteps(twice);
    plan.verification.count = twice.count;
    context.tell("verification, twice the resolution", 0.94);
    plan.verification.finer = difference(chosen, context.run(sceneOf(context, twice)));
    plan.verification.isPassed = plan.verification.isPassed && plan.verification.finer <= plan.need.target;
    plan.verification.isCutShort = context.left() <= 0;
}

// The next cheapest replaces a candidate that fails the verification; if all fail, the search is repeated once with a
// stricter target.
void searchAndVerify(PlanContext& context, const PlanReference& reference, std::optional<int> least,
                     const std::vector<Generators>& without, Plan& plan) {
    for (int round = 0; round < 3; ++round, context.target *= stricter) {
        plan.trials.clear();
        plan.chosen.reset();
        plan.alsoTried = 0;
        searchCandidates(context, reference, least, without, plan);
        if (!plan.chosen) return judgeTrials(context, plan);
        for (int i = 0; i < mostVerified; ++i) {
            verify(context, plan);
            const std::size_t verified = *plan.chosen;
            const bool isLast = plan.verification.isPassed || plan.verification.isCutShort;
            if (!isLast) rejectChosen(plan);
            if (isLast || !plan.chosen || i + 1 == mostVerified) {
                plan.chosen = verified;
                judgeTrials(context, plan);
                if (isLast) return;
                break;
            }
        }
    }
}

void addRemarks(const PlanContext& context, const PlanReference& reference, Plan& plan) {
    const auto add = [&](std::string remark) { plan.remarks.push_back(std::move(remark)); };
    add(fmt::format("The promise holds for the first {:.3g} s, the horizon asked for.", plan.seconds));
    if (plan.unseen() > 0)
        add(fmt::format("Warning: the time between {:.3g} s and the end of the run at {:.3g} s was not simulated.",
                        plan.seconds, plan.runSeconds));
    bool hasJitter = false;
    for (const world::BodySpec& body : context.spec.bodies) hasJitter = hasJitter || body.jitter > 0;
    if (hasJitter) add("jitter_m is taken as 0 in all runs: every resolution would be shaken in another way.");
    for (const auto& [name, why] : context.resolution.fixed) add(fmt::format("{} keeps its cells: {}.", name, why));
    add(fmt::format("The reference is {}; its own error, cells included, is about {}, {:.2g} times the allowed error.",
                    plan.referenceMethod, lengthText(reference.error), reference.error / plan.need.target));
    if (context.resolution.count > 0)
        add("The error of a candidate is its distance from the reference or from the limit of finer cells, whichever "
            "is larger.");
    if (context.resolution.most < std::numeric_limits<int>::max())
        add(fmt::format(
            "No more than {} cells are tried: with smaller ones bodies that touch would keep further apart than "
            "those are wide; a smaller thickness would allow more.",
            context.resolution.most));
    if (world::bodiesTouch(context.spec))
        add("Contact between bodies is never left out; the cost has it, by its detections and the pairs they looked "
            "at.");
    if (reference.run.hasContacts) add("There are contacts, which are of order 1 in the step for any method.");
    if (plan.isCutShort) add("The effort was used up before all was tried: a larger --effort may find a cheaper way.");
    if (reference.error > plan.need.target / leastShareOfReference)
        add("That is more than the intended fifth: a larger --effort would reduce it.");
}

}  // namespace

Plan makePlan(const world::SceneSpec& spec, const PlanSettings& settings) {
    checkNeed(spec);
    Plan plan;
    plan.name = spec.title.empty() ? spec.file : spec.title;
    PlanContext context{spec, settings, resolutionOf(spec), {}, 0, "leapfrog"};
    plan.resolution = context.resolution;
    plan.runSeconds = spec.run.seconds;
    const PlanRun base = resolveNeed(context, plan);
    if (plan.isChaotic) return plan;
    const std::vector<Generators> without = generatorsToDrop(context, base, plan);

    context.tell("reference", 0.3);
    PlanReference reference = makePlanReference(context);
    const std::optional<int> least =
        context.resolution.count == 0 ? std::optional<int>(0) : leastCount(context, reference);
    listResolutions(context, reference, plan);
    searchAndVerify(context, reference, least, without, plan);
    if (plan.chosen) {
        const PlanTrial& chosen = plan.trials[*plan.chosen];
        const PlanTrial& written = plan.trials.front();
        plan.ratio = written.hasWholeCost() ? written.cost / chosen.cost : PlanTrial::unset;
        if (!chosen.isAsWritten) plan.changes = planChanges(spec, sceneOf(context, chosen.candidate));
    }
    judgeGenerators(plan);
    plan.isCutShort = plan.isCutShort || context.isCutShort;
    addRemarks(context, reference, plan);
    plan.spent = settings.effort - context.left();
    settings.listener.report(1.0, "done");
    return plan;
}

}  // namespace taut::study
