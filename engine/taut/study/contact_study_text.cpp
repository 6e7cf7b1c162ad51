#include "taut/study/contact_study_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "taut/report/column.h"

namespace taut::study {
namespace {

using report::In;

constexpr double leastShown = 1e-6, mostShown = 1.0;  // errors on the axis

const report::Columns<ContactRun>& contactColumns() {
    static const report::Columns<ContactRun> all = {
        {"problem", &ContactRun::problem},           {"steps", &ContactRun::steps},
        {"detections", &ContactRun::detections},     {"value", &ContactRun::value},
        {"relative_error", &ContactRun::error},      {"crossings", &ContactRun::crossings},
        {"processor_ms", &ContactRun::milliseconds}, {"whole", &ContactRun::hasEnded}};
    return all;
}

// Calls each(problem, steps, runs) for every series of a study.
template <class Each>
void forEachSeries(const ContactStudy& study, const Each& each) {
    for (std::size_t first = 0, last = 0; first < study.runs.size(); first = last) {
        const ContactRun& run = study.runs[first];
        while (last < study.runs.size() && study.runs[last].problem == run.problem &&
               study.runs[last].steps == run.steps)
            ++last;
        const auto problem = std::ranges::find(contactProblems(), run.problem, &ContactProblem::name);
        each(*problem, run.steps, std::span(study.runs).subspan(first, last - first));
    }
}

report::Style styleOfSeries(std::size_t index) {
    using report::Mark;
    static const report::Style styles[] = {{"#d55e00", Mark::diamond, true, report::Dash::solid, 1.8, 1.2},
                                           {"#0072b2", Mark::circle, true, report::Dash::solid, 1.8, 1.0},
                                           {"#009e73", Mark::square, true, report::Dash::solid, 1.8, 0.9}};
    return styles[index % std::size(styles)];
}

report::Axis errorAxis(bool isFirst) {
    report::Axis axis{
        isFirst ? "relative error" : "", report::Scale::log, leastShown / 2, mostShown * 50, {}, isFirst, false};
    for (const auto& [at, text] : {std::pair{1e-6, "≤ 1e-6"}, {1e-4, "0.01 %"}, {1e-2, "1 %"}, {1.0, "100 %"}})
        axis.ticks.push_back({at, isFirst ? text : "", false});
    return axis;
}

}  // namespace

std::string contactCsv(const ContactStudy& study) {
    return csv(tableOf(contactColumns(), study.runs, In::csv));
}

std::string contactSummary(const ContactStudy& study) {
    report::TextTable table;
    table.columns = {"problem", "steps"};
    std::set<int> detections;
    for (const ContactRun& run : study.runs) detections.insert(run.detections);
    for (const int n : detections) table.columns.push_back(fmt::format("[%] at {}", n));
    forEachSeries(study, [&](const ContactProblem& problem, int steps, std::span<const ContactRun> runs) {
        std::vector<report::Cell> row = {problem.name, std::to_string(steps)};
        for (const int n : detections) {
            const auto run = std::ranges::find_if(runs, [&](const auto& r) { return r.detections == n; });
            row.emplace_back(run == runs.end() ? std::string("-")
                             : !run->hasEnded  ? std::string("diverged")
                                               : fmt::format("{:+.3g}", 100.0 * run->error));
        }
        table.rows.push_back(std::move(row));
    });
    return report::aligned(table);
}

std::vector<NamedChart> contactCharts(const ContactStudy& study, const std::vector<std::string>& notes) {
    report::Chart chart;
    chart.title = "Contact: error against detections and steps";
    chart.subtitle = "Detections find the pairs that may meet; impulses act in every step. A tick is 1/60 s";
    chart.columns = 3;
    chart.panelWidth = 330;
    chart.panelHeight = 280;
    chart.pngScale = 1.5;
    chart.notes = notes;
    std::size_t series = 0;
    forEachSeries(study, [&](const ContactProblem& problem, int steps, std::span<const ContactRun> runs) {
        if (chart.panels.empty() || chart.panels.back().title != problem.title) {
            series = 0;
            report::Panel& panel = chart.panels.emplace_back();
            panel.title = problem.title;
            panel.x = {.label = "detections a tick", .scale = report::Scale::log, .least = 0.8, .most = 80};
            for (const int n : {1, 2, 4, 8, 16, 32, 64})
                panel.x.ticks.push_back({static_cast<double>(n), std::to_string(n), false});
            panel.y = errorAxis(chart.panels.size() % 3 == 1);
            panel.note(0.03, 0.95, problem.about);
            panel.note(0.03, 0.87, fmt::format("fewest: {} steps a tick", steps));
        }
        report::Curve& curve = chart.panels.back().curves.emplace_back();
        curve.style = styleOfSeries(series);
        curve.title = fmt::format(
            "{} steps", series == 0 ? "fewest" : fmt::format("{} times as many", steps / problem.fewestSteps));
        for (const ContactRun& run : runs)
            if (run.hasEnded)
                curve.points.push_back(
                    {static_cast<double>(run.detections), std::clamp(std::abs(run.error), leastShown, mostShown)});
        ++series;
    });
    if (chart.panels.empty()) return {};
    return {{"detections", chart}};
}

}  // namespace taut::study
