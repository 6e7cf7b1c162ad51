// `taut test`, `taut record` and `taut replay` as a person calls them: exit codes and messages.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "regression_support.h"
#include "taut/regression/tape.h"

namespace taut {
namespace {

using test::acceptRun;
using test::goldenText;
using test::has;
using test::Outcome;
using test::run;
using test::springText;
using test::TemporaryFolder;
using test::testRun;

TEST(TestCommand, AMissingGoldenHasItsOwnCodeAndTheCommandThatMakesIt) {
    const TemporaryFolder folder;
    test::writeText(folder / "spring.toml", springText("100.0", goldenText));
    const Outcome missing = testRun(folder);
    EXPECT_EQ(missing.code, 8) << missing.err;
    EXPECT_TRUE(has(missing.out, "no golden picture is kept for this frame yet")) << missing.out;
    EXPECT_TRUE(has(missing.out, "--update spring --why \"…\"")) << missing.out;
    EXPECT_TRUE(std::filesystem::exists(folder / "out/report.html"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/spring/000003.png"));

    const Outcome made = acceptRun(folder, "spring", "The first of its kind.");
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_TRUE(has(made.out, "golden/spring/state.tape: state, 27 ticks")) << made.out;
    const Outcome passed = testRun(folder, {"--junit", (folder / "junit.xml").string()});
    EXPECT_EQ(passed.code, 0) << passed.out;
    EXPECT_TRUE(has(passed.out, "same, 27 ticks")) << passed.out;
    EXPECT_TRUE(has(test::contentOf(folder / "junit.xml"), "failures=\"0\""));
}

TEST(TestCommand, ChecksAloneAreEnoughUntilSomethingIsRecorded) {
    const TemporaryFolder folder;
    test::writeText(folder / "spring.toml",
                    springText("100.0", "[[check]]\nthat = \"position(net.spring@#1).y > 0.5\"\n"));
    const Outcome passed = testRun(folder);
    EXPECT_EQ(passed.code, 0) << passed.out;
    EXPECT_TRUE(has(passed.out, "checks only")) << passed.out;
    EXPECT_EQ(testRun(folder, {"--require-goldens"}).code, 8);
    EXPECT_EQ(acceptRun(folder, "spring", "The first of its kind.").code, 0);
    EXPECT_TRUE(has(testRun(folder).out, "same, "));
    std::filesystem::remove(folder / "golden/spring/state.tape");
    EXPECT_EQ(testRun(folder).code, 8) << "the manifest names it";
}

TEST(TestCommand, GoldensOfScenariosThatAreElsewhereAreOneLine) {
    const TemporaryFolder folder;
    for (const std::string name : {"a", "b", "spring"}) {
        test::writeText(folder / (name + ".toml"), springText());
        EXPECT_EQ(acceptRun(folder, name, "The first of its kind.").code, 0);
    }
    for (const char* gone : {"a.toml", "b.toml"}) std::filesystem::remove(folder / gone);
    const Outcome part = testRun(folder);
    EXPECT_EQ(part.code, 0) << part.err;
    const std::size_t first = part.err.find("there are goldens of scenarios that are not in");
    ASSERT_NE(first, std::string::npos) << part.err;
    EXPECT_EQ(part.err.find("there are goldens", first + 1), std::string::npos);
    EXPECT_TRUE(has(part.err, ": a, b\n")) << part.err;
}

// The next update finishes an interrupted one; links that others placed there are not followed.
TEST(TestCommand, ATestOnlyReadsGoldensAndFollowsNoLinkWhenConfined) {
    const TemporaryFolder folder;
    test::writeText(folder / "spring.toml", springText("100.0", goldenText));
    EXPECT_EQ(acceptRun(folder, "spring", "The first of its kind.").code, 0);
    EXPECT_EQ(testRun(folder, {"--confined"}).code, 0);
    test::writeText(folder / "golden/.changes", "remove manifest.json\n");
    const Outcome pending = testRun(folder);
    EXPECT_EQ(pending.code, 6);
    EXPECT_TRUE(has(pending.err, "an update of goldens was broken off here")) << pending.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "golden/manifest.json"));
    std::filesystem::remove(folder / "golden/.changes");
    test::writeText(folder / "secret", "not yours");
    std::filesystem::create_symlink(folder / "secret", folder / "golden/spring/other");
    const Outcome confined = testRun(folder, {"--confined"});
    EXPECT_EQ(confined.code, 3);
    EXPECT_TRUE(has(confined.err, "golden/spring/other is a link")) << confined.err;
    std::filesystem::remove(folder / "golden/spring/other");
    std::filesystem::rename(folder / "golden", folder / "elsewhere");
    std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "golden");
    EXPECT_EQ(testRun(folder).code, 0);
    const Outcome linked = testRun(folder, {"--confined"});
    EXPECT_EQ(linked.code, 3);
    EXPECT_TRUE(has(linked.err, "golden is a link")) << linked.err;
}

TEST(TestCommand, AScenarioThatCannotBeReadKeepsNoneOfTheOthersFromBeingTested) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.toml", "schema = 1\n[run]\nfps = -3\n");
    test::writeText(folder / "spring.toml",
                    springText("100.0", "[[check]]\nthat = \"position(net.spring@#1).y > 0.5\"\n"));
    const Outcome both = testRun(folder);
    EXPECT_EQ(both.code, 3);
    EXPECT_TRUE(has(both.out, "2 scenarios: 1 failed, 1 passed")) << both.out;
    EXPECT_TRUE(has(both.err, "a.toml:3:")) << both.err;
    EXPECT_EQ(testRun(folder, {"--filter", "spring"}).code, 0);
}

