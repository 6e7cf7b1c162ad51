#include "taut/image/frame_sequence.h"

#include <gtest/gtest.h>

#include "image_support.h"
#include "taut/image/private/several_sinks.h"
#include "taut/image/read.h"

namespace taut::image {
namespace {

using core::ErrorKind;
using test::messageOf;
using test::TemporaryFolder;

TEST(FramePattern, PutsTheNumberWhereTheMarksAre) {
    EXPECT_EQ(FramePattern("out/frame_######.png").pathOf(0), "out/frame_000000.png");
    EXPECT_EQ(FramePattern("out/frame_######.png").pathOf(1234567), "out/frame_1234567.png");
    EXPECT_EQ(FramePattern("a##b.png").pathOf(7), "a07b.png");
    EXPECT_EQ(FramePattern("#.png").pathOf(12), "12.png");
}

TEST(FramePattern, FolderMeansFrameWithSixDigits) {
    EXPECT_EQ(FramePattern("out").pathOf(3), "out/frame_000003.png");
    EXPECT_EQ(FramePattern("out/").pathOf(3), "out/frame_000003.png");
    EXPECT_EQ(FramePattern(".").pathOf(3), "./frame_000003.png");
}

TEST(FramePattern, SaysWhatIsWrongAndShowsAnExample) {
    const auto message = [](const char* pattern) {
        return messageOf(ErrorKind::usage, [&] { FramePattern p(pattern); });
    };
    EXPECT_NE(message("out/a.png").find("for example out/a_######.png, and for one picture alone --at"),
              std::string::npos)
        << message("out/a.png");
    EXPECT_NE(message("a#b#.png").find("one place"), std::string::npos);
    EXPECT_NE(message("o#/a.png").find("not into a folder"), std::string::npos);
    EXPECT_NE(message("a###.jpg").find(".png"), std::string::npos);
    EXPECT_NE(message("").find("missing"), std::string::npos);
}

TEST(FrameSequence, WritesAFileAFrameAndKeepsItsCompanionsBeside) {
    const TemporaryFolder folder;
    FrameSequence sequence{FramePattern(folder / "deep/f_###.png")};
    EXPECT_TRUE(std::filesystem::is_empty(folder / "deep"));
    sequence.write(5, test::testPicture(8, 6));
    sequence.write(6, test::testPicture(8, 6));
    sequence.finish();
    EXPECT_EQ(readImage(folder / "deep/f_006.png").rgb, test::testPicture(8, 6).rgb);
    EXPECT_TRUE(std::filesystem::exists(folder / "deep/f_005.png"));
    EXPECT_EQ(sequence.companion("run.json"), folder / "deep/run.json");
}

TEST(FrameSequence, UnwritableFolderFailsBeforeTheFirstFrame) {
    const TemporaryFolder folder;
    test::writeText(folder / "file", "");
    messageOf(ErrorKind::inputOutput, [&] { FrameSequence s{FramePattern(folder / "file/f_#.png")}; });
}

TEST(SeveralSinks, EachGetsEveryFrameAndTheFirstHasTheCompanions) {
    const TemporaryFolder folder;
    std::vector<std::unique_ptr<FrameSink>> sinks;
    sinks.push_back(std::make_unique<FrameSequence>(FramePattern(folder / "a")));
    sinks.push_back(std::make_unique<FrameSequence>(FramePattern(folder / "b")));
    SeveralSinks all(std::move(sinks));
    all.write(3, test::testPicture(8, 6));
    all.finish();
    EXPECT_TRUE(std::filesystem::exists(folder / "a/frame_000003.png"));
    EXPECT_TRUE(std::filesystem::exists(folder / "b/frame_000003.png"));
    EXPECT_EQ(all.companion("run.json"), folder / "a/run.json");
}

}  // namespace
}  // namespace taut::image
