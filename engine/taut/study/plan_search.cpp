#include "taut/study/plan_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/core/private/contains.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"

namespace taut::study {
namespace {

constexpr int moreCounts = 4;           // resolutions above the coarsest that are tried too
constexpr double stepPrecision = 1.04;  // the number of steps is found to this factor
constexpr double clearly = 0.99;        // cheaper by less than that is no reason to change anything
constexpr double leastToScan = 1e8;     // of the effort, and
constexpr double timesToScan = 1;       // times the effort before, for the search around the cheapest
constexpr double scanPrecision = 1.02;  // numbers of steps looked at are so far apart, or 1
constexpr double farFrom = 3;           // times the target: from there steps follow the order
constexpr int mostRuns = 20;            // of one method at one resolution
constexpr double shareToSearch = 0.9;   // the rest is for the verification

class Search {
  public:
    Search(const PlanContext& context, const PlanReference& reference, const std::vector<Generators>& without,
           Plan& plan)
        : context_(context), reference_(reference), without_(without), plan_(plan) {}

    void tryAsWritten() {
        world::SceneSpec model = withoutJitter(context_.spec);
        model.solver.onDivergence = world::OnDivergence::stop;
        model.solver.sleepError = 0.0;
        PlanTrial trial;
        trial.isAsWritten = true;
        trial.candidate.count = context_.resolution.count;
        trial.candidate.method = model.solver.integrator;
        trial.candidate.precision = model.solver.precision;
        const PlanRun run = context_.run(model);
        trial.candidate.substeps = run.substeps;
        note(trial, run);
    }

    // The scene as written stays if nothing cheaper is found.
    void compareAsWritten() {
        const PlanTrial& written = plan_.trials.front();
        if (written.meets && written.cost < clearly * bestCost()) plan_.chosen = 0;
    }

    void tryAll(int least) {
        const bool isFixed = context_.resolution.count == 0;
        const std::vector<std::string> names = methods();
        // Until something does, only methods that should: where one does, the others compete.
        int count = least;
        for (int finest = std::max(least, reference_.count); count <= finest; count += std::max(1, count / 20)) {
            for (std::size_t i = 0; i < preferred_; ++i) tryMethod(count, names[i], true);
            if (plan_.chosen || isFixed) break;
        }
        for (std::size_t i = preferred_; i < names.size(); ++i)
            tryMethod(std::min(count, reference_.count), names[i], true);
        for (int more = 1; more <= moreCounts && count + more <= context_.resolution.most && !isFixed && plan_.chosen;
             ++more)
            for (const std::string& method : names) tryMethod(count + more, method, false);
    }

    // The nearest candidate of a scene whose need cannot be met.
    void tryNearest(int count) {
        const std::vector<std::string> names = methods();
        for (std::size_t i = 0; i < preferred_; ++i) {
            PlanTrial trial;
            trial.candidate = {count, without_.front(), names[i], Precision::double_, 0};
            run(trial);
        }
    }

    // Single precision costs as many evaluations and takes less time each.
    void trySingle() {
        if (!plan_.chosen || plan_.trials[*plan_.chosen].candidate.precision == Precision::single_) return;
        PlanTrial trial;
        trial.candidate = plan_.trials[*plan_.chosen].candidate;
        trial.candidate.precision = Precision::single_;
        run(trial);
        if (!trial.meets) return;
        plan_.trials[*plan_.chosen].verdict = "single precision does";
        plan_.chosen = plan_.trials.size() - 1;
    }

    // Errors of the cells and of the step may cancel, which no order tells: looks at coarser and finer cells around the
    // cheapest, each method at every number of steps that could be cheaper.
    void scan(int finest) {
        if (!plan_.chosen) return;
        const double spent = context_.left(0.0) * -1;
        const double wanted = std::max(leastToScan, timesToScan * spent);
        const double most = std::min(wanted, context_.left(shareToSearch));
        const auto isOver = [&] { return -context_.left(0.0) - spent > most; };
        const int centre = plan_.trials[*plan_.chosen].candidate.count;
        const std::vector<std::string> names = methods();
        for (int away = 0; away < std::max(centre, 1); ++away)
            for (const int side : {-1, 1}) {
                const int count = centre + side * away;
                if (away == 0 && side > 0) continue;
                if (count < std::min(1, centre) || (count > centre && (count > finest || away > moreCounts))) continue;
                for (const Generators& without : without_)
                    for (const std::string& method : names) {
                        if (isOver()) {
                            plan_.isCutShort = plan_.isCutShort || most < wanted;
                            return;
                        }
                        scanMethod(count, without, method, isOver);
                    }
            }
    }

  private:
    // The scene's own first: it stays unless another is better.
    std::vector<std::string> methods() {
        std::vector<std::string> names{context_.spec.solver.integrator};
        const auto add = [&](std::string_view name) {
            if (!core::contains(names, name)) names.emplace_back(name);
        };
        add("leapfrog");
        preferred_ = names.size();
        for (const ode::MethodInfo& method : ode::methods()) add(method.name);
        return names;
    }

