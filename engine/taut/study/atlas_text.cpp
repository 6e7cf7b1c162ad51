#include "taut/study/atlas_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "taut/report/column.h"

namespace taut::study {
namespace {

using Json = nlohmann::ordered_json;
using report::In;

double orEmpty(double value) {
    return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

std::string dampingName(Damping damping) {
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
    return *std::ranges::min_element(
        panel.boundaries,
        [&](const auto& a, const auto& b) { return std::abs(a.zeta - zeta) < std::abs(b.zeta - zeta); });
}

const char* resultName(ThresholdKind kind) {
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

report::Columns<IslandFrequencies> islandColumns() {
    using Island = IslandFrequencies;
    return {{"name", &Island::name, "island"},
            {"bodies", &Island::bodies},
            {"points", &Island::points, "points"},
            {"omega_B1_per_s", &Island::boundAnywhere, "B1 [1/s]"},
            {"omega_B2_per_s", &Island::boundHere, "B2 [1/s]"},
            {"omega_lanczos_per_s", &Island::lanczos, "Lanczos [1/s]"},
            {"omega_closed_form_per_s", &Island::closedForm, "closed form [1/s]"},
            {"closed_form",
             [](const Island& i) { return std::isfinite(i.closedForm) ? report::Cell(i.formula) : i.closedForm; }},
            {"damping_time_s", [](const Island& i) { return i.mode.tau; }}};
}

// A step that no run has shown is 0 in CSV, and null in JSON.
report::Columns<MethodThreshold> thresholdColumns(const SceneThresholds& thresholds) {
    using Threshold = MethodThreshold;
    using Column = report::Column<Threshold>;
    const auto orNone = [](double Threshold::*step) {
        return [step](const Threshold& t) { return t.*step > 0 ? t.*step : std::numeric_limits<double>::quiet_NaN(); };
    };
    const auto predicted = [](const char* name, double PredictedSteps::*step, const char* heading) {
        return Column(
            name, [step](const Threshold& t) { return orEmpty(t.predicted.*step); }, heading,
            [step](const Threshold& t) { return stepText(t.predicted.*step); });
    };
    return {{"scene", [&thresholds](const Threshold&) { return thresholds.name; }, In::csv},
            {"method", &Threshold::method, "method"},
            {"result", [](const Threshold& t) { return resultName(t.kind); }, "measured [ms]", measuredText},
            {"stands_s", &Threshold::stands, In::csv},
            {"stands_s", orNone(&Threshold::stands), In::json},
            {"fails_s", &Threshold::fails, In::csv},
            {"fails_s", orNone(&Threshold::fails), In::json},
            {"has_predicted_limit", [](const Threshold& t) { return std::isfinite(t.predicted.lanczos); }, In::json},
            predicted("by_B1_s", &PredictedSteps::boundAnywhere, "by B1"),
            predicted("by_B2_s", &PredictedSteps::boundHere, "by B2"),
            predicted("by_lanczos_s", &PredictedSteps::lanczos, "by Lanczos"),
            predicted("by_closed_form_s", &PredictedSteps::closedForm, "by closed form"),
            {"limited_by", &Threshold::limitedBy, "limited by"},
            {"runs", &Threshold::runs, "runs"},
            {"note", &Threshold::note}};
}

}  // namespace

std::string boundariesCsv(const StabilityMap& map) {
    report::TextTable table;
    table.columns = {"method", "damping", "zeta", "predicted_omega_h", "measured_omega_h", "gap"};
    for (const StabilityPanel& panel : map.panels)
        for (const Boundary& b : panel.boundaries)
            table.rows.push_back({panel.method, dampingName(panel.damping), rounded(b.zeta), orEmpty(b.predicted),
                                  orEmpty(b.measured), orEmpty(rounded(std::abs(b.measured - b.predicted)))});
    return report::csv(table);
}

std::string growthCsv(const StabilityMap& map) {
    report::TextTable table;
    table.columns = {"method", "damping", "zeta", "omega_h", "growth_per_step"};
    for (const StabilityPanel& panel : map.panels) {
        if (panel.growth.empty()) continue;
        const std::string damping = panel.isDampingAlike ? "either" : dampingName(panel.damping);
        for (int row = 0; row < map.rows; ++row)
            for (int column = 0; column < map.columns; ++column)
                table.rows.push_back({panel.method, damping, rounded(map.zetaAt(column)), rounded(map.zAt(row)),
                                      rounded(panel.growth[row * map.columns + column])});
    }
    return report::csv(table);
}

std::string stabilitySummary(const StabilityMap& map) {
    report::TextTable table;
    table.columns = {"method", "damping", "ζ = 0", "ζ = 0.5", "ζ = 1", "ζ = 2", "largest gap", "at ζ"};
    for (const StabilityPanel& panel : map.panels) {
        std::vector<report::Cell> row = {panel.method, dampingName(panel.damping)};
        for (const double zeta : {0.0, 0.5, 1.0, 2.0}) row.emplace_back(limitText(nearest(panel, zeta).measured));
        if (panel.isWithoutLimit)
            row.insert(row.end(), {std::string("no limit"), std::string("")});
        else
            row.insert(row.end(), {panel.largestGap, panel.gapZeta});
        table.rows.push_back(std::move(row));
    }
    return fmt::format(
        "Smallest ωh at which the damped oscillator is measured to grow, and the largest gap to the predicted limit\n"
        "(looked for up to ωh = {:.4g}; growth below {:.0e} a step counts as none)\n\n{}",
        map.mostMeasured, growthTolerance, report::aligned(table));
}

std::string phasePlaneCsv(const std::vector<PhasePath>& paths) {
    report::TextTable table;
    table.columns = {"method", "step", "x", "v_over_omega"};
    for (const PhasePath& path : paths)
        for (std::size_t n = 0; n < path.points.size(); ++n)
            table.rows.push_back({path.method, static_cast<long long>(n), path.points[n].x, path.points[n].v});
    return report::csv(table);
}

std::string thresholdsCsv(const SceneThresholds& thresholds) {
    return csv(tableOf(thresholdColumns(thresholds), thresholds.methods, In::csv));
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
    json["islands"] = report::jsonOf<Json>(islandColumns(), thresholds.islands);
    json["methods"] = report::jsonOf<Json>(thresholdColumns(thresholds), thresholds.methods);
    json["interrupted"] = thresholds.isInterrupted;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string thresholdsSummary(const SceneThresholds& thresholds) {
    std::string formulas, notes;
    for (const IslandFrequencies& i : thresholds.islands)
        if (std::isfinite(i.closedForm)) formulas += fmt::format("closed form of {}: {}\n", i.name, i.formula);
    for (const MethodThreshold& t : thresholds.methods)
        if (!t.note.empty()) notes += fmt::format("{}: {}\n", t.title, t.note);
    return fmt::format(
        "{}\n\nHighest frequencies as the scene starts; B1 and B2 are bounds\n\n{}{}\nLargest steps [ms]: "
        "{}\n\n{}{}{}",
        thresholds.title, aligned(tableOf(islandColumns(), thresholds.islands, In::people)), formulas,
        thresholds.criterion, aligned(tableOf(thresholdColumns(thresholds), thresholds.methods, In::people)),
        notes.empty() ? "" : "\n", notes);
}

}  // namespace taut::study
