#include "taut/reality/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "taut/reality/elastica.h"

namespace taut::reality {

namespace {

// The mean factor by which strips at rest miss the theory, as a logarithm.
double missOf(const report::Curve& curve) {
    double sum = 0;
    for (const report::ChartPoint& point : curve.points) sum += std::abs(std::log(point.y / elasticaDroop(point.x)));
    return sum / static_cast<double>(curve.points.size());
}

// Of each program the settings that come closest to the theory, with the most cells that it has been measured with.
std::vector<report::Curve> peerCurves(const std::vector<PeerDroop>& peers) {
    std::map<std::string, int> cells;
    for (const PeerDroop& peer : peers) cells[peer.peer] = std::max(cells[peer.peer], peer.cells);
    std::map<std::string, report::Curve> settings;
    for (const PeerDroop& peer : peers) {
        if (peer.cells != cells[peer.peer] || !peer.isAtRest || peer.droop <= 0) continue;
        report::Curve& curve = settings[peer.peer];
        curve.title = fmt::format("{}, {} cells", peer.peer, peer.cells);
        curve.points.push_back({peer.gamma, peer.droop});
    }
    std::map<std::string, report::Curve> best;  // by the first word of the name
    for (const auto& [name, curve] : settings) {
        const auto [known, isNew] = best.try_emplace(name.substr(0, name.find(' ')), curve);
        if (!isNew && missOf(curve) < missOf(known->second)) known->second = curve;
    }
    std::vector<report::Curve> curves;
    for (auto& [program, curve] : best) curves.push_back(std::move(curve));
    return curves;
}

// Beside a point of the curve, in its colour, in place of a legend.
report::Label nameOf(const report::Curve& curve, std::size_t point, report::Align align, double right, double up) {
    const report::ChartPoint& at = curve.points[std::min(point, curve.points.size() - 1)];
    return {.x = at.x,
            .y = at.y,
            .text = curve.title,
            .colour = curve.style.colour,
            .align = align,
            .dx = right,
            .dy = up,
            .size = 13};
}

}  // namespace

report::Chart droopChart(const std::vector<DroopCurve>& curves, const std::vector<PeerDroop>& peers,
                         const std::vector<std::string>& notes) {
    using report::Mark;
    constexpr int cellsOfPeers = 20;
    report::Panel panel;
    panel.x = {
        .label = "Γ = weight × length³ / bending rigidity", .scale = report::Scale::log, .least = 0.08, .most = 1250};
    panel.y = {.label = "H/W, height over width of the hanging strip",
               .scale = report::Scale::log,
               .least = 8e-3,
               .most = 150};
    const auto add = [&](report::Curve curve, std::size_t named, report::Align align, double right, double up) {
        if (curve.points.empty()) return;
        panel.labels.push_back(nameOf(curve, named, align, right, up));
        panel.curves.push_back(std::move(curve));
    };
    for (const DroopCurve& curve : curves) {
        report::Curve drawn{.title = curve.name};
        for (const auto& [gamma, droop] : curve.points) drawn.points.push_back({gamma, droop});
        if (curve.cells == 0) {
            drawn.title = "heavy elastica, exact";
            drawn.style = {.colour = "#202020", .width = 2.2};
            add(std::move(drawn), curve.points.size() / 3, report::Align::left, 12, -14);
        } else if (curve.cells == cellsOfPeers && !curve.isOfSprings) {
            drawn.style = {.colour = "#08519c", .mark = Mark::diamond, .isFilled = false, .width = 0, .size = 1.4};
            add(std::move(drawn), 2, report::Align::left, 12, -14);
        }
    }
    constexpr std::array<std::pair<const char*, Mark>, 4> looks{
        {{"#1b7837", Mark::plus}, {"#c51b7d", Mark::square}, {"#8c6d31", Mark::circle}, {"#54278f", Mark::star}}};
    std::size_t look = 0;
    for (report::Curve& curve : peerCurves(peers)) {
        const auto& [colour, mark] = looks[look++ % looks.size()];
        curve.style = {.colour = colour, .mark = mark, .isFilled = false, .dash = report::Dash::dotted, .width = 1.4};
        const bool isAbove = curve.points.front().y > 1.5 * elasticaDroop(curve.points.front().x);
        if (isAbove)
            add(std::move(curve), 4, report::Align::right, -12, 14);
        else
            add(std::move(curve), std::string::npos, report::Align::right, -12, 40);
    }
    report::Chart chart;
    chart.title = "A strip clamped level droops under its own weight";
    chart.subtitle = "A rigidity holds at every length; each other program with the settings that come closest";
    chart.panels = {panel};
    chart.panelWidth = 820;
    chart.panelHeight = 520;
    chart.hasLegend = false;
    chart.notes = notes;
    return chart;
}

report::Chart drapeChart(const std::vector<DrapeBand>& bands, const std::vector<std::string>& notes) {
    report::Panel panel;
    panel.x = {.label = "weight of the cloth [g/m²]", .least = 50, .most = 220};
    panel.y = {.label = "drape coefficient [%]", .least = 0, .most = 100};
    std::map<std::string, std::vector<DrapeBand>> fabrics;
    for (const DrapeBand& band : bands) fabrics[band.fabric].push_back(band);
    for (auto& [name, own] : fabrics) {
        const double measured = 100 * own.front().measured, weight = 1e3 * own.front().weight;
        const std::string colour = own.front().colour;
        panel.regions.push_back({.y0 = measured - 10, .y1 = measured + 10, .colour = colour, .opacity = 0.12});
        panel.guides.push_back({.y = measured,
                                .label = name + ", measured ±10 points",
                                .style = {.colour = colour, .dash = report::Dash::dashed, .width = 1.4},
                                .labelAt = 0.02});
        report::Curve swept{name + ", taut, ± spread", {.colour = colour, .mark = report::Mark::circle}, {}};
        std::ranges::sort(own, [](const auto& a, const auto& b) { return a.weight < b.weight; });
        for (const DrapeBand& band : own) {
            const double x = 1e3 * band.weight, y = 100 * band.mean, bar = 100 * band.spread;
            swept.points.push_back({.x = x, .y = y, .yLow = y - bar, .yHigh = y + bar});
            panel.labels.push_back(
                {.x = x, .y = y, .text = fmt::format("{:.2g} folds", band.folds), .colour = colour, .dx = 6, .dy = 9});
        }
        panel.curves.push_back(swept);
        panel.curves.push_back(
            {.title = "weight in assets/fabrics, chosen",
             .style = {.colour = "#202020", .mark = report::Mark::circle, .isFilled = false, .width = 0, .size = 1.9},
             .points = {*std::ranges::find_if(swept.points, [&](const auto& p) { return p.x == weight; })}});
    }
    report::Chart chart;
    chart.title = "Cloth of 15 cm over a disc of 9 cm";
    chart.subtitle =
        "Bending and its friction are measured, the weight is not: each curve shows the influence of the weight, not a "
        "prediction";
    chart.panels = {panel};
    chart.panelWidth = 760;
    chart.panelHeight = 460;
    chart.notes = notes;
    return chart;
}

}  // namespace taut::reality
