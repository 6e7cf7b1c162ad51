#include "taut/report/test_report.h"

#include <gtest/gtest.h>

#include <span>
#include <string>

#include "image_support.h"
#include "report_test_results.h"
#include "support/text.h"
#include "taut/core/private/base64.h"
#include "taut/report/junit.h"
#include "taut/report/saved_report.h"
#include "taut/report/test_page.h"
#include "taut/report/text_changes.h"

namespace taut::report::report_test_report {
namespace {

using core::base64;
using taut::test::has;
using test::bytes;
using test::mixedReport;

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
    return n;
}

TEST(TestReport, OfSeveralFailuresTheGravestCounts) {
    TestReport report = mixedReport();
    EXPECT_EQ(verdictOf(report), Verdict::diverged);
    report.scenarios.pop_back();
    EXPECT_EQ(verdictOf(report), Verdict::failed);
    report.scenarios.erase(report.scenarios.begin() + 1);
    EXPECT_EQ(verdictOf(report), Verdict::missing);
    report.scenarios.pop_back();
    EXPECT_EQ(verdictOf(report), Verdict::passed);
    report.calibration.push_back(
        {"good", "000010", "shadow off", true, true, false, 0, 0, 0, 0, false, false, "picture", "lets it through"});
    EXPECT_EQ(verdictOf(report), Verdict::failed);
}

TEST(TestReport, TheTableHasALineForEveryScenarioAndTheSummaryCountsThem) {
    const std::string table = testTable(mixedReport());
    EXPECT_EQ(count(table, "\n"), 5);  // a heading and four scenarios
    EXPECT_TRUE(has(table, "same, 59 ticks")) << table;
    EXPECT_EQ(testSummary(mixedReport()), "4 scenarios: 1 diverged, 1 failed, 1 without golden, 1 passed, 3.5 s");
}

TEST(TestReport, FailuresAreToldWithTheirPlaceAndTheCommandThatAcceptsThem) {
    const std::string text = testFailures(mixedReport());
    for (const char* part :
         {"bad.toml:7: 5 is not below 3", "state: tick 7 differs", "picture 000010: too many pixels",
          "Where this is meant, once its checks hold: taut test s --update bad", "rope.a diverged\n    at point 3"})
        EXPECT_TRUE(has(text, part)) << part << " in\n" << text;
    EXPECT_FALSE(has(text, "good")) << text;
}

// The schema that Jenkins and GitLab read: testsuites > testsuite > testcase > failure, counts in both.
TEST(TestReportJunit, CountsWhatItHolds) {
    const std::string xml = junitXml(mixedReport());
    // good: run, check, state; bad: run, check, state, picture; missing: run, state; diverged: run, state.
    EXPECT_EQ(count(xml, "<testcase "), 3 + 4 + 2 + 2);
    EXPECT_EQ(count(xml, "<failure "), 0 + 3 + 1 + 2);
    EXPECT_TRUE(
        has(xml, "<testsuites name=\"taut\" tests=\"11\" failures=\"6\" errors=\"0\" skipped=\"0\" time=\"3.500\">"))
        << xml;
    EXPECT_TRUE(has(xml, "<testsuite name=\"taut.bad\" tests=\"4\" failures=\"3\"")) << xml;
    EXPECT_TRUE(has(xml, "type=\"missing\"")) << xml;
}

TEST(TestReportJunit, EscapesWhatXmlDoesNotAllow) {
    TestReport report = mixedReport();
    report.scenarios[1].checks[0].reason = "a<b>&\"\x01\xff\xed\xa0\x80 é\n";
    const std::string xml = junitXml(report);
    EXPECT_TRUE(has(xml, "check 1 &lt; 2 &amp; &quot;x&quot; (bad.toml:7)")) << xml;
    // The control character, the stray byte and the three bytes of half a surrogate pair become question marks.
    EXPECT_TRUE(has(xml, "a&lt;b&gt;&amp;&quot;????? é&#10;")) << xml;
}

// Nothing of it was compared: it is no failure of its own, but no success of the run either.
TEST(TestReport, AsBytesAndBackIsTheSamePage) {
    const TestReport report = mixedReport();
    const std::vector<std::byte> saved = core::bytesOf(report);
    EXPECT_EQ(testPage(core::valueIn<TestReport>(saved)), testPage(report));
    EXPECT_EQ(core::bytesOf(core::valueIn<TestReport>(saved)), saved);
    for (std::size_t length = 0; length < saved.size(); length += 7)
        taut::test::messageOf(core::ErrorKind::badContent,
                              [&] { (void)core::valueIn<TestReport>(std::span(saved).first(length)); });
}

TEST(TestReport, OutdatedGoldensAreSkippedAndReportedOnceForAll) {
    TestReport report;
    for (const char* name : {"a", "b"}) {
        TestScenario scenario;
        scenario.name = name;
        scenario.verdict = scenario.state.verdict = Verdict::outdated;
        scenario.state.reason = "recorded by bits 1";
        scenario.state.word = "bits 1";
        scenario.accept = "accept one";
        scenario.pictures.resize(1);
        scenario.pictures[0].verdict = Verdict::outdated;
        report.scenarios.push_back(scenario);
    }
    report.outdated = {"recorded by bits 1: accept both"};
    EXPECT_EQ(verdictOf(report), Verdict::outdated);
    EXPECT_EQ(testFailures(report), "\nrecorded by bits 1: accept both\n");
    EXPECT_FALSE(has(testTable(report), "!")) << testTable(report);
    EXPECT_EQ(testSummary(report), "2 scenarios: 2 outdated, 0.0 s");
    const std::string xml = junitXml(report), page = testPage(report);
    EXPECT_TRUE(has(xml, "tests=\"6\" failures=\"0\" errors=\"0\" skipped=\"4\"")) << xml;
    EXPECT_EQ(count(xml, "<skipped message=\"recorded by bits 1\"/>"), 2) << xml;
    EXPECT_EQ(count(page, "accept both"), 1);
    EXPECT_EQ(count(page, "<code>accept one</code>"), 2);
    EXPECT_FALSE(has(page, "0/1"));
}

TEST(TestReportPage, HoldsItsPicturesAndNamesNoOtherPlace) {
    const std::string page = testPage(mixedReport());
    EXPECT_TRUE(has(page, base64(bytes("golden"))));
    EXPECT_TRUE(has(page, base64(bytes("actual"))));
    EXPECT_TRUE(has(page, base64(bytes("difference"))));
    for (const char* outside : {"http://", "https://", "src=\"", "href=", "@import", "url("})
        EXPECT_FALSE(has(page, outside)) << outside;
    EXPECT_TRUE(has(page, "default-src 'none'"));
}

TEST(TestReportPage, ShowsFailuresFirstWithReasonAndCommand) {
    const std::string page = testPage(mixedReport());
    EXPECT_LT(page.find("id=\"bad\""), page.find("id=\"good\""));
    EXPECT_TRUE(has(page, "5 is not below 3"));
    EXPECT_TRUE(has(page, "taut test s --update bad --why &quot;…&quot;"));
    EXPECT_TRUE(has(page, "First picture."));
    // Text from a scenario cannot end the script that it stands in.
    EXPECT_TRUE(has(page, "too many pixels \\u003c/script> differ"));
    EXPECT_EQ(count(page, "</script>"), 2);
    EXPECT_TRUE(has(page, "<code>1 &lt; 2 &amp; &quot;x&quot;</code>"));
}

TEST(TestReportPage, GravestResultsComeFirst) {
    TestReport report = mixedReport();
    report.scenarios[1].checks.insert(report.scenarios[1].checks.begin(), report.scenarios[0].checks[0]);
    const std::string page = testPage(report);
    std::size_t last = 0;
    for (const char* id : {"id=\"diverged\"", "id=\"bad\"", "id=\"missing\"", "id=\"good\""}) {
        EXPECT_GT(page.find(id), last) << id;
        last = page.find(id);
    }
    const std::size_t bad = page.find("id=\"bad\"");
    EXPECT_LT(page.find("rope.a, point 3", bad), page.find("speed(rope.a)", bad));  // the check that fails, the other
}

TEST(TestReportPage, NamesTheWorstTileAndWhatChangedInTheText) {
    TestReport report = mixedReport();
    EXPECT_FALSE(has(testPage(report), "Changed in its text"));
    TestScenario& bad = report.scenarios[1];
    bad.pictures[0].size = {640, 360};
    bad.pictures[0].worstTile = {16, 352, 16, 8};
    bad.changes = textChanges("a = 1\nb < 2\n", "a = 1\nb < 3\n");
    const std::string page = testPage(report);
    EXPECT_TRUE(has(page, "\"size\":[640,360],\"tile\":[16,352,16,8]"));
    EXPECT_TRUE(has(page,
                    "<div class=\"gone\"><span>2</span><code>\u2212 b &lt; 2</code></div>"
                    "<div class=\"added\"><span>2</span><code>+ b &lt; 3</code></div>"));
}

std::string changesText(std::string_view before, std::string_view now) {
    std::string text;
    for (const TextChange& change : textChanges(before, now))
        text += change.sign + std::to_string(change.line) + change.text + "|";
    return text;
}

TEST(TextChanges, AreTheFewestLinesWithTheirNeighbours) {
    EXPECT_EQ(changesText("a\nb\n", "a\nb"), "");
    EXPECT_EQ(changesText("a\nb\nc\n", "a\nc\n"), " 1a|-2b| 2c|");
    EXPECT_EQ(changesText("", "x\n"), "+1x|");
    EXPECT_EQ(changesText("1\n2\n3\n4\n5\n6\n7\n8\n9\n", "1\n2\n3\nx\n5\n6\n7\n8\n9\ny\n"),
              " 22| 33|-44|+4x| 55| 66|~0| 88| 99|+10y|");
}

TEST(TestReportPage, ShowsTheCalibration) {
    TestReport report = mixedReport();
    EXPECT_FALSE(has(testPage(report), "id=\"calibration\""));
    EXPECT_EQ(calibrationTable(report), "");
    report.calibration.push_back({"good", "000010", "shadow off", true, true, false, 0.5, 1.5, 0.1, 9, false, false,
                                  "picture", "share 0.9 lets it through"});
    EXPECT_TRUE(has(testPage(report), "share 0.9 lets it through"));
    EXPECT_TRUE(has(calibrationTable(report), "good 000010, shadow off: share 0.9 lets it through"));
}

}  // namespace
}  // namespace taut::report::report_test_report
