#include "taut/study/atlas_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/ode/method_table.h"
#include "taut/report/palette.h"

namespace taut::study {
namespace {

using report::Chart;
using report::Curve;
using report::Dash;
using report::Mark;
using report::Panel;
using report::Scale;

// Most interesting values are near 1: the root of the logarithm spreads it, -1 for a half, 1 for twice.
double shadeOf(double growth) {
    if (!(growth > 0)) return -1;
    const double octaves = std::log2(growth);
    return std::clamp(std::copysign(std::sqrt(std::abs(octaves)), octaves), -1.0, 1.0);
}

report::ColourScale growthScale() {
    report::ColourScale scale = report::divergingScale(-1, 0, 1);
    scale.label = "growth of the amplitude per step";
    for (const double growth : {0.5, 0.7, 0.85, 0.95, 1.0, 1.05, 1.2, 1.4, 2.0}) {
        const bool isEnd = growth == 0.5 || growth == 2.0;
        const char* sign = !isEnd ? "" : growth < 1 ? "≤ " : "≥ ";
        scale.ticks.push_back({shadeOf(growth), fmt::format("{}{:.4g}", sign, growth)});
    }
    return scale;
}

std::string dampingText(const StabilityPanel& panel) {
    if (panel.isDampingAlike) return "";
    return panel.damping == Damping::drag ? ", drag" : ", dashpot";
}

Curve predictedCurve(const StabilityMap& map, const StabilityPanel& panel) {
    Curve curve;
    curve.title = "boundary that theory predicts";
    curve.style = {"#101010", Mark::none, true, Dash::dashDotted, 1.8, 1.0};
    constexpr int points = 200;
    for (int i = 0; i <= points; ++i) {
        const double zeta = map.mostZeta * i / points;
        const double z = predictedLimit(*ode::findMethod(panel.method), zeta, panel.damping);
        curve.points.push_back({zeta, z <= map.mostZ ? z : report::nothing});
    }
    return curve;
}

Curve measuredCurve(const StabilityMap& map, const StabilityPanel& panel) {
    Curve curve;
    curve.title = "smallest ωh at which growth is measured";
    curve.style = {"#101010", Mark::circle, false, Dash::solid, 0, 0.62};
    for (std::size_t i = 0; i < panel.boundaries.size(); i += 2)
        if (panel.boundaries[i].measured <= map.mostZ)
            curve.points.push_back({panel.boundaries[i].zeta, panel.boundaries[i].measured});
    return curve;
}

Panel mapPanel(const StabilityMap& map, const StabilityPanel& source) {
    Panel panel;
    panel.title = source.title + dampingText(source);
    panel.x = {"", Scale::linear, 0.0, map.mostZeta, {}, true, false};
    panel.y = {"", Scale::linear, 0.0, map.mostZ, {}, true, false};
    report::HeatMap heat{map.columns, map.rows, 0.0, map.mostZeta, map.zAt(0), map.mostZ, {}};
    // In steps that the eye does not see, and a PNG packs well.
    for (const double growth : source.growth) heat.values.push_back(std::round(24 * shadeOf(growth)) / 24);
    panel.map = std::move(heat);
    panel.curves = {predictedCurve(map, source), measuredCurve(map, source)};
    const std::string gap = source.isWithoutLimit ? fmt::format("no growth up to ωh = {:.0f}", map.mostMeasured)
                                                  : fmt::format("largest gap {:.1g}", source.largestGap);
    panel.labels.push_back({0.97, 0.94, gap, "#202020", report::Align::right, 0, 0, 10, true, true});
    return panel;
}

// Limits per force evaluation: without them a method of four stages looks twice as stable as it is.
Panel workPanel(const StabilityMap& map) {
    Panel panel;
    panel.title = "limits for equal work";
    panel.x = {"", Scale::linear, 0.0, map.mostZeta, {}, true, false};
    panel.y = {"", Scale::linear, 0.0, map.mostZ, {}, true, false};
    panel.labels.push_back({0.97, 0.94, "ωh per evaluation", "#202020", report::Align::right, 0, 0, 10, true, true});
    for (const StabilityPanel& source : map.panels) {
        if (source.growth.empty() || source.isWithoutLimit) continue;
        const ode::MethodInfo& method = *ode::findMethod(source.method);
        Curve curve;
        curve.style = report::styleOf(source.method);
        curve.style.mark = Mark::none;
        curve.style.dash = source.isDampingAlike || source.damping == Damping::drag ? Dash::solid : Dash::dashed;
        curve.title = source.title + dampingText(source);
        for (int i = 0; i <= 200; ++i) {
            const double zeta = map.mostZeta * i / 200;
            const double z = predictedLimit(method, zeta, source.damping) / method.evaluations;
            curve.points.push_back({zeta, z <= map.mostZ ? z : report::nothing});
        }
        // Methods with the same limits share a line.
        const auto isSame = [&](const Curve& other) {
            return std::equal(curve.points.begin(), curve.points.end(), other.points.begin(),
                              [](const auto& a, const auto& b) { return a.y == b.y || std::isnan(a.y + b.y); });
        };
        const auto same = std::ranges::find_if(panel.curves, isSame);
        if (same == panel.curves.end()) {
            panel.curves.push_back(std::move(curve));
            continue;
        }
        const std::string shared = same->title.substr(0, same->title.find(','));
        same->title = shared + " and " + curve.title;
        if (source.method == "leapfrog") same->style.colour = curve.style.colour;
    }
    return panel;
}

void labelAxes(Chart& chart, const std::string& x, const std::string& y) {
    const auto columns = static_cast<std::size_t>(chart.columns);
    for (std::size_t i = 0; i < chart.panels.size(); ++i) {
        if (i % columns == 0)
            chart.panels[i].y.label = y;
        else
            chart.panels[i].y.hasNumbers = false;
        if (i + columns >= chart.panels.size())
            chart.panels[i].x.label = x;
        else
            chart.panels[i].x.hasNumbers = false;
    }
}

report::Arrows field() {
    report::Arrows arrows;
    arrows.colour = "#c3c8cf";
    constexpr double spacing = 0.4, length = 0.13;
    for (int i = -5; i <= 5; ++i)
        for (int j = -5; j <= 5; ++j) {
            const double x = spacing * i, v = spacing * j;
            arrows.arrows.push_back({x - 0.5 * length * v, v + 0.5 * length * x, length * v, -length * x});
        }
    return arrows;
}

double inMilliseconds(double seconds) {
    return 1e3 * seconds;
}

bool isDrawable(double step) {
    return step > 0 && std::isfinite(step);
}

// Up to where a method stands.
std::string standingText(const MethodThreshold& method) {
    if (method.kind == ThresholdKind::aboveMost) return "stands the longest tick of a scene  →";
    if (method.kind == ThresholdKind::belowLeast)
        return fmt::format("←  fails at {:.2g} ms already", inMilliseconds(method.fails));
    if (!(method.stands > 0)) return "";
    return fmt::format("{:.3g} ms", inMilliseconds(method.stands)) +
           (method.predicted.lanczos == 0 ? ", no threshold: grows slowly at less" : "");
}

// As a sentence, in two lines.
void addCriterion(std::vector<std::string>& notes, std::string criterion) {
    if (!criterion.empty() && criterion[0] == 'a') criterion[0] = 'A';
    const std::size_t middle = criterion.find(" and the kinetic");
    if (middle == std::string::npos) return;
    notes.push_back(criterion.substr(0, middle));
    notes.push_back(criterion.substr(middle + 1) + ".");
}

}  // namespace

Chart stabilityChart(const StabilityMap& map, const std::vector<std::string>& notes) {
    Chart chart;
    chart.title = "Where each method lets a damped oscillator grow";
    chart.subtitle =
        fmt::format("Measured over {} steps at every point of {} × {}: blue falls, white stays, orange grows",
                    map.steps, map.columns, map.rows);
    for (const StabilityPanel& panel : map.panels)
        if (!panel.growth.empty()) chart.panels.push_back(mapPanel(map, panel));
    if (chart.panels.size() > 3) chart.panels.push_back(workPanel(map));
    chart.columns = static_cast<int>(std::min<std::size_t>(4, chart.panels.size()));
    chart.panelWidth = 236;
    chart.panelHeight = 200;
    chart.pngScale = 1;
    labelAxes(chart, "damping ratio ζ", "ωh");
    chart.colours = growthScale();
    chart.notes.push_back(
        "Drag is proportional to the velocity of a point, a dashpot to that at which a spring stretches: leap-frog and "
        "velocity Verlet take drag implicitly and extrapolate for dashpots.");
    chart.notes.insert(chart.notes.end(), notes.begin(), notes.end());
    return chart;
}

Chart phasePlaneChart(const std::vector<PhasePath>& paths, const std::vector<std::string>& notes) {
    Chart chart;
    chart.title = "Two turns of an undamped oscillator in the phase plane";
    chart.subtitle = fmt::format("ωh = {:.3f}, with which leap-frog makes {} steps a turn; dashed: the exact circle",
                                 phasePlaneStep(), stepsPerTurn);
    constexpr double most = 2.2;
    for (const PhasePath& path : paths) {
        Panel panel;
        panel.title = path.title;
        panel.x = {"", Scale::linear, -most, most, {{-2, "-2"}, {-1, "-1"}, {0, "0"}, {1, "1"}, {2, "2"}}, true, false};
        panel.y = panel.x;
        panel.arrows = {field()};
        Curve circle, curve;
        circle.style = {"#404040", Mark::none, true, Dash::dashed, 1.2, 1.0};
        for (int i = 0; i <= 120; ++i) {
            const double angle = 2 * 3.14159265358979 * i / 120;
            circle.points.push_back({std::cos(angle), std::sin(angle)});
        }
        curve.style = report::styleOf(path.method);
        curve.style.mark = Mark::circle;
        curve.style.isFilled = true;
        curve.style.dash = Dash::solid;
        curve.style.size = 0.6;
        for (const PhasePoint& point : path.points) {
            if (std::max(std::abs(point.x), std::abs(point.v)) > 1.6 * most) break;
            curve.points.push_back({point.x, point.v});
        }
        panel.curves = {circle, curve};
        panel.labels.push_back({0.97, 0.94, fmt::format("× {:.3g} a turn", path.growthPerTurn), "#202020",
                                report::Align::right, 0, 0, 10.5, true, true});
        chart.panels.push_back(std::move(panel));
    }
    chart.columns = static_cast<int>(std::min<std::size_t>(4, std::max<std::size_t>(1, chart.panels.size())));
    chart.panelWidth = chart.panelHeight = 230;
    chart.pngScale = 1.5;
    chart.hasLegend = false;
    labelAxes(chart, "x", "v / ω");
    chart.notes.push_back("Velocities at the time of the positions; leap-frog itself keeps them half a step behind.");
    chart.notes.insert(chart.notes.end(), notes.begin(), notes.end());
    return chart;
}

Chart thresholdChart(const SceneThresholds& thresholds, const std::vector<std::string>& notes) {
    Panel panel;
    const auto rows = static_cast<double>(thresholds.methods.size());
    double least = thresholds.mostStep, most = 0;
    Curve measured, anywhere, here, lanczos, closed;
    measured.title = "measured";
    measured.style = {"#d55e00", Mark::circle, true, Dash::solid, 0, 1.5};
    anywhere.title = "by B1, any shape";
    anywhere.style = {"#0072b2", Mark::triangle, true, Dash::solid, 0, 1.1};
    here.title = "by B2, as it starts";
    here.style = {"#0072b2", Mark::down, false, Dash::solid, 0, 1.3};
    lanczos.title = "by Lanczos";
    lanczos.style = {"#101010", Mark::plus, true, Dash::solid, 0, 1.5};
    closed.title = "closed form";
    closed.style = {"#009e73", Mark::diamond, false, Dash::solid, 0, 2.2};
    double row = rows;
    for (const MethodThreshold& method : thresholds.methods) {
        panel.y.ticks.push_back({row, method.title});
        const auto add = [&](Curve& curve, double step) {
            if (!isDrawable(step)) return;
            curve.points.push_back({inMilliseconds(step), row});
            least = std::min(least, step), most = std::max(most, step);
        };
        add(anywhere, method.predicted.boundAnywhere);
        add(here, method.predicted.boundHere);
        add(lanczos, method.predicted.lanczos);
        add(closed, method.predicted.closedForm);
        if (method.kind == ThresholdKind::found) add(measured, method.stands);
        if (method.kind == ThresholdKind::aboveMost) most = std::max(most, method.stands);
        row -= 1;
    }
    least /= 2, most *= 2.2;
    row = rows;
    for (const MethodThreshold& method : thresholds.methods) {
        const double h = method.kind == ThresholdKind::found ? method.stands : 0;
        const bool isRight = method.kind == ThresholdKind::aboveMost;
        const double at = isRight ? most / 1.05 : h > 0 ? h : least * 1.05;
        panel.labels.push_back({inMilliseconds(at), row, standingText(method), "#303030",
                                isRight ? report::Align::right : report::Align::left, 0, 14, 10.5});
        row -= 1;
    }
    panel.x = {"step h [ms]", Scale::log, inMilliseconds(least), inMilliseconds(most), {}, true, false};
    panel.y.least = 0.4;
    panel.y.most = rows + 0.6;
    for (const Curve* curve : {&closed, &anywhere, &here, &lanczos, &measured})
        if (!curve->points.empty()) panel.curves.push_back(*curve);
    Chart chart;
    chart.title = "Largest step that each method stands";
    chart.subtitle = thresholds.title;
    chart.panels = {panel};
    chart.panelWidth = 620;
    chart.panelHeight = static_cast<int>(44 * rows + 20);
    chart.notes.push_back("Measured by bisection to 1 %, beside the steps that bounds and theory give.");
    addCriterion(chart.notes, thresholds.criterion);
    chart.notes.insert(chart.notes.end(), notes.begin(), notes.end());
    return chart;
}

}  // namespace taut::study
