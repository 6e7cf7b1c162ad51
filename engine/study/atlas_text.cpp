#include "taut/study/atlas_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "taut/report/table.h"

namespace taut::study {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity: a limit that is none is null.
Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double orEmpty(double value) {
    return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

std::string nameOf(Damping damping) {
    return damping == Damping::drag ? "drag" : damping == Damping::dashpot ? "dashpot" : "none";
}

// Six digits: more are not measured.
double rounded(double value) {
    return std::stod(fmt::format("{:.6g}", value));
}

std::string limitText(double limit) {
    return std::isfinite(limit) ? fmt::format("{:.4g}", limit) : "none";
}

const Boundary& nearest(const StabilityPanel& panel, double zeta) {
    return *std::min_element(panel.boundaries.begin(), panel.boundaries.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.zeta - zeta) < std::abs(b.zeta - zeta);
    });
}

const char* nameOf(ThresholdKind kind) {
    return kind == ThresholdKind::found ? "found" : kind == ThresholdKind::aboveMost ? "above" : "below";
}

// In milliseconds; 0 is none, infinite any.
std::string stepText(double step) {
    if (std::isnan(step)) return "";
    if (step == 0) return "none";
    return std::isfinite(step) ? fmt::format("{:.4g}", 1e3 * step) : "any";
}

std::string measuredText(const MethodThreshold& threshold) {
    if (threshold.kind == ThresholdKind::aboveMost) return "> " + stepText(threshold.stands);
    if (threshold.kind == ThresholdKind::belowLeast) return "< " + stepText(threshold.fails);
    return stepText(threshold.stands);
}

}  // namespace

std::string boundariesCsv(const StabilityMap& map) {
    report::Table table;
    table.columns = {"method", "damping", "zeta", "predicted_omega_h", "measured_omega_h", "gap"};
    for (const StabilityPanel& panel : map.panels)
        for (const Boundary& b : panel.boundaries)
            table.rows.push_back({panel.method, nameOf(panel.damping), rounded(b.zeta), orEmpty(b.predicted),
                                  orEmpty(b.measured), orEmpty(rounded(std::abs(b.measured - b.predicted)))});
    return report::csv(table);
}

std::string growthCsv(const StabilityMap& map) {
    report::Table table;
    table.columns = {"method", "damping", "zeta", "omega_h", "growth_per_step"};
    for (const StabilityPanel& panel : map.panels) {
        if (panel.growth.empty()) continue;
        const std::string damping = panel.isDampingAlike ? "either" : nameOf(panel.damping);
        for (int row = 0; row < map.rows; ++row)
            for (int column = 0; column < map.columns; ++column)
                table.rows.push_back({panel.method, damping, rounded(map.zetaAt(column)), rounded(map.zAt(row)),
                                      rounded(panel.growth[static_cast<std::size_t>(row * map.columns + column)])});
    }
    return report::csv(table);
}

std::string stabilityJson(const StabilityMap& map, const MachineFacts& machine) {
    Json json;
    json["title"] = "growth per step on the damped oscillator";
    for (const auto& [name, value] : machine) json["machine"][name] = value;
    json["map"] = {{"columns", map.columns},
                   {"rows", map.rows},
                   {"zeta_most", map.mostZeta},
                   {"omega_h_most", map.mostZ},
                   {"steps", map.steps}};
    json["boundary"] = {
        {"steps", limitSteps}, {"growth_that_counts", growthTolerance}, {"omega_h_most", map.mostMeasured}};
    json["methods"] = Json::array();
    for (const StabilityPanel& panel : map.panels) {
        Json boundaries = Json::array();
        for (const Boundary& b : panel.boundaries)
            boundaries.push_back(
                {{"zeta", rounded(b.zeta)}, {"predicted", finite(b.predicted)}, {"measured", finite(b.measured)}});
        json["methods"].push_back({{"method", panel.method},
                                   {"damping", nameOf(panel.damping)},
                                   {"no_limit", panel.isWithoutLimit},
                                   {"largest_gap", finite(panel.largestGap)},
                                   {"largest_gap_at_zeta", panel.gapZeta},
                                   {"boundaries", std::move(boundaries)}});
    }
    json["interrupted"] = map.isInterrupted;
    return json.dump(2) + "\n";
}

std::string stabilitySummary(const StabilityMap& map) {
    report::Table table;
    table.columns = {"method", "damping", "ζ = 0", "ζ = 0.5", "ζ = 1", "ζ = 2", "largest gap", "at ζ"};
    for (const StabilityPanel& panel : map.panels) {
        std::vector<report::Cell> row = {panel.method, nameOf(panel.damping)};
        for (const double zeta : {0.0, 0.5, 1.0, 2.0}) row.emplace_back(limitText(nearest(panel, zeta).measured));
        if (panel.isWithoutLimit) {
            row.insert(row.end(), {std::string("no limit"), std::string("")});
        } else {
            row.insert(row.end(), {panel.largestGap, panel.gapZeta});
        }
        table.rows.push_back(std::move(row));
    }
    return fmt::format(
        "Smallest ωh at which the damped oscillator is measured to grow, and the largest gap to the predicted limit\n"
        "(looked for up to ωh = {:.4g}; growth below {:.0e} a step counts as none)\n\n{}",
        map.mostMeasured, growthTolerance, report::aligned(table));
}