    double perFrame(double value) const { return value / context_.grid.frames(); }
    double bestCost() const { return plan_.chosen ? plan_.trials[*plan_.chosen].cost : HUGE_VAL; }

    // Completes a trial by its run, and keeps it if it is the cheapest so far.
    void note(PlanTrial& trial, const PlanRun& run) {
        trial.wasRun = true;
        trial.springs = run.springs;
        trial.step = run.step;
        trial.cost = perFrame(run.cost);
        trial.wasStopped = run.isTooExpensive;
        if (!run.failure.empty()) {
            trial.verdict = run.failure;
            trial.cost = PlanTrial::unset;
        } else if (run.isTooExpensive) {
            trial.verdict = "stopped: it costs more already";
        } else {
            trial.error = reference_.errorOf(run);
            trial.milliseconds = 1e3 * perFrame(run.seconds);
            trial.evaluations = perFrame(static_cast<double>(run.work.evaluations + run.work.iterations));
        }
        trial.meets = trial.error <= context_.target;
        const bool isCheaper = !trial.isAsWritten && trial.meets && trial.cost < clearly * bestCost();
        plan_.trials.push_back(trial);
        if (isCheaper) plan_.chosen = plan_.trials.size() - 1;
    }

    void run(PlanTrial& trial) {
        context_.tell(fmt::format("{}, {}", trial.candidate.method, std::string(nameOf(trial.candidate.precision))),
                      std::min(0.88, 0.6 + 0.012 * static_cast<double>(plan_.trials.size())));
        const double most = bestCost() * context_.grid.frames() * 1.0001;
        note(trial, context_.run(sceneOf(context_, trial.candidate), most));
    }

    void reject(PlanTrial trial, const std::string& verdict) {
        trial.verdict = verdict;
        plan_.trials.push_back(std::move(trial));
    }

    void tryMethod(int count, const std::string& name, bool isToldWhenSkipped) {
        const ode::MethodInfo& method = *ode::findMethod(name);
        lastError_ = PlanTrial::unset;
        PlanTrial trial;
        trial.candidate = {count, without_.front(), name, Precision::double_, 0};
        const StepFacts facts = stepFacts(modelOf(context_.spec, context_.resolution, trial.candidate));
        if (!facts.isPossible) {
            if (isToldWhenSkipped) reject(trial, "unstable at every step, or more than a million a tick");
            return;
        }
        // An implicit step has at least an evaluation and a product.
        const double each = std::isfinite(facts.limit) ? method.evaluations : std::max(2, method.evaluations);
        const auto leastCost = [&](double substeps) {
            return perFrame(facts.stepCost * substeps / facts.leastSubsteps * each * context_.grid.ticks());
        };
        const auto cannotWin = [&](double substeps) { return leastCost(substeps) >= clearly * bestCost(); };

        int tooFew = 0, substeps = facts.leastSubsteps;
        for (int runs = 0; runs < mostRuns; ++runs) {
            const bool isTooExpensive = leastCost(substeps) * context_.grid.frames() > context_.left(shareToSearch);
            plan_.isCutShort = plan_.isCutShort || (isTooExpensive && !cannotWin(substeps));
            if (cannotWin(substeps) || isTooExpensive) {
                trial.candidate.substeps = substeps;
                trial.step = facts.tick / substeps;
                trial.springs = facts.springs;
                trial.cost = leastCost(substeps);
                if (tooFew > 0 || isToldWhenSkipped)
                    reject(trial, fmt::format("needs {} {} steps a tick", tooFew > 0 ? "about" : "at least", substeps) +
                                      (cannotWin(substeps) ? ": cannot be cheaper" : ": more than the effort left"));
                return;
            }
            trial.candidate.substeps = substeps == facts.leastSubsteps ? 0 : substeps;
            PlanTrial done = trial;
            run(done);
            if (done.meets) return refine(trial, tooFew, substeps);
            if (done.wasStopped) return;
            tooFew = substeps;
            substeps = nextSubsteps(substeps, done.error, method.order);
            if (substeps == 0) return;
        }
    }

