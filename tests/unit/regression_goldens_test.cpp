// The changes of an update, and the test that notices each.
#include "taut/regression/goldens.h"

#include <gtest/gtest.h>

#include "regression_support.h"
#include "taut/image/png.h"
#include "taut/image/read.h"
#include "taut/regression/suite.h"

namespace taut::regression {
namespace {

using test::acceptRun;
using test::goldenText;
using test::has;
using test::Outcome;
using test::springText;
using test::TemporaryFolder;
using test::testRun;

const std::string restartText = "[[golden]]\nframes = [6]\nrestart = true\nsize = [96, 54]\n";

// A scenario with goldens of its own.
void begin(const TemporaryFolder& folder, const std::string& golden) {
    test::writeText(folder / "spring.toml", springText("100.0", golden));
    const Outcome made = acceptRun(folder, "spring", "The first of its kind.");
    ASSERT_EQ(made.code, 0) << made.err;
    ASSERT_EQ(testRun(folder).code, 0);
}

TEST(GoldenUpdate, LeavesWhatAgreesToTheLastByteWithItsReason) {
    const TemporaryFolder folder;
    begin(folder, goldenText);
    const std::string tape = test::contentOf(folder / "golden/spring/state.tape");
    const Outcome again = acceptRun(folder, "spring", "Another reason.");
    EXPECT_EQ(again.code, 0);
    EXPECT_TRUE(has(again.out, "nothing differs from its goldens")) << again.out;
    EXPECT_EQ(test::contentOf(folder / "golden/spring/state.tape"), tape);
    EXPECT_FALSE(has(test::contentOf(folder / "golden/manifest.json"), "Another reason."));
}

TEST(GoldenUpdate, ChangesOnlyThePictureThatDiffers) {
    const TemporaryFolder folder;
    begin(folder, goldenText);
    const auto first = folder / "golden/spring/000003.png", second = folder / "golden/spring/000006.png";
    const std::string kept = test::contentOf(first);
    image::writePng(second, test::testPicture(96, 54));
    const Outcome failed = testRun(folder);
    EXPECT_EQ(failed.code, 1);
    EXPECT_TRUE(has(failed.out, "picture 000006: ")) << failed.out;
    EXPECT_TRUE(has(failed.out, "1/2 !")) << failed.out;
    EXPECT_EQ(acceptRun(folder, "spring", "Now it is right.").code, 0);
    EXPECT_EQ(test::contentOf(first), kept);
    EXPECT_EQ(testRun(folder).code, 0);
    const Manifest manifest = readManifest({folder / "golden"});
    const GoldenScenario& goldens = manifest.scenarios.at("spring");
    EXPECT_EQ(goldens.pictures.at("000003").why, "The first of its kind.");
    EXPECT_EQ(goldens.pictures.at("000006").why, "Now it is right.");
    EXPECT_EQ(goldens.state->why, "The first of its kind.");
    EXPECT_FALSE(goldens.pictures.at("000003").renderer.empty());
}

TEST(GoldenUpdate, DropsWhatIsAskedForNoMore) {
    const TemporaryFolder folder;
    begin(folder, goldenText);
    test::writeText(folder / "spring.toml", springText("100.0", "[[golden]]\nframes = [3]\nsize = [96, 54]\n"));
    const Outcome noted = testRun(folder);
    EXPECT_EQ(noted.code, 0) << noted.out;
    EXPECT_TRUE(has(noted.out, "000006 is asked for no more")) << noted.out;
    EXPECT_EQ(acceptRun(folder, "spring", "One is enough.").code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "golden/spring/000006.png"));
    EXPECT_EQ(readManifest({folder / "golden"}).scenarios.at("spring").pictures.size(), 1U);
}

TEST(Goldens, DamagedAndMissingFilesFailAloneAndSayWhich) {
    const TemporaryFolder folder;
    begin(folder, goldenText);
    test::writeText(folder / "golden/spring/000003.png", "no picture");
    std::filesystem::remove(folder / "golden/spring/000006.png");
    const Outcome outcome = testRun(folder);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.out, "000003.png")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "the manifest names a picture that is not there")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "same, 27 ticks")) << outcome.out;
    EXPECT_EQ(acceptRun(folder, "spring", "Made again.").code, 0);
    test::writeText(folder / "golden/spring/state.tape", "no tape");
    const Outcome tape = testRun(folder);
    EXPECT_EQ(tape.code, 1);
    EXPECT_TRUE(has(tape.out, "this is no tape of taut")) << tape.out;
}

TEST(Goldens, OfAnotherSizeDiffer) {
    const TemporaryFolder folder;
    begin(folder, goldenText);
    test::writeText(folder / "spring.toml", springText("100.0", "[[golden]]\nframes = [3, 6]\nsize = [64, 54]\n"));
    const Outcome outcome = testRun(folder);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.out, "has 64x54 pixels, its golden 96x54")) << outcome.out;
}

// Every eighth row a shade brighter: more than one renderer may differ from itself, less than from another.
TEST(Goldens, OfAnotherRendererAreHeldAgainstTheToleranceForThat) {
    const TemporaryFolder folder;
    begin(folder, goldenText);
    const auto file = folder / "golden/spring/000003.png";
    image::Image picture = image::readImage(file);
    for (int y = 0; y < picture.height; y += 8)
        for (std::size_t i = 0; i < 3U * 96U; ++i) {
            std::uint8_t& value = picture.rgb[static_cast<std::size_t>(y) * 3U * 96U + i];
            value = static_cast<std::uint8_t>(value < 128 ? value + 3 : value - 3);
        }
    image::writePng(file, picture);
    Manifest manifest = readManifest({folder / "golden"});
    manifest.otherRenderer = {4, 0.01, 4, 0.2, 1.0};
    writeManifest(folder / "golden/manifest.json", manifest);
    EXPECT_EQ(testRun(folder).code, 1);
    manifest.scenarios["spring"].pictures["000003"].renderer = "Some Card, 4.6, egl";
    writeManifest(folder / "golden/manifest.json", manifest);
    const Outcome outcome = testRun(folder);
    EXPECT_EQ(outcome.code, 0) << outcome.out;
    EXPECT_TRUE(has(outcome.err, "1 golden picture is of Some Card: held against the tolerance for another renderer"))
        << outcome.err;
}

