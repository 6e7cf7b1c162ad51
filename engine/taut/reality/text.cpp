#include "taut/reality/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "taut/reality/elastica.h"
#include "taut/report/column.h"
#include "taut/report/page_parts.h"
#include "taut/report/test_page.h"

namespace taut::reality {
namespace {

using report::htmlText;

std::string verdictOf(const Line& line) {
    return line.passes() ? "pass" : line.missing.empty() ? "FAIL" : "FAIL: " + line.missing;
}

std::string percent(double value) {
    return std::isfinite(value) ? fmt::format("{:+.2f} %", 100 * value) : "–";
}

std::string brief(double value) {
    return std::isfinite(value) ? fmt::format("{:.5g}", value) : "–";
}

std::string milliseconds(double seconds) {
    return seconds > 0 ? fmt::format("{:.0f}", 1e3 * seconds) : "″";  // of the same play as the line above
}

std::string tolerance(const Line& line) {
    return fmt::format("±{:.3g} %", 100 * line.tolerance);
}

report::Columns<Line> columns() {
    return {{"row", &Line::row, "row"},
            {"quantity", &Line::quantity, "quantity"},
            {"source", &Line::source, "theory or measurement"},
            {"expected", &Line::expected, "expected", [](const Line& l) { return brief(l.expected); }},
            {"value", &Line::value, "taut", [](const Line& l) { return brief(l.value); }},
            {"relative_error", &Line::error, "error", [](const Line& l) { return percent(l.error()); }},
            {"relative_tolerance", &Line::tolerance, "allowed", tolerance},
            {"cells", &Line::cells, "cells"},
            {"processor_s", &Line::processor, "cost [ms]", [](const Line& l) { return milliseconds(l.processor); }},
            {"simulated_s", &Line::simulated},
            {"passes", &Line::passes, "verdict", verdictOf},
            {"missing", &Line::missing},
            {"scene", &Line::scene}};
}

struct Sums {
    long long lines = 0, failed = 0;
    double processor = 0;
};
Sums sumsOf(const Comparison& comparison) {
    Sums sums;
    for (const Line& line : comparison.lines) {
        ++sums.lines;
        sums.failed += line.passes() ? 0 : 1;
        sums.processor += line.processor;
    }
    return sums;
}

// The lines of one row, under its title.
std::string rowPart(const Comparison& comparison, const Row& row) {
    std::string lines, scenes;
    for (const Line& line : comparison.lines) {
        if (line.row != row.name) continue;
        lines += fmt::format(
            "<tr><td>{}</td><td class=\"quiet\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
            "<td class=\"number\">{}</td><td class=\"number quiet\">{}</td><td class=\"number\">{}</td>"
            "<td class=\"number\">{}</td><td><span class=\"mark {}\">{}</span></td></tr>\n",
            htmlText(line.quantity), htmlText(line.source), brief(line.expected), brief(line.value),
            percent(line.error()), tolerance(line), line.cells, milliseconds(line.processor),
            line.passes() ? "passed" : "failed", htmlText(line.passes() ? "pass" : verdictOf(line)));
        if (!line.scene.empty() && scenes.find(">" + line.scene + ".toml<") == std::string::npos)
            scenes += fmt::format(" <a href=\"scenes/{0}.toml\"><code>{0}.toml</code></a>", htmlText(line.scene));
    }
    if (lines.empty()) return "";
    return fmt::format(
        "<h3>{}: {}</h3>\n<table><colgroup><col style=\"width:29%\"><col style=\"width:22%\"></colgroup><tr>"
        "<th>quantity</th><th>theory or measurement</th><th class=\"number\">expected</th><th "
        "class=\"number\">taut</th>"
        "<th class=\"number\">error</th><th class=\"number\">allowed</th><th class=\"number\">cells</th>"
        "<th class=\"number\">ms</th><th>verdict</th></tr>\n{}</table>\n{}",
        row.name, htmlText(row.title), lines,
        scenes.empty() ? "" : "<p class=\"quiet small\">Scenes:" + scenes + "</p>\n");
}

// "+0.4 %", "×12".
std::string briefError(double ratio) {
    if (!(ratio > 0)) return "–";
    if (ratio >= 2) return fmt::format("×{:.{}f}", ratio, ratio < 9.95 ? 1 : 0);
    return fmt::format("{:+.{}f} %", 100 * (ratio - 1), std::abs(ratio - 1) < 0.0995 ? 1 : 0);
}

// The error of H/W at each Γ, of the curves of taut and of those of others.
std::string besidePart(const Comparison& comparison) {
    if (comparison.peers.empty()) return "";
    std::vector<std::pair<std::string, std::map<double, double>>> all;  // H/W at Γ, in the order of measuring
    std::set<double> gammas;
    const auto add = [&](const std::string& name, double gamma, double droop) {
        auto strips = std::ranges::find_if(all, [&](const auto& known) { return known.first == name; });
        if (strips == all.end()) strips = all.insert(all.end(), {name, {}});
        strips->second[gamma] = droop;
        gammas.insert(gamma);
    };
    for (const DroopCurve& curve : comparison.droops)
        if (curve.cells > 0)
            for (const auto& [gamma, droop] : curve.points) add(curve.name, gamma, droop);
    for (const PeerDroop& peer : comparison.peers)
        add(fmt::format("{}, {} cells", peer.peer, peer.cells), peer.gamma, peer.isAtRest ? peer.droop : 0);
    std::string head, rows;
    std::map<double, double> exact;
    for (const double gamma : gammas) {
        head += fmt::format("<th class=\"number\">Γ = {}</th>", gamma);
        exact[gamma] = elasticaDroop(gamma);
    }
    for (const auto& [name, droops] : all) {
        rows += fmt::format("<tr><td>{}</td>", htmlText(name));
        for (const double gamma : gammas) {
            const auto droop = droops.find(gamma);
            rows += fmt::format("<td class=\"number\">{}</td>",
                                droop == droops.end() ? "" : briefError(droop->second / exact[gamma]));
        }
        rows += "</tr>\n";
    }
    return fmt::format(
        "<h3>R1 beside others</h3>\n<table class=\"small\"><tr><th>error of H/W</th>{}</tr>\n{}</table>\n"
        "<p class=\"quiet small\">As others were measured; –: does not come to rest, or points upwards.</p>\n",
        head, rows);
}

}  // namespace

std::string csv(const Comparison& comparison) {
    return report::csv(tableOf(columns(), comparison.lines, report::In::csv));
}

std::string droopsCsv(const Comparison& comparison) {
    report::TextTable table;
    table.columns = {"curve", "cells", "gamma", "height_over_width"};
    for (const DroopCurve& curve : comparison.droops)
        for (const auto& [gamma, droop] : curve.points)
            table.rows.push_back({curve.name, static_cast<long long>(curve.cells), gamma, droop});
    return report::csv(table);
}

std::string drapesCsv(const Comparison& comparison) {
    report::TextTable table;
    table.columns = {"fabric", "weight_kg_per_m2", "drops", "measured", "mean", "spread", "folds"};
    for (const DrapeBand& band : comparison.drapes)
        table.rows.push_back({band.fabric, band.weight, static_cast<long long>(band.drops), band.measured, band.mean,
                              band.spread, band.folds});
    return report::csv(table);
}

std::string summary(const Comparison& comparison) {
    const Sums sums = sumsOf(comparison);
    return fmt::format("{}\n{} of {} pass, in {:.1f} s of processor time\n",
                       aligned(tableOf(columns(), comparison.lines, report::In::people)), sums.lines - sums.failed,
                       sums.lines, sums.processor);
}

std::string page(const Comparison& comparison, const std::vector<std::string>& charts, const std::string& note) {
    const Sums sums = sumsOf(comparison);
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>taut reality</title>\n"
        "<style>{}\n.chart {{ background: #fff; border: 1px solid var(--line); border-radius: 14px; padding: 18px; "
        "margin: 0 0 18px; text-align: center; }}\n.chart svg {{ max-width: 100%; height: auto; "
        "}}\n</style>\n</head>\n<body>\n<main>\n"
        "<div class=\"top\"><h1>taut against theory and measurement</h1></div>\n<div class=\"facts\">{}</div>\n"
        "<div class=\"tiles\"><div class=\"tile\"><b>{}</b><span>quantities</span></div>"
        "<div class=\"tile\"><b class=\"passed\">{}</b><span>pass</span></div>"
        "<div class=\"tile\"><b class=\"{}\">{}</b><span>fail</span></div>"
        "<div class=\"tile\"><b>{:.1f} s</b><span>processor time</span></div></div>\n",
        report::pageStyle(), htmlText(note), sums.lines, sums.lines - sums.failed, sums.failed > 0 ? "failed" : "quiet",
        sums.failed, sums.processor);
    for (const std::string& svg : charts) text += "<div class=\"chart\">" + svg.substr(svg.find("<svg")) + "</div>\n";
    text += besidePart(comparison);
    for (const Row& row : rows()) text += rowPart(comparison, row);
    return text +
           "<footer>L length, B bending rigidity, w weight per area, Γ = wL³/B. Theory comes from solvers that share "
           "no "
           "code with the engine. ms: processor time of all plays of a line; ″: those of the line above. Not modelled: "
           "softening of a fabric with curvature.</footer>\n</main>\n</body>\n</html>\n";
}

}  // namespace taut::reality
