#include "taut/study/work_precision_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "taut/report/palette.h"

namespace taut::study {
namespace {

using report::Chart;
using report::Panel;
using report::Scale;

std::string number(double value) {
    return fmt::format("{:.3g}", value);
}

// The quantities on the axes of a chart.
struct Quantities {
    std::function<double(const RunPoint&)> x, y;
    std::string xLabel, yLabel;
    bool hasTimes = false;  // x is a wall time: with spread, and the frame budget drawn
    bool hasSteps = false;  // x is the step: large steps first, limits drawn
    std::function<bool(const RunPoint&)> isAtFloor;
};

std::vector<Precision> precisionsOf(const WorkPrecision& study) {
    std::vector<Precision> found;
    for (const Precision precision : {Precision::single_, Precision::double_})
        if (std::ranges::any_of(study.points, [&](const RunPoint& p) { return p.precision == precision; }))
            found.push_back(precision);
    return found;
}

double workOf(const RunPoint& point) {
    return static_cast<double>(point.evaluations + point.iterations);
}

// Runs that failed were not timed, and ended early: their cost is that of their steps at the pace of the next shorter
// step that went well, or of any other curve.
double secondsOf(const WorkPrecision& study, const RunPoint& failed) {
    const RunPoint* pace = nullptr;
    for (const RunPoint& p : study.points) {
        if (p.status != RunStatus::ok || p.precision != failed.precision) continue;
        const bool isOwn = p.method == failed.method;
        if (pace == nullptr || (isOwn && (pace->method != failed.method || p.step > pace->step))) pace = &p;
    }
    return pace == nullptr ? RunPoint::unset
                           : pace->seconds * static_cast<double>(failed.steps) / static_cast<double>(pace->steps);
}

double fullWorkOf(const WorkPrecision& study, const RunPoint& failed) {
    const RunPoint* pace = nullptr;
    for (const RunPoint& p : study.points)
        if (p.status == RunStatus::ok && p.method == failed.method && (pace == nullptr || p.step > pace->step))
            pace = &p;
    if (pace != nullptr) return workOf(*pace) * static_cast<double>(failed.steps) / static_cast<double>(pace->steps);
    return std::max(workOf(failed), static_cast<double>(failed.steps));
}

bool isFailed(const RunPoint& point) {
    return point.status != RunStatus::ok;
}

struct Range {
    double least = HUGE_VAL, most = -HUGE_VAL;
    void add(double value) {
        if (!(value > 0) || !std::isfinite(value)) return;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    bool isEmpty() const { return least > most; }
};

class Drawing {
  public:
    Drawing(const WorkPrecision& study, const Quantities& quantities) : study_(study), q_(quantities) {
        for (const RunPoint& p : study.points) {
            x_.add(q_.x(p));
            if (p.status == RunStatus::ok) y_.add(q_.y(p));
        }
        if (q_.hasTimes && x_.most > 0.02) x_.add(1.0);  // so that the frame budget lies within
        if (x_.isEmpty()) x_ = {1e-3, 1};
        if (y_.isEmpty()) y_ = {1e-3, 1};
        x_.least /= 1.4, x_.most *= 1.4, y_.least /= 2, y_.most *= 2;
        // Room for the strip of failed runs above the curves.
        if (std::ranges::any_of(study.points, isFailed)) rows_ = static_cast<int>(study.methods.size());
        const double strip = rows_ > 0 ? (rows_ * 11 + 12) / height : 0;
        y_.most *= std::pow(y_.most / y_.least, strip / (1 - strip));
    }

    static constexpr double height = 430;  // [px] of a panel

    Panel panel(Precision precision, bool isFirst) const {
        Panel panel;
        panel.title = std::string(nameOf(precision)) + " precision";
        panel.x = {q_.xLabel, Scale::log, x_.least, x_.most, {}, true, false};
        panel.y = {isFirst ? q_.yLabel : "", Scale::log, y_.least, y_.most, {}, isFirst, false};
        panel.strip.label = "diverged, or lost";
        panel.strip.rows = rows_;
        int row = 0;
        for (const MethodFacts& method : study_.methods) addCurve(panel, method, precision, row++);
        if (q_.hasTimes) addBudget(panel);
        if (q_.hasSteps) addLimits(panel);
        return panel;
    }