    template <class IsOver>
    void scanMethod(int count, const Generators& without, const std::string& name, const IsOver& isOver) {
        PlanTrial trial;
        trial.candidate = {count, without, name, Precision::double_, 0};
        const StepFacts facts = stepFacts(modelOf(context_.spec, context_.resolution, trial.candidate));
        if (!facts.isPossible) return;
        const ode::MethodInfo& method = *ode::findMethod(name);
        const double costOfSubstep =
            perFrame(facts.stepCost / facts.leastSubsteps * method.evaluations * context_.grid.ticks());
        double before = HUGE_VAL;
        for (int substeps = facts.leastSubsteps; substeps * costOfSubstep < clearly * bestCost() && !isOver();) {
            trial.candidate.substeps = substeps == facts.leastSubsteps ? 0 : substeps;
            PlanTrial done = trial;
            const std::optional<std::size_t> chosen = plan_.chosen;
            run(done);
            if (plan_.chosen == chosen) {
                plan_.trials.pop_back();
                ++plan_.alsoTried;
            }
            if (done.meets || done.wasStopped) return;
            if (count > 0 && std::abs(done.error - before) < 0.005 * before) return;  // only the resolution can help
            before = done.error;
            // Where points touch something errors jump: there any number of steps may do.
            const double far = (reference_.run.hasContacts ? 10 : 1) * farFrom * context_.target;
            const double follows = std::pow(done.error / far, 1.0 / method.order);
            const double next = substeps * std::max(1.0, std::isfinite(follows) ? std::min(follows, 64.0) : 2.0);
            if (next > 1e6) return;
            substeps = std::max({substeps + 1, static_cast<int>(substeps * scanPrecision), static_cast<int>(next)});
        }
    }

    // As many as the method's order promises, or the order that the last two errors show if that is less; none when
    // only the resolution can help.
    int nextSubsteps(int substeps, double error, int order) {
        const double most = 1e6;
        if (!std::isfinite(error)) return 2.0 * substeps < most ? 2 * substeps : 0;
        double shown = order;
        if (std::isfinite(lastError_)) {
            if (error > 0.98 * lastError_ && error < 1.02 * lastError_) return 0;
            shown = std::clamp(std::log(lastError_ / error) / std::log(static_cast<double>(substeps) / lastSubsteps_),
                               0.5, static_cast<double>(order));
        }
        lastError_ = error;
        lastSubsteps_ = substeps;
        const double room = std::max(context_.target - reference_.error, 0.1 * context_.target);
        const double wanted = 1.02 * substeps * std::pow(error / room, 1.0 / shown);
        const double next = std::clamp(std::ceil(wanted), substeps + 1.0, 64.0 * substeps);
        return next < most ? static_cast<int>(next) : 0;
    }

    // The fewest substeps that do, between too few and enough.
    void refine(PlanTrial trial, int tooFew, int enough) {
        while (tooFew > 0 && enough - tooFew > 1 && enough > stepPrecision * tooFew) {
            const int middle = static_cast<int>(std::sqrt(static_cast<double>(tooFew) * enough) + 0.5);
            const int next = std::clamp(middle, tooFew + 1, enough - 1);
            trial.candidate.substeps = next;
            PlanTrial done = trial;
            run(done);
            (done.meets ? enough : tooFew) = next;
        }
    }

    const PlanContext& context_;
    const PlanReference& reference_;
    const std::vector<Generators>&
        without_;  // first generators that change next to nothing, then ones that would save cost
    Plan& plan_;
    double lastError_ = PlanTrial::unset;  // of the method that is tried, and at how many substeps
    int lastSubsteps_ = 0;
    std::size_t preferred_ = 1;  // methods at the front of the list
};

}  // namespace

world::SceneSpec sceneOf(const PlanContext& context, const Candidate& candidate) {
    world::SceneSpec model = modelOf(context.spec, context.resolution, candidate);
    if (candidate.substeps > 0) setSubsteps(model, stepFacts(model), candidate.substeps);
    return model;
}

void rejectChosen(Plan& plan) {
    plan.trials[*plan.chosen].meets = false;
    plan.trials[*plan.chosen].verdict = "does not stand the verification";
    plan.chosen.reset();
    for (std::size_t i = 0; i < plan.trials.size(); ++i)
        if (plan.trials[i].meets && (!plan.chosen || plan.trials[i].cost < plan.trials[*plan.chosen].cost))
            plan.chosen = i;
}

void judgeTrials(const PlanContext& context, Plan& plan) {
    for (std::size_t i = 0; i < plan.trials.size(); ++i) {
        PlanTrial& trial = plan.trials[i];
        if (plan.chosen == i) {
            trial.verdict = "chosen";
        } else if (trial.verdict.empty() && !trial.meets) {
            trial.verdict = fmt::format("its error is {:.3g} times the target", trial.error / context.target);
        } else if (trial.verdict.empty() && plan.chosen) {
            const double ratio = trial.cost / plan.trials[*plan.chosen].cost;
            trial.verdict =
                ratio > 0.985 && ratio < 1.015 ? "costs the same" : fmt::format("costs {:.3g} times as much", ratio);
        }
    }
}

void searchCandidates(const PlanContext& context, const PlanReference& reference, std::optional<int> least,
                      const std::vector<Generators>& without, Plan& plan) {
    Search search(context, reference, without, plan);
    search.tryAsWritten();
    if (least)
        search.tryAll(*least), search.scan(reference.count);
    else
        search.tryNearest(reference.count);
    search.trySingle();
    search.compareAsWritten();
}

}  // namespace taut::study
