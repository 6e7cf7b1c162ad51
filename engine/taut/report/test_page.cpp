#include "taut/report/test_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/core/private/base64.h"
#include "taut/core/private/utf8.h"
#include "taut/report/page_parts.h"

namespace taut::report {
namespace {

// As a JavaScript string within a script element, where "</" would end the element.
std::string scriptText(const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
        if (c == '"' || c == '\\')
            out += std::string("\\") + c;
        else if (c == '\n')
            out += "\\n";
        else if (static_cast<unsigned char>(c) < 0x20 || c == '<')
            out += fmt::format("\\u{:04x}", static_cast<int>(c));
        else
            out += c;
    return out + "\"";
}

std::string mark(Verdict verdict) {
    return fmt::format("<span class=\"mark {0}\">{0}</span>", nameOf(verdict));
}

std::string reason(Verdict verdict, const std::string& text) {
    if (text.empty()) return "";
    return fmt::format("<div class=\"reason {}\"><span>{}</span></div>\n", nameOf(verdict), htmlText(text));
}

template <class Items>
std::string counted(const Items& items, const char* what) {
    if (std::all_of(items.begin(), items.end(), [](const auto& item) { return item.verdict == Verdict::outdated; }))
        return "";  // or there are none
    const auto passed =
        std::count_if(items.begin(), items.end(), [](const auto& item) { return item.verdict == Verdict::passed; });
    return fmt::format("<span>{}/{} {}</span>", passed, items.size(), what);
}

template <class Item>
std::vector<const Item*> gravestFirst(const std::vector<Item>& items) {
    std::vector<const Item*> sorted;
    for (const Item& item : items) sorted.push_back(&item);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto* a, const auto* b) { return a->verdict > b->verdict; });
    return sorted;
}

std::string checksTable(const TestScenario& scenario) {
    if (scenario.checks.empty()) return "";
    std::string text =
        "<h3>Checks</h3>\n<table><tr><th></th><th>check</th><th>holds</th><th>value</th><th>bound</th><th>when</th>"
        "<th>where</th><th>line</th></tr>\n";
    for (const TestCheck* each : gravestFirst(scenario.checks)) {
        const TestCheck& check = *each;
        text += fmt::format(
            "<tr><td>{}</td><td><code>{}</code></td><td>{}</td><td class=\"mono\">{}</td><td class=\"mono\">{}</td>"
            "<td>{}</td><td>{}</td><td class=\"quiet small\">{}</td></tr>\n",
            mark(check.verdict), htmlText(check.that), htmlText(check.span), htmlText(check.value),
            htmlText(check.bound), htmlText(check.when), htmlText(check.where), htmlText(check.source));
    }
    text += "</table>\n";
    for (const TestCheck& check : scenario.checks) text += reason(check.verdict, check.reason);
    return text;
}

std::string statePart(const TestState& state) {
    std::string text =
        fmt::format("<h3>State</h3>\n<div>{} <span class=\"quiet\">&ensp;{} ticks", mark(state.verdict), state.ticks);
    if (!state.lastHash.empty()) text += fmt::format(", last hash <code>{}</code>", state.lastHash);
    text += "</span></div>\n" + reason(state.verdict, state.reason);
    if (!state.why.empty())
        text += fmt::format("<p class=\"note\">“{}” <span class=\"quiet small\">{}</span></p>\n", htmlText(state.why),
                            htmlText(state.madeBy));
    return text;
}

std::string frameJson(const TestPicture& picture) {
    return fmt::format(
        "{{\"key\":{},\"frame\":{},\"label\":{},\"verdict\":\"{}\",\"reason\":{},\"figures\":{},\"why\":{},"
        "\"madeBy\":{},\"same\":{},\"size\":[{}],\"tile\":[{}],\"golden\":\"{}\",\"actual\":\"{}\",\"difference\":\"{}"
        "\"}}",
        scriptText(picture.key), picture.frame,
        scriptText(fmt::format("frame {}, {:.3f} s", picture.frame, picture.time)), nameOf(picture.verdict),
        scriptText(picture.reason), scriptText(picture.figures), scriptText(picture.why), scriptText(picture.madeBy),
        picture.isSame, fmt::join(picture.size, ","), fmt::join(picture.worstTile, ","), core::base64(picture.golden),
        picture.isSame ? "" : core::base64(picture.actual), core::base64(picture.difference));
}

std::string figurePart(const char* kind, bool swaps, const char* none) {
    return fmt::format(
        "<figure data-kind=\"{}\"><figcaption><b></b>{}</figcaption><div class=\"frame{}\">"
        "<img hidden alt=\"\"><svg class=\"tile-mark\" aria-hidden=\"true\"><rect/><rect/></svg><div class=\"none\" "
        "hidden>{}</div></div></figure>\n",
        kind, swaps ? "<span>point to swap</span>" : "", swaps ? " swaps" : "", none);
}

