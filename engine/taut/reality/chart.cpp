#include "taut/reality/chart.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace taut::reality {

namespace {

// A mark and a colour for each program, a line for each number of cells.
std::vector<report::Curve> peerCurves(const std::vector<PeerDroop>& peers) {
    using report::Mark;
    constexpr std::array<std::pair<const char*, Mark>, 5> looks{{{"#1b7837", Mark::plus},
                                                                 {"#5aae61", Mark::cross},
                                                                 {"#762a83", Mark::star},
                                                                 {"#c51b7d", Mark::square},
                                                                 {"#8c6d31", Mark::circle}}};
    std::map<std::string, std::size_t> lookOf;
    std::map<std::pair<std::string, int>, std::size_t> curveOf;
    std::vector<report::Curve> curves;
    for (const PeerDroop& peer : peers) {
        if (!peer.isAtRest || peer.droop <= 0) continue;
        const auto& [colour, mark] = looks[lookOf.try_emplace(peer.peer, lookOf.size()).first->second % looks.size()];
        const auto [at, isNew] = curveOf.try_emplace({peer.peer, peer.cells}, curves.size());
        if (isNew)
            curves.push_back(
                {.title = peer.peer,
                 .style = {.colour = colour, .mark = mark, .dash = report::Dash::dotted, .width = 1.2, .size = 1.05}});
        curves[at->second].points.push_back({peer.gamma, peer.droop});
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
    chart.panelWidth = 760;
    chart.panelHeight = 520;
    chart.notes = notes;
    return chart;
}

}  // namespace taut::reality
