// A run of tests with a little of everything, as the tests of its outputs need it.
#pragma once

#include <span>
#include <string_view>

#include "taut/report/test_report.h"

namespace taut::report::test {

inline std::vector<std::byte> bytes(std::string_view text) {
    const auto all = std::as_bytes(std::span<const char>(text.data(), text.size()));
    return {all.begin(), all.end()};
}

inline TestReport mixedReport() {
    TestReport report;
    report.program = "taut 1";
    report.seconds = 3.5;

    TestScenario good;
    good.name = "good";
    good.file = "s/good.toml";
    good.state = {Verdict::passed, 59, "00000000000000aa", "", "First.", "taut 1"};
    good.checks.push_back(
        {Verdict::passed, "speed(rope.a) < 3", "always", "2", "3", "1 s, frame 60", "", "good.toml:9", ""});
    report.scenarios.push_back(good);

    TestScenario bad;
    bad.name = "bad";
    bad.file = "s/bad.toml";
    bad.verdict = Verdict::failed;
    bad.state = {Verdict::failed, 59, "00000000000000bb", "tick 7 differs", "First.", "taut 1"};
    bad.checks.push_back({Verdict::failed, "1 < 2 & \"x\"", "at 2 s", "5", "3", "2 s", "rope.a, point 3", "bad.toml:7",
                          "5 is not below 3"});
    TestPicture picture;
    picture.verdict = Verdict::failed;
    picture.key = "000010";
    picture.frame = 10;
    picture.reason = "too many pixels </script> differ";
    picture.why = "First picture.";
    picture.golden = bytes("golden");
    picture.actual = bytes("actual");
    picture.difference = bytes("difference");
    bad.pictures.push_back(picture);
    bad.accept = "taut test s --update bad --why \"…\"";
    report.scenarios.push_back(bad);

    TestScenario missing;
    missing.name = "missing";
    missing.file = "s/missing.toml";
    missing.verdict = Verdict::missing;
    missing.state = {Verdict::missing, 59, "00000000000000cc", "no chain yet", "", ""};
    report.scenarios.push_back(missing);

    TestScenario diverged;
    diverged.name = "diverged";
    diverged.file = "s/diverged.toml";
    diverged.verdict = Verdict::diverged;
    diverged.state.verdict = Verdict::diverged;
    diverged.faults.push_back("rope.a diverged\nat point 3");
    report.scenarios.push_back(diverged);
    return report;
}

}  // namespace taut::report::test