  private:
    void addCurve(Panel& panel, const MethodFacts& method, Precision precision, int row) const {
        report::Curve curve, limit, floor;
        curve.title = method.title;
        curve.style = report::styleOf(method.name);
        limit.style = {curve.style.colour, report::Mark::circle, false, report::Dash::solid, 0, 1.9};
        floor.style = {"#ffffff", curve.style.mark, true, report::Dash::solid, 0, 0.55};
        for (const RunPoint& p : study_.points) {
            if (p.method != method.name || p.precision != precision) continue;
            if (p.status != RunStatus::ok) {
                panel.strip.marks.push_back({q_.x(p), row, curve.style});
                continue;
            }
            report::ChartPoint at{q_.x(p), q_.y(p)};
            if (!(at.y > 0)) continue;
            const bool isLimited = std::isfinite(method.stepLimit) && method.stepLimit > 0;
            if (isLimited && limit.points.empty() && p.step <= method.stepLimit) limit.points.push_back(at);
            if (q_.isAtFloor(p)) floor.points.push_back(at);
            if (q_.hasTimes) {
                const double simulated = study_.grid.duration();
                at.xLow = p.fastSeconds / simulated;
                at.xHigh = p.slowSeconds / simulated;
            }
            curve.points.push_back(at);
        }
        if (!limit.points.empty() && !q_.hasSteps) panel.curves.push_back(limit);
        panel.curves.push_back(curve);
        if (!floor.points.empty()) panel.curves.push_back(floor);
    }

    // Slower than real time: a second of motion takes more than a second.
    void addBudget(Panel& panel) const {
        if (x_.most < 1) {
            panel.labels.push_back({0.99, 0.03, "real time: far to the right, at 1 s  →", "#707070",
                                    report::Align::right, 0, 0, 10.5, false, true});
            return;
        }
        panel.regions.push_back({.x0 = 1, .opacity = 0.06});
        panel.guides.push_back({.x = 1, .label = "real time: " + number(1e3 * study_.frame) + " ms a frame"});
    }

    // Each method's limit as a bar in its row of the strip; that of leap-frog, the default, over the whole panel.
    void addLimits(Panel& panel) const {
        int row = 0;
        for (const MethodFacts& method : study_.methods) {
            const double limit = method.stepLimit;
            const int at = row++;
            if (!(limit > x_.least) || limit > x_.most) continue;
            if (rows_ > 0) {
                report::Style style = report::styleOf(method.name);
                style.mark = report::Mark::bar;
                panel.strip.marks.push_back({limit, at, style});
            }
            if (method.name != "leapfrog" && rows_ > 0) continue;
            panel.guides.push_back({.x = limit, .label = "limit of " + method.title});
        }
        if (study_.frame <= x_.most && study_.frame >= x_.least) {
            panel.guides.push_back({.x = study_.frame, .label = "a frame, 1/" + number(1 / study_.frame) + " s"});
            panel.guides.back().style.dash = report::Dash::dotted;
        }
    }

