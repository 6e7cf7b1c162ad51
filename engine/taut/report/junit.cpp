#include "taut/report/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "taut/core/private/utf8.h"
#include "taut/report/test_page.h"

namespace taut::report {
namespace {

struct Case {
    std::string name;
    Verdict verdict = Verdict::passed;
    std::string message;
    double seconds = 0;
};

// Of the character that begins there; 0: it is none, or one that XML does not allow.
std::size_t characterLength(const std::string& text, std::size_t at) {
    const core::Letter letter = core::firstLetter(std::string_view(text).substr(at));
    const bool isControl = letter.code < 0x20 && letter.code != '\n' && letter.code != '\r' && letter.code != '\t';
    return isControl || letter.code == 0xFFFE || letter.code == 0xFFFF ? 0 : letter.size;
}

// For text and attributes; characters that XML does not allow become question marks.
std::string escaped(const std::string& text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = characterLength(text, at);
        if (length == 0) {
            out += '?';
            ++at;
            continue;
        }
        switch (text[at]) {
            case '\n': out += "&#10;"; break;
            case '\r': out += "&#13;"; break;
            case '\t': out += "&#9;"; break;
            default: out += htmlText(text.substr(at, length));
        }
        at += length;
    }
    return out;
}

std::vector<Case> casesOf(const TestScenario& scenario) {
    std::vector<Case> cases;
    Case run{"runs", scenario.faults.empty() ? Verdict::passed : Verdict::failed, "", scenario.seconds};
    for (const std::string& fault : scenario.faults) run.message += (run.message.empty() ? "" : "\n") + fault;
    if (scenario.verdict == Verdict::diverged) run.verdict = Verdict::diverged;
    cases.push_back(run);
    for (const TestCheck& check : scenario.checks)
        cases.push_back({fmt::format("check {} ({})", check.that, check.source), check.verdict, check.reason, 0.0});
    cases.push_back({"state", scenario.state.verdict, scenario.state.reason, 0.0});
    for (const TestPicture& picture : scenario.pictures)
        cases.push_back({"picture " + picture.key, picture.verdict, picture.reason, 0.0});
    return cases;
}

bool isFailure(Verdict verdict) {
    return verdict > Verdict::outdated;
}

bool isSkipped(Verdict verdict) {
    return verdict == Verdict::skipped || verdict == Verdict::outdated;
}

std::string counts(const std::vector<Case>& cases, double seconds) {
    const auto failures = std::count_if(
        cases.begin(), cases.end(), [](const Case& c) { return isFailure(c.verdict); });
    const auto skipped = std::count_if(cases.begin(), cases.end(), [](const Case& c) { return isSkipped(c.verdict); });
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"{:.3f}\"", cases.size(),
                       failures, skipped, seconds);
}

std::string caseXml(const std::string& suite, const Case& c) {
    std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", escaped(suite),
                                   escaped(c.name), c.seconds);
    if (isSkipped(c.verdict)) {
        const std::string why = c.message.empty() ? "" : fmt::format(" message=\"{}\"", escaped(c.message));
        return text + fmt::format(">\n      <skipped{}/>\n    </testcase>\n", why);
    }
    if (!isFailure(c.verdict)) return text + "/>\n";
    const std::string first = c.message.substr(0, c.message.find('\n'));
    return text + fmt::format(">\n      <failure type=\"{}\" message=\"{}\">{}</failure>\n    </testcase>\n",
                              nameOf(c.verdict), escaped(first), escaped(c.message));
}

}  // namespace

std::string junitXml(const TestReport& report) {
    std::string suites;
    std::vector<Case> all;
    for (const TestScenario& scenario : report.scenarios) {
        const std::vector<Case> cases = casesOf(scenario);
        const std::string suite = "taut." + scenario.name;
        suites += fmt::format("  <testsuite name=\"{}\" {}>\n", escaped(suite), counts(cases, scenario.seconds));
        for (const Case& c : cases) suites += caseXml(suite, c);
        suites += "  </testsuite>\n";
        all.insert(all.end(), cases.begin(), cases.end());
    }
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"taut\" {}>\n{}</testsuites>\n",
                       counts(all, report.seconds), suites);
}

}  // namespace taut::report