TEST(TestCommand, AChangedStateFailsWithTickAndBody) {
    const TemporaryFolder folder;
    test::writeText(folder / "spring.toml", springText());
    EXPECT_EQ(acceptRun(folder, "spring", "The first of its kind.").code, 0);
    test::writeText(folder / "spring.toml", springText("99.0"));
    const Outcome changed = testRun(folder);
    EXPECT_EQ(changed.code, 1);
    EXPECT_TRUE(has(changed.out, "net.spring differs first")) << changed.out;
}

// The text is kept with the goldens: the report shows its changes, and those of its base.
TEST(TestCommand, TheReportShowsWhatChangedInTheText) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "base");
    test::writeText(folder / "base/spring.toml", springText());
    test::writeText(folder / "pull.toml", "schema = 1\nscene = \"base/spring.toml\"\n");
    EXPECT_EQ(acceptRun(folder, "pull", "The first of its kind.").code, 0);
    const Outcome again = acceptRun(folder, "pull", "Nothing new.");
    EXPECT_TRUE(has(again.out, "nothing differs from its goldens")) << again.out;
    test::writeText(folder / "base/spring.toml", springText("99.0"));
    EXPECT_EQ(testRun(folder).code, 1);
    const std::string page = test::contentOf(folder / "out/report.html");
    EXPECT_TRUE(has(page,
                    "<code>\u2212 springs = [ { a = &quot;nail&quot;, b = &quot;bob&quot;, stiffness_N_per_m = "
                    "100.0 } ]</code>"));
    EXPECT_TRUE(has(page, "<code>+ springs = [ { a = &quot;nail&quot;, b = &quot;bob&quot;, stiffness_N_per_m = 99.0"));
    EXPECT_FALSE(has(page, "[collider.ground]"));
}

// The manifest of FOLDER's goldens with another number of bits.
void setBits(const TemporaryFolder& folder, int bits) {
    const std::filesystem::path file = folder / "golden/manifest.json";
    auto json = nlohmann::ordered_json::parse(test::contentOf(file));
    for (auto& scenario : json["scenarios"]) scenario["bits"] = bits;
    test::writeText(file, json.dump(2));
}

