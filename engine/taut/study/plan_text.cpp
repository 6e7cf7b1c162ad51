#include "taut/study/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "taut/report/column.h"

namespace taut::study {
namespace {

using Json = nlohmann::ordered_json;
using report::In;

// See costOf().
constexpr const char* costExplained =
    "springs, points and 5 for a volume cell, times evaluations of the forces and products of a solver; 2.2 times as "
    "much where steps split the dashpots off";

std::string numberText(double value, const char* format) {
    return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string countText(int count) {
    return count > 0 ? std::to_string(count) : "as written";
}

report::Columns<GeneratorTrial> generatorColumns() {
    using Trial = GeneratorTrial;
    return {{"name", &Trial::name, "without"},
            {"change_m", &Trial::change, "changes",
             [](const Trial& t) { return std::isfinite(t.change) ? lengthText(t.change) : "diverges"; }},
            {"left_out", &Trial::isLeftOut},
            {"verdict", &Trial::verdict, "verdict"}};
}

report::Columns<ResolutionTrial> resolutionColumns() {
    using Trial = ResolutionTrial;
    return {
        {"cells", &Trial::count, "cells"},
        {"springs", &Trial::springs, "springs", [](const Trial& t) { return static_cast<long long>(t.springs); }},
        {"error_m", &Trial::error, "error", [](const Trial& t) { return lengthText(t.error); }},
        {"enough", &Trial::isEnough, "verdict", [](const Trial& t) { return t.isEnough ? "enough" : "too coarse"; }}};
}

report::Columns<PlanTrial> trialColumns(const Plan& plan) {
    using Trial = PlanTrial;
    const auto isChosen = [&plan](const Trial& t) { return plan.chosen && &t == &plan.trials[*plan.chosen]; };
    const auto without = [](const Trial& t) {
        std::vector<std::string> names;
        for (const Generator& generator : t.candidate.without) names.push_back(generator.name);
        return names;
    };
    const auto cost = [](const Trial& t) {
        return (t.hasWholeCost() || !std::isfinite(t.cost) ? "" : "> ") + numberText(t.cost, "{:.0f}");
    };
    const auto verdict = [](const Trial& t) { return t.isAsWritten ? "as written: " + t.verdict : t.verdict; };
    return {{"", [=](const Trial& t) { return isChosen(t) ? "*" : ""; }, In::people},
            {"method", [](const Trial& t) { return t.candidate.method; }, "method"},
            {"precision", [](const Trial& t) { return nameOf(t.candidate.precision); }, "precision"},
            {"cells", [](const Trial& t) { return t.candidate.count; }, "cells",
             [](const Trial& t) { return countText(t.candidate.count); }},
            {"as_written", &Trial::isAsWritten},
            {"without", without},
            {"step_s", &Trial::step, "h [ms]", [](const Trial& t) { return numberText(1e3 * t.step, "{:.3g}"); }},
            {"springs", &Trial::springs},
            {"was_run", &Trial::wasRun},
            {"was_stopped", &Trial::wasStopped},
            {"cost_is_lower_bound", [](const Trial& t) { return !t.hasWholeCost(); }},
            {"error_m", &Trial::error, "error", [](const Trial& t) { return lengthText(t.error); }},
            {"cost_per_frame", &Trial::cost, "cost a frame", cost},
            {"force_evaluations_per_frame", &Trial::evaluations},
            {"ms_per_frame", &Trial::milliseconds, "ms a frame",
             [](const Trial& t) { return numberText(t.milliseconds, "{:.3f}"); }},
            {"meets", &Trial::meets},
            {"chosen", isChosen},
            {"verdict", &Trial::verdict, "verdict", verdict}};
}

std::string evidenceText(const Plan& plan) {
    std::string text;
    if (!plan.generators.empty())
        text += "\nForce generators\n" + aligned(tableOf(generatorColumns(), plan.generators, In::people));
    if (!plan.resolutions.empty()) {
        const std::string order = std::isfinite(plan.order) ? fmt::format(", measured order {:.2f}", plan.order) : "";
        text += fmt::format("\nResolution: cells along the longest edge{}\n", order) +
                aligned(tableOf(resolutionColumns(), plan.resolutions, In::people));
    }
    return text + "\nCandidates (cost: " + std::string(costExplained) + "; without the start)\n" +
           aligned(tableOf(trialColumns(plan), plan.trials, In::people)) +
           (plan.alsoTried > 0
                ? fmt::format("and {} around the cheapest, which are not cheaper or err too much.\n", plan.alsoTried)
                : "");
}

std::string verificationText(const Plan& plan) {
    if (!plan.chosen) return "";
    const Verification& v = plan.verification;
    if (v.isCutShort && !v.isPassed) return "\nVerification: the effort did not suffice for it.\n";
    std::string text = fmt::format("\nVerification: a quarter of the step changes {}", lengthText(v.step));
    if (std::isfinite(v.finer))
        text += fmt::format(", that with {} cells and every generator {}", v.count, lengthText(v.finer));
    text += fmt::format("; {} within {}.\n", v.isPassed ? "both are" : "that is not", lengthText(plan.need.target));
    if (!std::isfinite(v.finer) && v.isPassed)
        text =
            fmt::format("\nVerification: a quarter of the step changes {}, within {}; there is no finer resolution.\n",
                        lengthText(v.step), lengthText(plan.need.target));
    return text;
}

std::string resultText(const Plan& plan) {
    if (!plan.chosen) return "";
    const PlanTrial& chosen = plan.trials[*plan.chosen];
    std::string text = fmt::format("\nOne evaluation of the forces takes {:.3g} us, a frame {:.3g} ms of one processor",
                                   1e6 * plan.secondsAnEvaluation, chosen.milliseconds);
    const bool isSame = plan.ratio > 0.985 && plan.ratio < 1.015;
    text += isSame                      ? std::string("; as written it costs the same.\n")
            : std::isfinite(plan.ratio) ? fmt::format("; as written it costs {:.3g} times as much.\n", plan.ratio)
                                        : std::string(".\n");
    if (plan.changes.empty()) return text + "\nThe file needs no change.\n";
    text += "\nChanges\n";
    for (const scene::Change& change : plan.changes) text += fmt::format("  {} = {}\n", change.key, change.value);
    return text;
}

const PlanTrial* nearest(const Plan& plan) {
    const PlanTrial* best = nullptr;
    for (const PlanTrial& trial : plan.trials)
        if (std::isfinite(trial.error) && (best == nullptr || trial.error < best->error)) best = &trial;
    return best;
}

}  // namespace

std::string planVerdict(const Plan& plan) {
    const std::string target = lengthText(plan.need.target);
    if (plan.isChaotic)
        return fmt::format(
            "The motion is chaotic: a start perturbed by {} deviates by {} in the first {:.3g} s, and {} is allowed. "
            "No "
            "step and no resolution predicts positions for that long. {}, allow more, or check quantities that do not "
            "depend on them, such as energy, strain, or the lowest point.",
            lengthText(plan.jitter), lengthText(plan.jitterMoves), plan.need.horizon, target,
            plan.seconds > 0 ? fmt::format("It can be predicted for {0:.3g} s: set horizon_s = {0:.3g}", plan.seconds)
                             : "Set a shorter horizon_s");
    if (!plan.chosen) {
        const PlanTrial* near = nearest(plan);
        const std::string how = plan.isCutShort ? "is not met within the effort" : "cannot be met";
        if (near == nullptr) return fmt::format("The need {}: nothing tried ran to the end.", how);
        return fmt::format("The need {}: the nearest, {} with {}, errs by {}, {:.3g} times the {} allowed.", how,
                           near->candidate.method,
                           near->candidate.count > 0 ? fmt::format("{} cells", near->candidate.count) : "its points",
                           lengthText(near->error), near->error / plan.need.target, target);
    }
    const PlanTrial& chosen = plan.trials[*plan.chosen];
    if (plan.verification.isCutShort && !plan.verification.isPassed)
        return fmt::format(
            "The need is not certainly met: the error is {}, {} is allowed, and the effort did not suffice for a "
            "verification.",
            lengthText(chosen.error), target);
    if (!plan.verification.isPassed)
        return fmt::format(
            "The need is not met: the error found is {}, but the verification finds {}, and {} is allowed.",
            lengthText(chosen.error),
            lengthText(std::max(plan.verification.step,
                                std::isfinite(plan.verification.finer) ? plan.verification.finer : 0.0)),
            target);
    if (!plan.isInBudget())
        return fmt::format(
            "The need cannot be met: the cheapest within {} takes {:.3g} ms a frame, {:.3g} times the "
            "{:.3g} ms allowed.",
            target, chosen.milliseconds, chosen.milliseconds / *plan.need.budget, *plan.need.budget);
    return fmt::format("The need is met: an error of {} where {} is allowed, for the first {:.3g} s.",
                       lengthText(chosen.error), target, plan.seconds);
}

std::string planSummary(const Plan& plan) {
    std::string text = fmt::format("{}\nNeeds an RMS error of at most {} ({}) up to {:.3g} s", plan.name,
                                   lengthText(plan.need.target), plan.need.stated, plan.need.horizon);
    if (plan.need.budget) text += fmt::format(", at {:.3g} ms a frame", *plan.need.budget);
    if (plan.isChaotic) return text + ".\n\n" + planVerdict(plan) + "\n";
    text += ".\n" + evidenceText(plan) + verificationText(plan) + resultText(plan) + "\n" + planVerdict(plan) + "\n";
    for (const std::string& remark : plan.remarks) text += remark + "\n";
    return text;
}

std::string planJson(const Plan& plan, const MachineFacts& machine) {
    Json json;
    json["scene"] = plan.name;
    for (const auto& [name, value] : machine) json["machine"][name] = value;
    json["need"] = {{"target_m", plan.need.target},
                    {"stated", plan.need.stated},
                    {"horizon_s", plan.need.horizon},
                    {"budget_ms", plan.need.budget ? Json(*plan.need.budget) : Json(nullptr)}};
    json["promised_s"] = plan.seconds;
    json["run_s"] = plan.runSeconds;
    json["not_looked_at_s"] = plan.unseen();
    json["jitter_m"] = plan.jitter;
    json["jitter_moves_m"] = plan.jitterMoves;
    json["chaotic"] = plan.isChaotic;
    json["cut_short_by_effort"] = plan.isCutShort;
    json["effort_spent"] = plan.spent;
    json["met"] = plan.isMet();
    json["verdict"] = planVerdict(plan);
    json["generators"] = report::jsonOf<Json>(generatorColumns(), plan.generators);
    json["resolutions"] = report::jsonOf<Json>(resolutionColumns(), plan.resolutions);
    json["reference"] = {{"cells", plan.referenceCount},
                         {"error_m", plan.referenceError},
                         {"order", plan.order},
                         {"method", plan.referenceMethod}};
    json["cost"] = costExplained;
    json["candidates"] = report::jsonOf<Json>(trialColumns(plan), plan.trials);
    json["also_tried"] = plan.alsoTried;
    json["verification"] = {{"change_at_quarter_step_m", plan.verification.step},
                            {"change_at_twice_resolution_m", plan.verification.finer},
                            {"cells", plan.verification.count},
                            {"passed", plan.verification.isPassed}};
    json["seconds_per_force_evaluation"] = plan.secondsAnEvaluation;
    json["cost_as_written_over_planned"] = plan.ratio;
    json["changes"] = Json::array();
    for (const scene::Change& change : plan.changes)
        json["changes"].push_back({{"key", change.key}, {"value", change.value}});
    json["remarks"] = plan.remarks;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace taut::study
