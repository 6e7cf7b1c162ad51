// The results of a run of tests, as plain data for the console, the page and the JUnit file. Independent of playing and
// judging scenarios.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "taut/report/text_changes.h"

namespace taut::report {

// The later the worse. Outdated: recorded by other bits, and so not compared.
enum class Verdict { passed, skipped, outdated, missing, failed, diverged };

struct TestCheck {
    Verdict verdict = Verdict::passed;
    std::string that;    // "max_strain(cloth.*) < 0.1"
    std::string span;    // when it has to hold: "always", "at 2 s"
    std::string value;   // "0.031", with its unit
    std::string bound;   // "0.1"
    std::string when;    // "2.317 s, frame 139": where it failed first, or came nearest to failing
    std::string where;   // "cloth.flag, point 12"; empty: nowhere in particular
    std::string source;  // "flag.toml:31"
    std::string reason;  // a line with the failure; empty when it passed
};

// The chain of state hashes.
struct TestState {
    Verdict verdict = Verdict::passed;
    std::int64_t ticks = 0;
    std::string lastHash;  // 16 hexadecimal digits
    std::string reason;    // empty when it passed
    std::string why;       // the manifest's reason for the golden
    std::string madeBy;    // the program that recorded the golden
    std::string word{};    // its result in the table; empty: the verdict
    int bits = 0;          // of the goldens, where outdated
};

// PNG files as bytes; empty where there is none.
struct TestPicture {
    Verdict verdict = Verdict::passed;
    std::string key;  // "000120-debug"
    std::int64_t frame = 0;
    double time = 0;                   // [s]
    std::string figures;               // how far the pictures are apart
    std::string reason;                // empty when it passed
    std::string why;                   // the manifest's reason for the golden
    std::string madeBy;                // the renderer that drew the golden
    bool isSame = false;               // golden and actual do not differ in a single pixel
    bool isOfAnotherRenderer = false;  // than the golden, and so held against another tolerance
    std::vector<std::byte> golden, actual, difference;
    std::array<int, 2> size{};       // [px] width and height, where a tile is marked
    std::array<int, 4> worstTile{};  // [px] left, top, width and height of the one that differs most; 0: none
};

struct TestScenario {
    std::string name, title;
    std::string file;
    Verdict verdict = Verdict::passed;
    std::vector<std::string> faults;  // of the scenario as a whole: it diverged, or could not be built
    std::vector<std::string> notes;   // that fail nothing
    std::vector<TestCheck> checks;
    TestState state;
    std::vector<TestPicture> pictures;
    double seconds = 0;       // [s] of wall time
    double sceneSeconds = 0;  // [s] of the scene
    double framesPerSecond = 60;
    std::vector<TextChange> changes;  // of its text since its goldens were accepted
    std::string accept;               // the command that accepts the differences; empty: nothing to accept
};

// How far apart two pictures of the same thing are, or of the same thing with a mistake in it.
struct CalibrationRow {
    std::string scenario, picture;
    std::string what;  // "again", "EGL", "camera one pixel off"
    bool isMutant = false;
    bool hasPicture = true, hasState = true;            // false: this row does not concern it
    double share = 0;                                   // of pixels that differ [-]
    double tileShare = 0;                               // of those of the worst tile [-]
    double offset = 0;                                  // of the mean of a channel [1/255]
    int largest = 0;                                    // [1/255]
    bool pictureDiffers = false, stateDiffers = false;  // as the tests see it
    std::string meantFor;                               // "picture", "state"
    std::string refusal;                                // which threshold is refused, and why; empty: in order
};

struct TestReport {
    std::string program, compiler, machine;
    std::string renderer;   // of the pictures drawn now
    std::string tolerance;  // in words
    std::vector<std::string> notes;
    std::vector<std::string> outdated;  // messages about outdated scenarios, one for each number of bits
    std::vector<TestScenario> scenarios;
    std::vector<CalibrationRow> calibration;
    double seconds = 0;  // [s] of wall time
};

std::string nameOf(Verdict verdict);  // "passed"

// Text before the command that accepts it: "Where this is meant", and that its checks come first if one fails.
std::string acceptHeading(const TestScenario& scenario);

// Of all scenarios and the calibration.
Verdict verdictOf(const TestReport& report);

// A line a scenario: name, checks, state, pictures, time.
std::string testTable(const TestReport& report);

// All failures, a paragraph per scenario, with the command that accepts it, and outdated scenarios; empty if there are
// none.
std::string testFailures(const TestReport& report);

// "3 scenarios: 1 failed, 2 passed, 12.3 s".
std::string testSummary(const TestReport& report);

// Of the calibration; empty when there is none.
std::string calibrationTable(const TestReport& report);

}  // namespace taut::report