// Where there are fewer bits too, both ways: the remedy of the older goldens is an update, of the newer a newer taut.
TEST(TestCommand, GoldensOfOtherBitsAreSaidOnceAndNotCompared) {
    const TemporaryFolder folder;
    const std::string check = "[[check]]\nthat = \"position(net.spring@#1).y > 0.2\"\n";
    for (const char* name : {"a", "b"}) {
        test::writeText(folder / (std::string(name) + ".toml"), springText("100.0", goldenText + check));
        EXPECT_EQ(acceptRun(folder, name, "The first of its kind.").code, 0);
        test::writeText(folder / (std::string(name) + ".toml"), springText("30.0", goldenText + check));
    }
    EXPECT_EQ(testRun(folder).code, 1) << "its state differs";
    for (const int bits : {world::resultBits + 1, world::resultBits - 1}) {
        if (!world::areBits(bits)) continue;
        setBits(folder, bits);
        const Outcome outcome = testRun(folder, {"--junit", (folder / "junit.xml").string()});
        EXPECT_EQ(outcome.code, 8) << outcome.out;
        EXPECT_TRUE(has(outcome.out, "\n" + world::recordedBy(bits) + ": " +
                                         (bits > world::resultBits ? "a, b need a newer taut\n" : "taut test ")))
            << outcome.out;
        EXPECT_EQ(has(outcome.out, " --update a --update b --why "), bits < world::resultBits) << outcome.out;
        EXPECT_TRUE(has(outcome.out, "2 scenarios: 2 outdated")) << outcome.out;
        EXPECT_FALSE(has(outcome.out, "differs")) << outcome.out;
        EXPECT_TRUE(has(test::contentOf(folder / "junit.xml"), "failures=\"0\" errors=\"0\" skipped=\"6\""));
    }
    test::writeText(folder / "b.toml", springText("30.0", goldenText + "[[check]]\nthat = \"speed(rope.line) < 0\"\n"));
    EXPECT_EQ(testRun(folder).code, 1) << "a check that fails is graver";
    EXPECT_EQ(acceptRun(folder, "a", "Results are others.").code, 0);
    const Outcome accepted = testRun(folder, {"--filter", "a"});
    EXPECT_EQ(accepted.code, 0) << accepted.out;
}

// Two scenarios, the second one without golden: the graver failure decides.
TEST(TestCommand, AFailureComesBeforeAMissingGolden) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.toml", springText());
    test::writeText(folder / "b.toml", springText());
    EXPECT_EQ(acceptRun(folder, "a", "The first of its kind.").code, 0);
    EXPECT_EQ(testRun(folder).code, 8);
    EXPECT_EQ(testRun(folder, {"--filter", "a"}).code, 0);
    EXPECT_EQ(testRun(folder, {"--filter", "*a*"}).code, 0);
    test::writeText(folder / "a.toml", springText("99.0"));
    EXPECT_EQ(testRun(folder).code, 1);
    // Explicit Euler far beyond its limit.
    test::writeText(folder / "c.toml", springText("1e7", "[solver]\nintegrator = \"euler\"\ndt = 0.01\n"));
    const Outcome diverged = testRun(folder);
    EXPECT_EQ(diverged.code, 4) << diverged.out;
    EXPECT_TRUE(has(diverged.out, "diverged !")) << diverged.out;
    EXPECT_EQ(acceptRun(folder, "c", "It flies apart.").code, 4);
}

TEST(TestCommand, AFailedCheckSaysValueBoundAndMoment) {
    const TemporaryFolder folder;
    const std::string check = "[[check]]\nthat = \"position(net.spring@#1).y > 0.95\"\n";
    test::writeText(folder / "spring.toml", springText("100.0", check));
    const Outcome failed = testRun(folder);
    EXPECT_EQ(failed.code, 1) << failed.out << failed.err;
    EXPECT_TRUE(has(failed.out, "0/1 !")) << failed.out;
    EXPECT_TRUE(has(failed.out, "0.95")) << failed.out;
    const Outcome refused = acceptRun(folder, "spring", "The first of its kind.");
    EXPECT_EQ(refused.code, 1);
    EXPECT_TRUE(has(refused.err, "a check fails, so no golden was recorded")) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "golden"));
}

struct Refusal {
    const char* what;
    std::vector<std::string> arguments;  // FOLDER stands for the folder
    int code;
    const char* said;
};

