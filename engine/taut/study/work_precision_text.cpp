#include "taut/study/work_precision_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "taut/report/column.h"

namespace taut::study {
namespace {

using Json = nlohmann::ordered_json;
using report::Cell;
using report::In;

// The errors' columns carry their unit.
report::Columns<RunPoint> runColumns(const WorkPrecision& study) {
    const std::string unit = study.unit.empty() ? "" : "_" + study.unit;
    return {{"problem", [&study](const RunPoint&) { return study.name; }, In::csv},
            {"method", &RunPoint::method},
            {"precision", [](const RunPoint& p) { return nameOf(p.precision); }},
            {"step_s", &RunPoint::step},
            {"steps", &RunPoint::steps},
            {"status", [](const RunPoint& p) { return nameOf(p.status); }},
            {"rms_error" + unit, &RunPoint::rmsError},
            {"final_error" + unit, &RunPoint::finalError},
            {"max_error" + unit, &RunPoint::maxError},
            {"at_floor", &RunPoint::isAtFloor},
            {"energy_error", &RunPoint::energyError},
            {"energy_at_floor", &RunPoint::isEnergyAtFloor},
            {"beyond_mean_energy_error", &RunPoint::meanEnergyError},
            {"beyond_extent_error_m", &RunPoint::extentError},
            {"beyond_height_error_m", &RunPoint::heightError},
            {"evaluations", &RunPoint::evaluations},
            {"iterations", &RunPoint::iterations},
            {"unconverged", &RunPoint::unconverged},
            {"run_s", &RunPoint::seconds},
            {"run_quarter_s", &RunPoint::fastSeconds},
            {"run_three_quarters_s", &RunPoint::slowSeconds},
            {"repeats", &RunPoint::repeats},
            {"simulated_s", [&study](const RunPoint&) { return study.grid.duration(); }, In::csv}};
}

report::Columns<MethodFacts> methodColumns(const WorkPrecision& study) {
    const auto order = [&study](Precision precision) {
        return [&study, precision](const MethodFacts& m) { return measuredOrder(study, m.name, precision); };
    };
    return {{"name", &MethodFacts::name},
            {"order", &MethodFacts::order},
            {"step_limit_s", &MethodFacts::stepLimit},
            {"measured_order_single", order(Precision::single_)},
            {"measured_order_double", order(Precision::double_)}};
}

report::Columns<StepsRow> stepsColumns() {
    return {{"method", &StepsRow::method, "method"},
            {"tolerance", &StepsRow::tolerance},
            {"steps", &StepsRow::steps, "steps to 1e-6"},
            {"evaluations", &StepsRow::evaluations, "evaluations"},
            {"error", &StepsRow::error, "error"},
            {"steps_with_four_evaluations", &StepsRow::stepsForFour, "steps with 4 evaluations"},
            {"error_with_four_evaluations", &StepsRow::errorForFour, "error then"}};
}

// The cheapest run of a curve whose error is below a bound; nullptr when there is none.
const RunPoint* cheapest(const WorkPrecision& study, const std::string& method, Precision precision, double error) {
    const RunPoint* best = nullptr;
    for (const RunPoint& p : study.points)
        if (p.method == method && p.precision == precision && p.status == RunStatus::ok && p.rmsError <= error &&
            (best == nullptr || p.seconds < best->seconds))
            best = &p;
    return best;
}

std::string largestStepText(double limit) {
    return limit == 0 ? "none" : std::isfinite(limit) ? fmt::format("{:.3g}", 1e3 * limit) : "any";
}

}  // namespace

std::string workPrecisionCsv(const WorkPrecision& study) {
    return csv(tableOf(runColumns(study), study.points, In::csv));
}

std::string workPrecisionJson(const WorkPrecision& study, const std::vector<StepsRow>& steps,
                              const MachineFacts& machine) {
    Json json;
    json["problem"] = study.name;
    json["title"] = study.title;
    for (const auto& [name, value] : machine) json["machine"][name] = value;
    json["simulated_s"] = study.grid.duration();
    json["samples"] = study.grid.samples;
    json["sample_spacing_s"] = study.grid.spacing;
    json["samples_within_horizon"] = study.window;
    json["horizon"] = {{"perturbation_m", perturbation},
                       {"growth_that_ends_it", horizonGrowth},
                       {"is_reached", study.horizon.isReached},
                       {"seconds", study.horizon.seconds},
                       {"largest_growth", study.horizon.growth}};
    json["reference"] = {{"kind", study.reference.isExact        ? "exact"
                                  : study.reference.isControlled ? "fehlberg 7(8) at two tolerances"
                                                                 : "rk4 at two steps"},
                         {"method", methodOf(study.reference, study.unit)},
                         {"tolerance_per_s", study.reference.tolerance},
                         {"step_s", study.reference.step},
                         {"rms_difference", study.reference.difference},
                         {"rms_error", study.reference.error},
                         {"floor", study.reference.floor},
                         {"extent", study.reference.extent},
                         {"largest_kinetic_energy_J", study.reference.kinetic}};
    json["methods"] = report::jsonOf<Json>(methodColumns(study), study.methods);
    json["frame_s"] = study.frame;
    json["contacts"] = study.hasContacts;
    json["remarks"] = study.remarks;
    if (!steps.empty()) json["steps_table"] = report::jsonOf<Json>(stepsColumns(), steps);
    json["runs"] = report::jsonOf<Json>(runColumns(study), study.points);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string workPrecisionSummary(const WorkPrecision& study) {
    report::TextTable table;
    table.columns = {"method",      "precision",         "limit [ms]",          "order", "smallest error",
                     "with h [ms]", "[ms/s] within 1 %", "[ms/s] within 0.1 %", "failed"};
    const double duration = study.grid.duration();
    // Wall time for a second of motion, with three digits: it is not measured better.
    const auto cost = [&](double error, const MethodFacts& method, Precision precision) -> Cell {
        const RunPoint* p = cheapest(study, method.name, precision, error);
        if (p == nullptr) return RunPoint::unset;
        const double value = std::stod(fmt::format("{:.3g}", 1e3 * p->seconds / duration));
        return value < 1000 ? Cell(value) : Cell(std::llround(value));
    };
    for (const MethodFacts& method : study.methods)
        for (const Precision precision : {Precision::single_, Precision::double_}) {
            const RunPoint* best = nullptr;
            long long failed = 0, all = 0;
            for (const RunPoint& p : study.points) {
                if (p.method != method.name || p.precision != precision) continue;
                ++all;
                if (p.status != RunStatus::ok)
                    ++failed;
                else if (best == nullptr || p.rmsError < best->rmsError)
                    best = &p;
            }
            if (all == 0) continue;
            const double extent = study.reference.extent;
            table.rows.push_back(
                {method.name, std::string(nameOf(precision)), largestStepText(method.stepLimit),
                 measuredOrder(study, method.name, precision), best == nullptr ? RunPoint::unset : best->rmsError,
                 best == nullptr ? RunPoint::unset : 1e3 * best->step, cost(1e-2 * extent, method, precision),
                 cost(1e-3 * extent, method, precision), failed});
        }
    return report::aligned(table);
}

std::string stepsSummary(const std::vector<StepsRow>& rows) {
    return aligned(tableOf(stepsColumns(), rows, In::people));
}

}  // namespace taut::study
