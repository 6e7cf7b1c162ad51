#include "taut/study/work_precision_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "taut/report/table.h"

namespace taut::study {
namespace {

using Json = nlohmann::ordered_json;
using report::Cell;

// JSON has no infinity: a limit that is none is null.
Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// The errors' columns carry their unit, in both files.
std::string errorName(const char* name, const WorkPrecision& study) {
    return study.unit.empty() ? name : std::string(name) + "_" + study.unit;
}

Json pointJson(const WorkPrecision& study, const RunPoint& p) {
    return {{"method", p.method},
            {"precision", nameOf(p.precision)},
            {"step_s", p.step},
            {"steps", p.steps},
            {"status", nameOf(p.status)},
            {errorName("rms_error", study), finite(p.rmsError)},
            {errorName("final_error", study), finite(p.finalError)},
            {errorName("max_error", study), finite(p.maxError)},
            {"at_reference_floor", p.isAtFloor},
            {"energy_error", finite(p.energyError)},
            {"energy_at_reference_floor", p.isEnergyAtFloor},
            {"beyond_mean_energy_error", finite(p.meanEnergyError)},
            {"beyond_extent_error_m", finite(p.extentError)},
            {"beyond_height_error_m", finite(p.heightError)},
            {"evaluations", p.evaluations},
            {"iterations", p.iterations},
            {"unconverged", p.unconverged},
            {"run_s", finite(p.seconds)},
            {"run_quarter_s", finite(p.fastSeconds)},
            {"run_three_quarters_s", finite(p.slowSeconds)},
            {"repeats", p.repeats}};
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

std::string limitText(double limit) {
    return limit == 0 ? "none" : std::isfinite(limit) ? fmt::format("{:.3g}", 1e3 * limit) : "any";
}

}  // namespace

std::string workPrecisionCsv(const WorkPrecision& study) {
    report::Table table;
    table.columns = {"problem",
                     "method",
                     "precision",
                     "step_s",
                     "steps",
                     "status",
                     errorName("rms_error", study),
                     errorName("final_error", study),
                     errorName("max_error", study),
                     "at_reference_floor",
                     "energy_error",
                     "energy_at_reference_floor",
                     "beyond_mean_energy_error",
                     "beyond_extent_error_m",
                     "beyond_height_error_m",
                     "evaluations",
                     "iterations",
                     "unconverged",
                     "run_s",
                     "run_quarter_s",
                     "run_three_quarters_s",
                     "repeats",
                     "simulated_s"};
    for (const RunPoint& p : study.points)
        table.rows.push_back({study.name,
                              p.method,
                              std::string(nameOf(p.precision)),
                              p.step,
                              p.steps,
                              std::string(nameOf(p.status)),
                              p.rmsError,
                              p.finalError,
                              p.maxError,
                              static_cast<long long>(p.isAtFloor),
                              p.energyError,
                              static_cast<long long>(p.isEnergyAtFloor),
                              p.meanEnergyError,
                              p.extentError,
                              p.heightError,
                              static_cast<long long>(p.evaluations),
                              static_cast<long long>(p.iterations),
                              static_cast<long long>(p.unconverged),
                              p.seconds,
                              p.fastSeconds,
                              p.slowSeconds,
                              static_cast<long long>(p.repeats),
                              study.grid.duration()});
    return report::csv(table);
}

std::string workPrecisionJson(const WorkPrecision& study, const std::vector<GrowthRow>& growth,
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
                       {"largest_growth", finite(study.horizon.growth)}};
    json["reference"] = {{"kind", study.reference.isExact ? "exact" : "rk4 at two steps"},
                         {"step_s", study.reference.step},
                         {"rms_difference", study.reference.difference},
                         {"floor", study.reference.floor},
                         {"extent", study.reference.extent},
                         {"largest_kinetic_energy_J", study.reference.kinetic}};
    for (const MethodFacts& method : study.methods) {
        Json row = {{"name", method.name}, {"order", method.order}, {"step_limit_s", finite(method.stepLimit)}};
        for (const Precision precision : {Precision::single_, Precision::double_})
            row["measured_order_" + std::string(nameOf(precision))] =
                finite(measuredOrder(study, method.name, precision));
        json["methods"].push_back(std::move(row));
    }
    json["contacts"] = study.hasContacts;
    json["remarks"] = study.remarks;
    for (const GrowthRow& row : growth)
        json["growth_table"].push_back({{"method", row.method},
                                        {"tolerance", row.tolerance},
                                        {"steps", row.steps},
                                        {"evaluations", row.evaluations},
                                        {"error", row.error},
                                        {"steps_with_four_evaluations", row.stepsForFour},
                                        {"error_with_four_evaluations", row.errorForFour}});
    json["runs"] = Json::array();
    for (const RunPoint& point : study.points) json["runs"].push_back(pointJson(study, point));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string workPrecisionSummary(const WorkPrecision& study) {
    report::Table table;
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
                {method.name, std::string(nameOf(precision)), limitText(method.stepLimit),
                 measuredOrder(study, method.name, precision), best == nullptr ? RunPoint::unset : best->rmsError,
                 best == nullptr ? RunPoint::unset : 1e3 * best->step, cost(1e-2 * extent, method, precision),
                 cost(1e-3 * extent, method, precision), failed});
        }
    return report::aligned(table);
}

std::string growthSummary(const std::vector<GrowthRow>& rows) {
    report::Table table;
    table.columns = {"method", "steps to 1e-6", "evaluations", "error", "steps with 4 evaluations", "error then"};
    for (const GrowthRow& row : rows)
        table.rows.push_back({row.method, row.steps, row.evaluations, row.error,
                              static_cast<long long>(row.stepsForFour), row.errorForFour});
    return report::aligned(table);
}

}  // namespace taut::study