TEST(TestCommand, RefusesWhatCannotBeMeant) {
    const TemporaryFolder folder;
    test::writeText(folder / "spring.toml", springText());
    std::filesystem::create_directories(folder / "empty");
    std::filesystem::create_directories(folder / "twice");
    std::filesystem::create_directories(folder / "bad");
    std::filesystem::create_directories(folder / "json/golden");
    test::writeText(folder / "twice/spring.toml", springText());
    test::writeText(folder / "bad/spring.toml", "schema = 1\n[run]\nfps = -1\n");
    test::writeText(folder / "json/spring.toml", springText());
    test::writeText(folder / "json/golden/manifest.json", "{");
    test::writeText(folder / "file", "");
    const std::vector<Refusal> cases = {
        {"nothing to test", {}, 2, "SCENARIOS"},
        {"a folder that is not there", {"FOLDER/none"}, 6, "there is no such file or folder"},
        {"a folder without scenarios", {"FOLDER/empty"}, 6, "there is no scenario in this folder"},
        {"two of one name", {"FOLDER", "FOLDER/twice"}, 2, "two scenarios are called spring"},
        {"a bad scenario", {"FOLDER/bad"}, 3, "spring.toml:3:"},
        {"a bad manifest", {"FOLDER/json"}, 3, "this is no JSON"},
        {"an update without reason", {"FOLDER", "--update", "spring"}, 2, "give the reason with --why"},
        {"an empty reason", {"FOLDER", "--update", "spring", "--why", " "}, 2, "give the reason with --why"},
        {"a reason for nothing", {"FOLDER", "--why", "x"}, 2, "--why needs --update"},
        {"an unknown name", {"FOLDER", "--update", "sprng", "--why", "x"}, 2, "did you mean spring?"},
        {"a filter that fits nothing", {"FOLDER", "--filter", "sprinf"}, 2, "did you mean spring?"},
        {"both ways of choosing", {"FOLDER", "--update", "spring", "--why", "x", "--filter", "a"}, 2, "omit --filter"},
        {"calibrating an update", {"FOLDER", "--update", "spring", "--why", "x", "--calibrate"}, 2, "omit --update"},
        {"nowhere to write", {"FOLDER", "-o", "FOLDER/file/out"}, 6, "file"},
        {"no place for JUnit", {"FOLDER", "-o", "FOLDER/out", "--junit", "FOLDER/file/j.xml"}, 6, "file"},
        {"goldens that are a file",
         {"FOLDER", "--goldens", "FOLDER/file", "--update", "spring", "--why", "x"},
         6,
         "file"},
    };
    for (Refusal row : cases) {
        SCOPED_TRACE(row.what);
        for (std::string& argument : row.arguments)
            if (argument.starts_with("FOLDER")) argument.replace(0, 6, folder.path().string());
        row.arguments.insert(row.arguments.begin(), "test");
        const Outcome outcome = run(row.arguments);
        EXPECT_EQ(outcome.code, row.code) << outcome.out << outcome.err;
        EXPECT_TRUE(has(outcome.err, row.said)) << outcome.err;
    }
}

TEST(Replay, VerifiesARunAgainstItself) {
    const TemporaryFolder folder;
    const std::string tape = (folder / "a.tape").string(), scene = (folder / "s.toml").string();
    test::writeText(scene, springText());
    const Outcome recorded = run({"record", scene, "-o", tape, "--quiet"});
    EXPECT_EQ(recorded.code, 0) << recorded.err;
    EXPECT_TRUE(has(recorded.out, "27 ticks")) << recorded.out;
    EXPECT_EQ(run({"record", scene, "-o", tape, "--quiet"}).code, 6);  // exists already
    EXPECT_EQ(run({"record", scene, "-o", tape, "--quiet", "-y"}).code, 0);
    const Outcome same = run({"replay", tape, "--verify", "--quiet", "--threads", "1"});
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_TRUE(has(same.out, "the same state at all 27 ticks")) << same.out;
    EXPECT_TRUE(has(run({"replay", tape}).out, "27 ticks")) << run({"replay", tape}).out;
}