// The slider begins at the first picture that fails.
std::string viewerPart(const TestScenario& scenario) {
    if (scenario.pictures.empty()) return "";
    const auto bad = std::find_if(scenario.pictures.begin(), scenario.pictures.end(),
                                  [](const TestPicture& picture) { return picture.verdict != Verdict::passed; });
    const auto first = bad == scenario.pictures.end() ? 0 : bad - scenario.pictures.begin();
    std::string frames;
    for (const TestPicture& picture : scenario.pictures) frames += (frames.empty() ? "" : ",\n") + frameJson(picture);
    return fmt::format(
        "<h3>Pictures</h3>\n<div class=\"viewer\">\n<script type=\"application/json\">[{}]</script>\n"
        "<div class=\"scrub\"><span class=\"now\"><span class=\"mark\"></span><span class=\"where\"></span></span>"
        "<input type=\"range\" min=\"0\" max=\"{}\" step=\"1\" value=\"{}\" aria-label=\"golden frame\"{}>"
        "<div class=\"stops\"></div></div>\n"
        "<div class=\"stage\">\n{}{}{}</div>\n"
        "<div class=\"reason\" hidden><span></span></div>\n"
        "<p class=\"note\"><span class=\"why\"></span> <span class=\"quiet small made\"></span></p>\n"
        "<p class=\"quiet small figures\"></p>\n</div>\n",
        frames, scenario.pictures.size() - 1, first, scenario.pictures.size() == 1 ? " disabled" : "",
        figurePart("golden", true, "no golden yet"), figurePart("actual", true, "not drawn"),
        figurePart("difference", false, "nothing to compare"));
}

std::string changesPart(const std::vector<TextChange>& changes) {
    if (changes.empty()) return "";
    std::string text = "<h3>Changed in its text since</h3>\n<div class=\"diff\">";
    for (const TextChange& change : changes) {
        const char* kind = change.sign == '+' ? "added" : change.sign == '-' ? "gone" : "same";
        if (change.sign == '~')
            text += "<div class=\"same\"><span></span><code>⋮</code></div>";
        else
            text += fmt::format("<div class=\"{}\"><span>{}</span><code>{} {}</code></div>", kind, change.line,
                                change.sign == '-'   ? "\u2212"
                                : change.sign == '+' ? "+"
                                                     : "\u2007",
                                htmlText(change.text));
    }
    return text + "</div>\n";
}

std::string scenarioPart(const TestScenario& scenario) {
    const bool isGood = scenario.verdict == Verdict::passed;
    std::string text = fmt::format(
        "<details class=\"scenario{}\" id=\"{}\"{}>\n<summary>{}<h2>{}<span class=\"title\">{}</span></h2>"
        "<span class=\"counts\">{}{}<span>{:.4g} s of scene</span><span>{:.1f} s</span></span></summary>\n"
        "<div class=\"inside\">\n",
        isGood ? " is-good" : "", htmlText(scenario.name), isGood ? "" : " open", mark(scenario.verdict),
        htmlText(scenario.name), htmlText(scenario.title), counted(scenario.checks, "checks"),
        counted(scenario.pictures, "pictures"), scenario.sceneSeconds, scenario.seconds);
    for (const std::string& fault : scenario.faults) text += reason(scenario.verdict, fault);
    text += viewerPart(scenario) + checksTable(scenario) + statePart(scenario.state) + changesPart(scenario.changes);
    if (!scenario.accept.empty())
        text += fmt::format(
            "<h3>{}</h3>\n<div class=\"command\"><code>{}</code><button class=\"copy\">Copy</button>"
            "</div>\n",
            acceptHeading(scenario), htmlText(scenario.accept));
    if (!scenario.notes.empty()) text += "<h3>Notes</h3>\n";
    for (const std::string& note : scenario.notes)
        text += fmt::format("<p class=\"quiet small\">{}</p>\n", htmlText(note));
    return text + fmt::format("<p class=\"quiet small\">{}</p>\n</div>\n</details>\n", htmlText(scenario.file));
}