    const WorkPrecision& study_;
    const Quantities& q_;
    Range x_, y_;
    int rows_ = 0;
};

std::string spanText(const WorkPrecision& study) {
    const std::string unit = study.unit.empty() ? "" : " s";
    const double window = study.grid.spacing * study.window;
    return number(study.window) + " times within " + number(window) + unit;
}

// Long remarks in lines that fit the picture.
void addLines(std::vector<std::string>& notes, const std::string& text, std::size_t width) {
    std::string line;
    std::size_t at = 0;
    while (at < text.size()) {
        std::size_t end = std::min(text.find(' ', at), text.size());
        if (!line.empty() && line.size() + 1 + end - at > width) {
            notes.push_back(line);
            line.clear();
        }
        line += (line.empty() ? "" : " ") + text.substr(at, end - at);
        at = end + 1;
    }
    if (!line.empty()) notes.push_back(line);
}

Chart chartOf(const WorkPrecision& study, const Quantities& quantities, const std::string& subtitle,
              const std::vector<std::string>& legend, const std::vector<std::string>& machine) {
    Chart chart;
    chart.title = study.title;
    chart.subtitle = subtitle;
    chart.pngScale = 1.5;
    chart.panelHeight = static_cast<int>(Drawing::height);
    const std::vector<Precision> precisions = precisionsOf(study);
    chart.panelWidth = precisions.size() > 1 ? 460 : 640;
    const Drawing drawing(study, quantities);
    for (const Precision precision : precisions)
        chart.panels.push_back(drawing.panel(precision, precision == precisions.front()));
    const std::size_t width = precisions.size() > 1 ? 165 : 115;
    for (const std::string& line : legend) addLines(chart.notes, line, width);
    for (const std::string& remark : study.remarks) addLines(chart.notes, remark, width);
    for (const std::string& line : machine) addLines(chart.notes, line, width);
    return chart;
}

Quantities errorOverTime(const WorkPrecision& study) {
    return {.x =
                [&study](const RunPoint& p) {
                    return (p.status == RunStatus::ok ? p.seconds : secondsOf(study, p)) / study.grid.duration();
                },
            .y = &RunPoint::rmsError,
            .xLabel = study.unit.empty() ? "wall time for a unit of t [s]" : "wall time for a second of motion [s]",
            .yLabel = "RMS error of " + (study.unit.empty() ? "y" : "positions [" + study.unit + "]"),
            .hasTimes = true,
            .isAtFloor = &RunPoint::isAtFloor};
}

Quantities errorOverEvaluations(const WorkPrecision& study) {
    Quantities evaluations = errorOverTime(study);
    evaluations.x = [&study](const RunPoint& p) {
        return (p.status == RunStatus::ok ? workOf(p) : fullWorkOf(study, p)) / study.grid.duration();
    };
    evaluations.xLabel = study.unit.empty() ? "evaluations of y' for a unit of t" : "force evaluations for a second";
    evaluations.hasTimes = false;
    return evaluations;
}

Quantities energyOverStep() {
    return {.x = &RunPoint::step,
            .y = &RunPoint::energyError,
            .xLabel = "step h [s]",
            .yLabel = "energy drift / largest kinetic energy",
            .hasSteps = true,
            .isAtFloor = &RunPoint::isEnergyAtFloor};
}

}  // namespace

std::vector<NamedChart> workPrecisionCharts(const WorkPrecision& study, const std::vector<std::string>& notes) {
    std::vector<NamedChart> charts;
    const double simulated = study.grid.duration();
    const std::string what = study.unit.empty() ? "y" : "positions";
    const bool hasFailed = std::ranges::any_of(study.points, isFailed);
    const std::string failures =
        hasFailed ? "Top strip: runs that diverged, or whose error exceeds the whole motion." : "";
    const std::string floors =
        " White dot: at a floor of rounding, solver or reference, which smaller steps hardly better.";
    const std::string ring = " Ring: the largest step within the method's stability bound.";
    const bool hasFloor = std::ranges::any_of(study.points, &RunPoint::isAtFloor);
    const bool hasLimit = std::ranges::any_of(
        study.methods, [](const MethodFacts& m) { return m.stepLimit > 0 && std::isfinite(m.stepLimit); });
    const std::string marks = failures + (hasLimit ? ring : "") + (hasFloor ? floors : "");

    const std::string error = "RMS error of " + what + " at " + spanText(study) + ", ";
    charts.push_back({"time", chartOf(study, errorOverTime(study), error + "against wall time",
                                      {marks + " Times: median, bars over the middle half of the repeats."}, notes)});

    const Quantities evaluations = errorOverEvaluations(study);
    const bool hasSolver = std::ranges::any_of(study.points, [](const RunPoint& p) { return p.iterations > 0; });
    std::string counted = marks;
    if (hasSolver) counted += " Each product with the stiffness in a solver counts as an evaluation.";
    charts.push_back(
        {"evaluations",
         chartOf(study, evaluations, error + (study.unit.empty() ? "against evaluations" : "against force evaluations"),
                 {counted}, notes)});

    if (study.hasEnergy) {
        charts.push_back(
            {"energy", chartOf(study, energyOverStep(),
                               "Largest difference of the energy from the reference's within " + number(simulated) +
                                   " s, against the step",
                               {failures + (hasFloor ? floors : "") +
                                (hasLimit && hasFailed ? " Bars there: the methods' stability bounds." : "")},
                               notes)});
    }
    if (study.window < study.grid.samples) {
        Quantities beyond = evaluations;
        beyond.y = &RunPoint::heightError;
        beyond.isAtFloor = [](const RunPoint&) { return false; };
        beyond.yLabel = "error of the mean height [m]";
        charts.push_back(
            {"statistics", chartOf(study, beyond,
                                   "Beyond the horizon: the mean height, averaged from " +
                                       number(study.grid.spacing * study.window) + " s to " + number(simulated) + " s",
                                   {counted}, notes)});
    }
    return charts;
}

}  // namespace taut::study