TEST(Replay, NamesWhatDiffersFromAnotherTapeOrScene) {
    const TemporaryFolder folder;
    const std::string a = (folder / "a.tape").string(), b = (folder / "b.tape").string();
    const std::string scene = (folder / "s.toml").string(), other = (folder / "t.toml").string();
    test::writeText(scene, springText());
    test::writeText(other, springText("99.0"));
    EXPECT_EQ(run({"record", scene, "-o", a, "--quiet"}).code, 0);
    EXPECT_EQ(run({"record", other, "-o", b, "--quiet"}).code, 0);
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"replay", a, "--verify", b, "--quiet"},
                                                      {"replay", a, "--verify", "--scene", other, "--quiet"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 1) << outcome.err;
        EXPECT_TRUE(has(outcome.out, "net.spring differs first, at point 1")) << outcome.out;
    }
    const Outcome noTape = run({"replay", a, "--verify", other});
    EXPECT_EQ(noTape.code, 2);
    EXPECT_TRUE(has(noTape.err, "a scene is played by --verify --scene " + other)) << noTape.err;
    // The tape keeps the text that it played: a change of the file is reported and does not count.
    test::writeText(scene, springText("99.0"));
    const Outcome changed = run({"replay", a, "--verify", "--quiet"});
    EXPECT_EQ(changed.code, 0) << changed.out;
    EXPECT_TRUE(has(changed.err, "s.toml has changed since this tape was recorded; the text")) << changed.err;
}

TEST(Replay, HoldsNoTapeOfOtherBitsAgainstARunOfThese) {
    const TemporaryFolder folder;
    const std::string tape = (folder / "a.tape").string(), scene = (folder / "s.toml").string();
    test::writeText(scene, springText());
    EXPECT_EQ(run({"record", scene, "-o", tape, "--quiet"}).code, 0);
    regression::Tape other = regression::readTape(tape);
    ++other.origin.bits;
    regression::writeTape(tape, other);
    const Outcome outcome = run({"replay", tape, "--verify", "--quiet"});
    EXPECT_EQ(outcome.code, 8);
    EXPECT_EQ(outcome.out, tape + ": " + world::recordedBy(other.origin.bits) + ": it needs a newer taut\n");
    EXPECT_EQ(run({"replay", tape, "--verify", tape}).code, 0) << "two of the same bits";
}

// A tape holds the scene's own text only.
TEST(Replay, NamesWhichOfTheFilesOfItsSceneHasChanged) {
    const TemporaryFolder folder;
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    test::writeText(folder / "stone.obj", obj);
    test::writeText(folder / "s.toml",
                    springText("100.0", "[collider.stone]\nshape = \"mesh\"\nmesh = \"stone.obj\"\n"));
    const std::string tape = (folder / "a.tape").string();
    EXPECT_EQ(run({"record", (folder / "s.toml").string(), "-o", tape, "--quiet"}).code, 0);
    EXPECT_TRUE(has(run({"replay", tape}).out, "depends on " + (folder / "stone.obj").string()));
    EXPECT_EQ(run({"replay", tape, "--verify", "--quiet"}).err, "");
    test::writeText(folder / "stone.obj", obj + "# another\n");
    const Outcome changed = run({"replay", tape, "--verify", "--quiet"});
    EXPECT_EQ(changed.code, 0) << changed.err;
    EXPECT_TRUE(has(changed.err, "stone.obj has changed since this tape was recorded\n")) << changed.err;
}

TEST(Replay, RefusesWhatItCannotPlay) {
    const TemporaryFolder folder;
    test::writeText(folder / "spring.toml", springText());
    test::writeText(folder / "foreign", "something else");
    EXPECT_EQ(acceptRun(folder, "spring", "The first of its kind.").code, 0);
    const std::string golden = (folder / "golden/spring/state.tape").string();
    EXPECT_EQ(run({"replay", (folder / "none").string()}).code, 6);
    EXPECT_EQ(run({"replay", (folder / "foreign").string(), "--verify"}).code, 3);
    EXPECT_EQ(run({"replay", golden, "--verify", (folder / "foreign").string()}).code, 3);
    const Outcome noScene = run({"replay", golden, "--verify"});
    EXPECT_EQ(noScene.code, 2);
    EXPECT_TRUE(has(noScene.err, "--scene")) << noScene.err;
    EXPECT_EQ(run({"replay", golden, "--verify", "--scene", (folder / "spring.toml").string(), "--quiet"}).code, 0);
    EXPECT_EQ(run({"replay", golden, "--scene", "x"}).code, 2);
    EXPECT_EQ(run({"replay", golden, "--verify", golden, "--scene", "x"}).code, 2);
}

}  // namespace
}  // namespace taut