// A run of other bits than the goldens: differences do not count, and the scenario's own checks still do.
TEST(Goldens, OfOtherBitsFailNothing) {
    const TemporaryFolder folder;
    begin(folder, restartText);
    test::writeText(folder / "spring.toml",
                    springText("30.0", restartText + "[[check]]\nthat = \"position(net.spring@#1).y > 0.2\"\n"));
    SuiteOptions options;
    options.drawing.shaders = std::filesystem::path(TAUT_SOURCE_DIR) / "shaders";
    options.goldens = {folder / "golden"};
    const auto tested = [&](int bits) {
        options.bits = bits;
        std::string renderer;
        return runSuite(readScenarios({folder / "spring.toml"}, {}).scenarios, options, readManifest(options.goldens),
                        renderer, false)
            .front();
    };
    EXPECT_EQ(tested(world::resultBits).verdict, report::Verdict::failed);
    const report::TestScenario other = tested(world::resultBits + 1);
    EXPECT_EQ(other.verdict, report::Verdict::outdated);
    EXPECT_EQ(other.checks.front().verdict, report::Verdict::passed);
    EXPECT_EQ(other.state.bits, world::resultBits);
    EXPECT_EQ(other.state.reason, world::recordedBy(world::resultBits, world::resultBits + 1));
    ASSERT_EQ(other.pictures.size(), 1U);
    EXPECT_EQ(other.pictures[0].verdict, report::Verdict::outdated);
    EXPECT_FALSE(other.pictures[0].golden.empty());
    EXPECT_FALSE(other.pictures[0].figures.empty());
}

// The number of all that goes with the scenario becomes that of the program, and no reason changes.
TEST(GoldenUpdate, OfTheSameResultsByOtherBitsChangesTheNumberAlone) {
    const TemporaryFolder folder;
    begin(folder, restartText);
    const std::string manifest = test::contentOf(folder / "golden/manifest.json");
    const std::string tape = test::contentOf(folder / "golden/spring/state.tape");
    const std::string state = test::contentOf(folder / "golden/spring/000006.state");
    Manifest other = readManifest({folder / "golden"});
    ++other.scenarios["spring"].bits;
    writeManifest(folder / "golden/manifest.json", other);
    Tape newer = readTape(folder / "golden/spring/state.tape");
    ++newer.origin.bits;
    writeTape(folder / "golden/spring/state.tape", newer);
    test::writeText(folder / "golden/spring/000006.state", "of other bits");
    const Outcome updated = acceptRun(folder, "spring", "Another reason.");
    EXPECT_TRUE(has(updated.out, "state.tape: the same state, now of bits ")) << updated.out;
    EXPECT_EQ(test::contentOf(folder / "golden/manifest.json"), manifest);
    EXPECT_EQ(test::contentOf(folder / "golden/spring/state.tape"), tape);
    EXPECT_EQ(test::contentOf(folder / "golden/spring/000006.state"), state);
}

// A picture that starts from a stored state tells of pictures: another stiffness is a matter of the state's test alone.
TEST(GoldenRestart, APictureTestFailsForPicturesAndAStateTestForStates) {
    const TemporaryFolder folder;
    begin(folder, restartText);
    EXPECT_TRUE(std::filesystem::exists(folder / "golden/spring/000006.state"));
    test::writeText(folder / "spring.toml", springText("30.0", restartText));
    const Outcome state = testRun(folder);
    EXPECT_EQ(state.code, 1);
    EXPECT_TRUE(has(state.out, "differs !")) << state.out;
    EXPECT_TRUE(has(state.out, "1/1")) << state.out;

    test::writeText(folder / "spring.toml", springText("100.0", restartText + "[light]\nintensity = 1.0\n"));
    const Outcome picture = testRun(folder);
    EXPECT_EQ(picture.code, 1);
    EXPECT_TRUE(has(picture.out, "same, 27 ticks")) << picture.out;
    EXPECT_TRUE(has(picture.out, "0/1 !")) << picture.out;
}

// Without a restart the picture follows the state.
TEST(GoldenRestart, OtherwiseThePictureTellsThatTheStateDiffersToo) {
    const TemporaryFolder folder;
    begin(folder, goldenText);
    test::writeText(folder / "spring.toml", springText("30.0", goldenText));
    const Outcome outcome = testRun(folder);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(has(outcome.out, "the state that it shows differs too")) << outcome.out;
}

TEST(GoldenRestart, AStateThatDoesNotFitOrIsNotThereIsSaid) {
    const TemporaryFolder folder;
    begin(folder, restartText);
    const auto state = folder / "golden/spring/000006.state";
    const std::string whole = test::contentOf(state);
    test::writeText(state, whole.substr(0, whole.size() / 2));
    const Outcome damaged = testRun(folder);
    EXPECT_EQ(damaged.code, 1);
    EXPECT_TRUE(has(damaged.out, "000006.state")) << damaged.out;
    std::filesystem::remove(state);
    EXPECT_EQ(testRun(folder).code, 8);
    EXPECT_EQ(acceptRun(folder, "spring", "Made again.").code, 0);
    EXPECT_EQ(testRun(folder).code, 0);
}

}  // namespace
}  // namespace taut::regression
