#include "taut/study/plan_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "taut/report/table.h"

namespace taut::study {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity.
Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string numberText(double value, const char* format) {
    return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "-";
}

std::string countText(int count) {
    return count > 0 ? std::to_string(count) : "as written";
}

std::string generatorTable(const Plan& plan) {
    if (plan.generators.empty()) return "";
    report::Table table;
    table.columns = {"without", "changes", "verdict"};
    for (const GeneratorTrial& trial : plan.generators)
        table.rows.push_back(
            {trial.name, std::isfinite(trial.change) ? lengthText(trial.change) : "diverges", trial.verdict});
    return "\nForce generators\n" + report::aligned(table);
}

std::string resolutionTable(const Plan& plan) {
    if (plan.resolutions.empty()) return "";
    report::Table table;
    table.columns = {"cells", "springs", "error", "verdict"};
    for (const ResolutionTrial& trial : plan.resolutions)
        table.rows.push_back({static_cast<long long>(trial.count), static_cast<long long>(trial.springs),
                              lengthText(trial.error), std::string(trial.isEnough ? "enough" : "too coarse")});
    const std::string order =
        std::isfinite(plan.order) ? fmt::format(", measured order {:.2f}", plan.order) : std::string();
    return fmt::format("\nResolution: cells along the longest edge{}\n", order) + report::aligned(table);
}

std::string trialTable(const Plan& plan) {
    report::Table table;
    table.columns = {"",           "method", "precision", "cells", "h [ms]", "error", "spring evals a frame",
                     "ms a frame", "verdict"};
    for (std::size_t i = 0; i < plan.trials.size(); ++i) {
        const PlanTrial& trial = plan.trials[i];
        const std::string bound = trial.hasWholeCost() ? "" : "> ";
        table.rows.push_back({std::string(plan.chosen == i ? "*" : ""), trial.candidate.method,
                              std::string(nameOf(trial.candidate.precision)), countText(trial.candidate.count),
                              numberText(1e3 * trial.step, "{:.3g}"), lengthText(trial.error),
                              std::isfinite(trial.cost) ? bound + fmt::format("{:.0f}", trial.cost) : "-",
                              numberText(trial.milliseconds, "{:.3f}"),
                              trial.isAsWritten ? "as written: " + trial.verdict : trial.verdict});
    }
    return "\nCandidates (evaluations of a long run: those of the start alone are left out)\n" + report::aligned(table);
}

std::string verificationText(const Plan& plan) {
    if (!plan.chosen) return "";
    const Verification& v = plan.verification;
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
    text += isSame ? std::string("; as written it costs as many spring evaluations.\n")
            : std::isfinite(plan.ratio)
                ? fmt::format("; as written it costs {:.3g} times as many spring evaluations.\n", plan.ratio)
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

Json trialJson(const PlanTrial& trial, bool isChosen) {
    Json without = Json::array();
    for (const Generator& generator : trial.candidate.without) without.push_back(generator.name);
    return {{"method", trial.candidate.method},
            {"precision", nameOf(trial.candidate.precision)},
            {"cells", trial.candidate.count},
            {"as_written", trial.isAsWritten},
            {"without", without},
            {"step_s", finite(trial.step)},
            {"springs", trial.springs},
            {"was_run", trial.wasRun},
            {"was_stopped", trial.wasStopped},
            {"cost_is_lower_bound", !trial.hasWholeCost()},
            {"error_m", finite(trial.error)},
            {"spring_evaluations_per_frame", finite(trial.cost)},
            {"force_evaluations_per_frame", finite(trial.evaluations)},
            {"ms_per_frame", finite(trial.milliseconds)},
            {"meets", trial.meets},
            {"chosen", isChosen},
            {"verdict", trial.verdict}};
}

}  // namespace

std::string planVerdict(const Plan& plan) {
    const std::string target = lengthText(plan.need.target);
    if (!plan.chosen) {
        const PlanTrial* near = nearest(plan);
        if (near == nullptr) return fmt::format("The need cannot be met: nothing tried ran to the end.");
        return fmt::format("The need cannot be met: the nearest, {} with {}, errs by {}, {:.3g} times the {} allowed.",
                           near->candidate.method,
                           near->candidate.count > 0 ? fmt::format("{} cells", near->candidate.count) : "its points",
                           lengthText(near->error), near->error / plan.need.target, target);
    }
    const PlanTrial& chosen = plan.trials[*plan.chosen];
    if (!plan.verification.isPassed)
        return fmt::format(
            "The need is not met: what was found errs by {}, but the verification finds {} where {} is "
            "allowed.",
            lengthText(chosen.error),
            lengthText(std::max(plan.verification.step,
                                std::isfinite(plan.verification.finer) ? plan.verification.finer : 0.0)),
            target);
    if (!plan.isInBudget())
        return fmt::format(
            "The need cannot be met: the cheapest within {} takes {:.3g} ms a frame, {:.3g} times the "
            "{:.3g} ms allowed.",
            target, chosen.milliseconds, chosen.milliseconds / *plan.need.budget, *plan.need.budget);
    if (plan.isChaotic)
        return fmt::format(
            "The need is met for the first {:.3g} s of the {:.3g} s asked for only: an error of {} where "
            "{} is allowed.",
            plan.seconds, plan.need.horizon, lengthText(chosen.error), target);
    return fmt::format("The need is met: an error of {} where {} is allowed, for the first {:.3g} s.",
                       lengthText(chosen.error), target, plan.seconds);
}

std::string planSummary(const Plan& plan) {
    std::string text = fmt::format("{}\nNeeds an RMS error of at most {} ({}) up to {:.3g} s", plan.name,
                                   lengthText(plan.need.target), plan.need.stated, plan.need.horizon);
    if (plan.need.budget) text += fmt::format(", at {:.3g} ms a frame", *plan.need.budget);
    text += ".\n" + generatorTable(plan) + resolutionTable(plan) + trialTable(plan) + verificationText(plan) +
            resultText(plan) + "\n" + planVerdict(plan) + "\n";
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
    json["perturbation_m"] = plan.perturbation;
    json["chaotic"] = plan.isChaotic;
    json["met"] = plan.isMet();
    json["verdict"] = planVerdict(plan);
    json["generators"] = Json::array();
    for (const GeneratorTrial& trial : plan.generators)
        json["generators"].push_back({{"name", trial.name},
                                      {"change_m", finite(trial.change)},
                                      {"left_out", trial.isLeftOut},
                                      {"verdict", trial.verdict}});
    json["resolutions"] = Json::array();
    for (const ResolutionTrial& trial : plan.resolutions)
        json["resolutions"].push_back({{"cells", trial.count},
                                       {"springs", trial.springs},
                                       {"error_m", finite(trial.error)},
                                       {"enough", trial.isEnough}});
    json["reference"] = {
        {"cells", plan.referenceCount}, {"error_m", finite(plan.referenceError)}, {"order", finite(plan.order)}};
    json["candidates"] = Json::array();
    for (std::size_t i = 0; i < plan.trials.size(); ++i)
        json["candidates"].push_back(trialJson(plan.trials[i], plan.chosen == i));
    json["verification"] = {{"change_at_quarter_step_m", finite(plan.verification.step)},
                            {"change_at_twice_resolution_m", finite(plan.verification.finer)},
                            {"cells", plan.verification.count},
                            {"passed", plan.verification.isPassed}};
    json["seconds_per_force_evaluation"] = finite(plan.secondsAnEvaluation);
    json["cost_as_written_over_planned"] = finite(plan.ratio);
    json["changes"] = Json::array();
    for (const scene::Change& change : plan.changes)
        json["changes"].push_back({{"key", change.key}, {"value", change.value}});
    json["remarks"] = plan.remarks;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace taut::study
