#include "taut/reality/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace taut::reality {

namespace {

// Of each program the strips with the most cells.
std::vector<report::Curve> peerCurves(const std::vector<PeerDroop>& peers) {
    using report::Mark;
    constexpr std::array<std::pair<const char*, Mark>, 5> looks{{{"#c51b7d", Mark::square},
                                                                 {"#8c6d31", Mark::circle},
                                                                 {"#1b7837", Mark::plus},
                                                                 {"#41ab5d", Mark::cross},
                                                                 {"#54278f", Mark::star}}};
    std::map<std::string, int> cells;
    for (const PeerDroop& peer : peers) cells[peer.peer] = std::max(cells[peer.peer], peer.cells);
    std::vector<report::Curve> curves;
    for (const PeerDroop& peer : peers) {
        if (peer.cells != cells[peer.peer] || !peer.isAtRest || peer.droop <= 0) continue;
        const std::string title = fmt::format("{}, {} cells", peer.peer, peer.cells);
        auto curve =
            std::find_if(curves.begin(), curves.end(), [&](const auto& known) { return known.title == title; });
        if (curve == curves.end()) {
            const auto& [colour, mark] = looks[curves.size() % looks.size()];
            curve = curves.insert(curve, {.title = title,
                                          .style = {.colour = colour,
                                                    .mark = mark,
                                                    .isFilled = false,
                                                    .dash = report::Dash::dotted,
                                                    .width = 1.2,
                                                    .size = mark == Mark::square ? 1.4 : 1.05}});
        }
        curve->points.push_back({peer.gamma, peer.droop});
    }
    return curves;
}

}  // namespace

report::Chart droopChart(const std::vector<DroopCurve>& curves, const std::vector<PeerDroop>& peers,
                         const std::vector<std::string>& notes) {
    using report::Mark;
    struct Look {
        const char* colour;
        Mark mark;
    };
    constexpr std::array<Look, 4> ofTaut{{{"#9ecae1", Mark::triangle},
                                          {"#4292c6", Mark::square},
                                          {"#08519c", Mark::diamond},
                                          {"#08306b", Mark::circle}}};
    constexpr std::array<Look, 2> ofSprings{{{"#d94801", Mark::down}, {"#fd8d3c", Mark::pentagon}}};
    std::size_t taut = 0, springs = 0;
    report::Panel panel;
    panel.x = {
        .label = "Γ = weight × length³ / bending rigidity", .scale = report::Scale::log, .least = 0.08, .most = 1250};
    panel.y = {.label = "H/W, height over width of the hanging strip",
               .scale = report::Scale::log,
               .least = 8e-3,
               .most = 150};
    for (const DroopCurve& curve : curves) {
        report::Curve drawn;
        drawn.title = curve.name;
        if (curve.cells == 0) {
            drawn.title = "heavy elastica, exact";
            drawn.style = {.colour = "#202020", .width = 2.2};
        } else if (curve.isOfSprings) {
            const Look look = ofSprings[springs++ % ofSprings.size()];
            drawn.style = {.colour = look.colour,
                           .mark = look.mark,
                           .isFilled = false,
                           .dash = report::Dash::dashed,
                           .width = 1.4,
                           .size = 1.1};
        } else {
            const Look look = ofTaut[taut++ % ofTaut.size()];
            drawn.style = {.colour = look.colour, .mark = look.mark, .isFilled = false, .width = 0, .size = 1.25};
        }
        for (const auto& [gamma, droop] : curve.points) drawn.points.push_back({gamma, droop});
        panel.curves.push_back(std::move(drawn));
    }
    for (report::Curve& curve : peerCurves(peers)) panel.curves.push_back(std::move(curve));
    report::Chart chart;
    chart.title = "A strip clamped level droops under its own weight";
    chart.subtitle =
        "A rigidity holds at every length and resolution; springs across two cells hold where they were fitted";
    chart.panels = {panel};
    chart.panelWidth = 820;
    chart.panelHeight = 520;
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
        std::sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
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
             .points = {*std::find_if(swept.points.begin(), swept.points.end(),
                                      [&](const auto& p) { return p.x == weight; })}});
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