std::string calibrationPart(const std::vector<CalibrationRow>& rows) {
    if (rows.empty()) return "";
    std::string text =
        "<details class=\"scenario\" id=\"calibration\" open>\n<summary><span></span><h2>Calibration<span "
        "class=\"title\">"
        "errors missed and found by the thresholds</span></h2><span></span></summary><div class=\"inside\">\n"
        "<table class=\"cal\"><tr><th>scenario</th><th>picture</th><th>against</th><th class=\"number\">pixels</th>"
        "<th class=\"number\">worst tile</th><th class=\"number\">mean</th><th "
        "class=\"number\">largest</th><th>picture</th><th>state</th>"
        "<th>meant for</th></tr>\n";
    const auto cell = [](bool has, bool differs, bool isMutant) {
        if (!has) return std::string("<td class=\"quiet\">–</td>");
        const char* colour = !isMutant ? (differs ? "failed" : "quiet") : differs ? "passed" : "quiet";
        return fmt::format("<td class=\"{}\">{}</td>", colour, differs ? (isMutant ? "found" : "differs") : "same");
    };
    for (const CalibrationRow& row : rows) {
        text += fmt::format("<tr><td>{}</td><td class=\"mono\">{}</td><td>{}</td>", htmlText(row.scenario),
                            htmlText(row.picture), htmlText(row.what));
        if (row.hasPicture)
            text += fmt::format(
                "<td class=\"number\">{:.4f} %</td><td class=\"number\">{:.1f} %</td><td class=\"number\">{:.4f}</td>"
                "<td class=\"number\">{}</td>",
                100.0 * row.share, 100.0 * row.tileShare, row.offset, row.largest);
        else
            for (int column = 0; column < 4; ++column) text += "<td class=\"number quiet\">–</td>";
        text +=
            cell(row.hasPicture, row.pictureDiffers, row.isMutant) + cell(row.hasState, row.stateDiffers, row.isMutant);
        text += fmt::format("<td class=\"quiet\">{}</td></tr>\n", row.isMutant ? htmlText(row.meantFor) : "noise");
        if (!row.refusal.empty())
            text += fmt::format("<tr><td></td><td colspan=\"9\">{}</td></tr>\n", reason(Verdict::failed, row.refusal));
    }
    return text + "</table>\n</div></details>\n";
}

std::string tilesPart(const TestReport& report) {
    std::string text = "<div class=\"tiles\">\n";
    const auto tile = [&](std::size_t count, const char* what, const char* colour) {
        text += fmt::format("<div class=\"tile\"><b class=\"{}\">{}</b><span>{}</span></div>\n", colour, count, what);
    };
    const auto count = [&](Verdict verdict) {
        return static_cast<std::size_t>(
            std::count_if(report.scenarios.begin(), report.scenarios.end(),
                          [&](const TestScenario& scenario) { return scenario.verdict == verdict; }));
    };
    tile(report.scenarios.size(), report.scenarios.size() == 1 ? "scenario" : "scenarios", "");
    if (count(Verdict::diverged) > 0) tile(count(Verdict::diverged), "diverged", "diverged");
    if (count(Verdict::failed) > 0) tile(count(Verdict::failed), "failed", "failed");
    if (count(Verdict::missing) > 0) tile(count(Verdict::missing), "without golden", "missing");
    if (count(Verdict::outdated) > 0) tile(count(Verdict::outdated), "outdated", "outdated");
    tile(count(Verdict::passed), "passed", count(Verdict::passed) > 0 ? "passed" : "quiet");
    text += fmt::format("<div class=\"tile\"><b>{:.1f} s</b><span>wall time</span></div>\n</div>\n", report.seconds);
    return text;
}

std::string join(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts)
        if (!part.empty()) text += (text.empty() ? "" : " · ") + htmlText(part);
    return text;
}

}  // namespace

std::string htmlText(const std::string& text) {
    std::string out;
    for (const char c : core::printable(text)) switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\'': out += "&#39;"; break;
            default: out += c;
        }
    return out;
}

// The gravest results come first. The policy in the head makes sure that the page asks nothing of any network.
std::string testPage(const TestReport& report) {
    const Verdict verdict = verdictOf(report);
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>taut test: {}</title>\n"
        "<style>{}</style>\n</head>\n<body>\n<main>\n<div class=\"top\"><h1>taut test</h1>{}<span "
        "class=\"space\"></span>"
        "<button id=\"failing\" aria-pressed=\"false\">Hide passed</button><button "
        "id=\"theme\">Dark</button></div>\n"
        "<div class=\"facts\">{}</div>\n{}",
        nameOf(verdict), pageStyle(), mark(verdict),
        join({report.program, report.compiler, report.machine, report.renderer}), tilesPart(report));
    for (const std::string& line : report.outdated) text += reason(Verdict::outdated, line);
    for (const TestScenario* scenario : gravestFirst(report.scenarios)) text += scenarioPart(*scenario);
    text += calibrationPart(report.calibration);
    for (const std::string& note : report.notes)
        text += fmt::format("<p class=\"quiet small\">{}</p>\n", htmlText(note));
    text += fmt::format("<footer>{}</footer>\n</main>\n<script>{}</script>\n</body>\n</html>\n",
                        htmlText(report.tolerance), pageScript());
    return text;
}

}  // namespace taut::report