std::string phasePlaneCsv(const std::vector<PhasePath>& paths) {
    report::Table table;
    table.columns = {"method", "step", "x", "v_over_omega"};
    for (const PhasePath& path : paths)
        for (std::size_t n = 0; n < path.points.size(); ++n)
            table.rows.push_back({path.method, static_cast<long long>(n), path.points[n].x, path.points[n].v});
    return report::csv(table);
}

std::string thresholdsCsv(const SceneThresholds& thresholds) {
    report::Table table;
    table.columns = {"scene",   "method",       "result",           "stands_s",   "fails_s", "by_B1_s",
                     "by_B2_s", "by_lanczos_s", "by_closed_form_s", "limited_by", "runs",    "note"};
    for (const MethodThreshold& t : thresholds.methods)
        table.rows.push_back({thresholds.name, t.method, std::string(nameOf(t.kind)), t.stands, t.fails,
                              orEmpty(t.predicted.boundAnywhere), orEmpty(t.predicted.boundHere),
                              orEmpty(t.predicted.lanczos), orEmpty(t.predicted.closedForm), t.limitedBy,
                              static_cast<long long>(t.runs), t.note});
    return report::csv(table);
}

std::string thresholdsJson(const SceneThresholds& thresholds, const MachineFacts& machine) {
    Json json;
    json["scene"] = thresholds.name;
    json["title"] = thresholds.title;
    for (const auto& [name, value] : machine) json["machine"][name] = value;
    json["simulated_s"] = thresholds.seconds;
    json["longest_step_s"] = thresholds.mostStep;
    json["criterion"] = thresholds.criterion;
    json["reference_kinetic_energy_J"] = thresholds.kinetic;
    json["kinetic_energy_allowed_J"] = thresholds.allowance;
    json["islands"] = Json::array();
    for (const IslandFrequencies& i : thresholds.islands)
        json["islands"].push_back({{"name", i.name},
                                   {"bodies", i.bodies},
                                   {"points", i.points},
                                   {"omega_B1_per_s", i.boundAnywhere},
                                   {"omega_B2_per_s", i.boundHere},
                                   {"omega_lanczos_per_s", i.lanczos},
                                   {"omega_closed_form_per_s", finite(i.closedForm)},
                                   {"closed_form", std::isfinite(i.closedForm) ? Json(i.formula) : Json(nullptr)},
                                   {"damping_time_s", i.mode.tau}});
    json["methods"] = Json::array();
    for (const MethodThreshold& t : thresholds.methods)
        json["methods"].push_back({{"method", t.method},
                                   {"result", nameOf(t.kind)},
                                   {"stands_s", t.stands > 0 ? Json(t.stands) : Json(nullptr)},
                                   {"fails_s", t.fails > 0 ? Json(t.fails) : Json(nullptr)},
                                   {"has_predicted_limit", std::isfinite(t.predicted.lanczos)},
                                   {"by_B1_s", finite(t.predicted.boundAnywhere)},
                                   {"by_B2_s", finite(t.predicted.boundHere)},
                                   {"by_lanczos_s", finite(t.predicted.lanczos)},
                                   {"by_closed_form_s", finite(t.predicted.closedForm)},
                                   {"limited_by", t.limitedBy},
                                   {"runs", t.runs},
                                   {"note", t.note}});
    json["interrupted"] = thresholds.isInterrupted;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string thresholdsSummary(const SceneThresholds& thresholds) {
    report::Table islands, methods;
    islands.columns = {"island", "points", "B1 [1/s]", "B2 [1/s]", "Lanczos [1/s]", "closed form [1/s]"};
    std::string formulas;
    for (const IslandFrequencies& i : thresholds.islands) {
        islands.rows.push_back(
            {i.name, static_cast<long long>(i.points), i.boundAnywhere, i.boundHere, i.lanczos, i.closedForm});
        if (std::isfinite(i.closedForm)) formulas += fmt::format("closed form of {}: {}\n", i.name, i.formula);
    }
    methods.columns = {"method",     "measured [ms]",  "by B1",      "by B2",
                       "by Lanczos", "by closed form", "limited by", "runs"};
    std::string notes;
    for (const MethodThreshold& t : thresholds.methods) {
        methods.rows.push_back({t.method, measuredText(t), stepText(t.predicted.boundAnywhere),
                                stepText(t.predicted.boundHere), stepText(t.predicted.lanczos),
                                stepText(t.predicted.closedForm), t.limitedBy, static_cast<long long>(t.runs)});
        if (!t.note.empty()) notes += fmt::format("{}: {}\n", t.title, t.note);
    }
    return fmt::format(
        "{}\n\nHighest frequencies as the scene starts; B1 and B2 are bounds\n\n{}{}\nLargest steps [ms]: "
        "{}\n\n{}{}{}",
        thresholds.title, report::aligned(islands), formulas, thresholds.criterion, report::aligned(methods),
        notes.empty() ? "" : "\n", notes);
}

}  // namespace taut::study
