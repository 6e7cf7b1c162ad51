#include "taut/study/refinement_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace taut::study {
namespace {

using report::Panel;
using report::Scale;

constexpr double leastError = 1e-5, mostError = 1.0;  // of the axis

struct Extremes {
    double least = HUGE_VAL, most = -HUGE_VAL;
    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

Extremes cellsOf(const RefinementStudy& study) {
    Extremes cells;
    for (const RefinementRun& run : study.runs) cells.add(run.cells);
    return cells;
}

report::Axis cellsAxis(const RefinementStudy& study) {
    report::Axis axis;
    const Extremes cells = cellsOf(study);
    axis.label = "cells along the longest side";
    axis.scale = Scale::log;
    axis.least = cells.least / 1.3;
    axis.most = cells.most * 1.3;
    std::set<int> all;
    for (const RefinementRun& run : study.runs) all.insert(run.cells);
    for (const int n : all) axis.ticks.push_back({static_cast<double>(n), std::to_string(n), false});
    return axis;
}

// Told apart where one lies on another: the builders' own below, wide; crosses and small squares above.
report::Style styleOfTreatment(std::size_t index) {
    using report::Dash;
    using report::Mark;
    static const report::Style styles[] = {{"#009e73", Mark::circle, true, Dash::solid, 3.0, 1.3},
                                           {"#d55e00", Mark::diamond, false, Dash::dashed, 1.6, 1.5},
                                           {"#0072b2", Mark::cross, true, Dash::dashed, 1.6, 1.3},
                                           {"#101010", Mark::square, true, Dash::dotted, 1.6, 0.7}};
    return styles[index % std::size(styles)];
}

// One curve a treatment. Runs that did not come to rest are left out.
template <class Value>
void addCurves(Panel& panel, const RefinementStudy& study, const std::string& body, Value value) {
    for (std::size_t i = 0; i < treatments().size(); ++i) {
        report::Curve curve;
        curve.title = treatments()[i].title;
        curve.style = styleOfTreatment(i);
        for (const RefinementRun& run : study.runs)
            if (run.body == body && run.treatment == treatments()[i].name && run.isAtRest)
                curve.points.push_back({static_cast<double>(run.cells), value(run)});
        if (!curve.points.empty()) panel.curves.push_back(curve);
    }
}

// "order 2.0 weighted, 0.9 naive mass", as far as they were found.
std::string ordersText(const RefinementStudy& study, const RefinementBody& body) {
    const double own = measuredOrder(study, body.name, treatments().front().name);
    const double naive =
        measuredOrder(study, body.name, body.hasEdgeSprings ? treatments().back().name : treatments()[1].name);
    if (std::isnan(own)) return "";
    return "order " + fmt::format("{:.1f}", own) + " weighted" +
           (std::isnan(naive) ? "" : ", " + fmt::format("{:.1f}", naive) + " naive");
}

// "errors below 1e-10": the power of ten above the largest.
std::string boundText(const RefinementFacts& facts) {
    double most = 0;
    for (const double error : facts.strongest) most = std::fmax(most, error);
    return most > 0 ? "errors below " + fmt::format("{:.0e}", std::pow(10, std::ceil(std::log10(most)))) : "no error";
}

// A line of slope -p through (x, y), to compare with.
void addSlope(Panel& panel, const Extremes& cells, int p, double y) {
    report::Curve line;
    line.style = {"#b0b0b0", report::Mark::none, true, report::Dash::dotted, 1.4, 1.0};
    for (const double x : {cells.least, cells.most}) line.points.push_back({x, y * std::pow(x / cells.least, -p)});
    panel.curves.push_back(line);
    panel.labels.push_back(
        {cells.most, line.points.back().y, "order " + std::to_string(p), "#808080", report::Align::right, 0, 15, 10.5});
}

Panel errorPanel(const RefinementStudy& study, const RefinementFacts& facts, bool isFirst) {
    Panel panel;
    const RefinementBody& body = *facts.body;
    panel.title = body.title;
    panel.x = cellsAxis(study);
    panel.y = {isFirst ? "relative error" : "", Scale::log, leastError, mostError, {}, isFirst, false};
    for (const auto& [at, text] :
         {std::pair{1e-5, "0.001 %"}, {1e-4, "0.01 %"}, {1e-3, "0.1 %"}, {1e-2, "1 %"}, {1e-1, "10 %"}, {1.0, "100 %"}})
        panel.y.ticks.push_back({at, isFirst ? text : "", false});
    panel.regions.push_back({.y1 = 0.01, .colour = "#009e73"});
    const bool isExact = !(*std::ranges::max_element(facts.strongest, [](double a, double b) {
        return a < b || std::isnan(a);
    }) > refinementFloor);
    const Extremes cells = cellsOf(study);
    if (!isExact) {
        addSlope(panel, cells, 1, 0.6);
        addSlope(panel, cells, 2, 0.007);
    }
    // Errors decades below the axis are written, not drawn.
    if (isExact)
        panel.labels.push_back({0.5, 0.5, "exact with every treatment: " + boundText(facts), "#303030",
                                report::Align::centre, 0, 0, 11, true, true});
    else
        addCurves(panel, study, body.name, [&](const RefinementRun& run) { return std::abs(run.error); });
    panel.note(0.03, 0.05, body.quantity + ": " + body.theory);
    const std::string orders = ordersText(study, body);
    if (!orders.empty()) panel.note(0.97, 0.95, orders, report::Align::right);
    return panel;
}

Panel drapePanel(const RefinementStudy& study, const RefinementFacts& facts, bool isFirst) {
    Panel panel;
    const RefinementBody& body = *facts.body;
    panel.title = body.title;
    panel.x = cellsAxis(study);
    panel.y.label = isFirst ? "difference from the limit [%]" : "";
    Extremes percent;
    for (const RefinementRun& run : study.runs)
        if (run.body == body.name) percent.add(100.0 * run.error);
    const double room = 0.12 * (percent.most - percent.least);
    panel.y.least = percent.least - room;
    panel.y.most = percent.most + room;
    panel.regions.push_back({.y0 = -1.0, .y1 = 1.0, .colour = "#009e73", .opacity = 0.16});
    addCurves(panel, study, body.name, [](const RefinementRun& run) { return 100.0 * run.error; });
    panel.note(0.97, 0.05, body.quantity + ", limit " + fmt::format("{:.4g} mm", 1e3 * facts.reference),
               report::Align::right);
    const std::string orders = ordersText(study, body);
    if (!orders.empty()) panel.note(0.97, 0.13, orders, report::Align::right);
    return panel;
}

}  // namespace

std::vector<NamedChart> refinementCharts(const RefinementStudy& study, const std::vector<std::string>& notes) {
    report::Chart error, drape;
    error.title = "Finer ropes, cloths and blocks against theory";
    error.subtitle =
        "Bodies at rest under gravity: error of their sag or stretch against the number of cells; tinted: within 1 %";
    drape.title = "The drape of ever finer bodies";
    drape.subtitle = "Sag or stretch at rest, as a difference from its limit; the band is 1 % wide to either side";
    error.columns = drape.columns = 3;
    for (const RefinementFacts& facts : study.bodies) {
        report::Chart& chart = facts.body->exact ? error : drape;
        const bool isFirst = chart.panels.size() % 3 == 0;
        chart.panels.push_back(facts.body->exact ? errorPanel(study, facts, isFirst)
                                                 : drapePanel(study, facts, isFirst));
    }
    std::vector<NamedChart> charts;
    for (auto& [name, chart] : {std::pair{"error", &error}, {"drape", &drape}}) {
        if (chart->panels.empty()) continue;
        chart->panelWidth = 330;
        chart->panelHeight = 280;
        chart->pngScale = 1.5;
        chart->notes = {
            "Naive mass: every point weighs the same. Naive springs: those at the edge are as stiff as the others."};
        chart->notes.insert(chart->notes.end(), notes.begin(), notes.end());
        charts.push_back({name, *chart});
    }
    return charts;
}

}  // namespace taut::study
