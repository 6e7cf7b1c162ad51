#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "image_support.h"
#include "taut/core/private/child_process.h"
#include "taut/image/private/video_writer.h"

namespace taut::image {
namespace {

using core::ErrorKind;
using test::messageOf;
using test::TemporaryFolder;

// ffprobe's facts about the first stream of a file: "width,height,pixels,rate,frames".
std::string streamOf(const std::filesystem::path& path) {
    const std::string command =
        "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
        "stream=width,height,pix_fmt,r_frame_rate,nb_read_frames -of csv=p=0 '" +
        path.string() + "' 2>&1";
    std::string text;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    char buffer[256];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
    ::pclose(pipe);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

std::filesystem::path script(const TemporaryFolder& folder, const std::string& body) {
    const auto path = folder / "encoder";
    test::writeText(path, "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
}

TEST(VideoWriter, AppearsWholeUnderItsNameWithFinishOnly) {
    const TemporaryFolder folder;
    VideoWriter video(folder / "a.mp4", {.fps = 30.0});
    for (int frame = 0; frame < 5; ++frame) video.write(frame, test::testPicture(64, 48));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mp4"));
    video.finish();
    EXPECT_EQ(streamOf(folder / "a.mp4"), "64,48,yuv420p,30/1,5");
    EXPECT_EQ(folder.entryCount(), 1);
    EXPECT_EQ(video.companion("run.json"), folder / "a.run.json");
}

// With "faststart" the index (moov) stands before the pictures (mdat).
TEST(VideoWriter, IndexComesFirst) {
    const TemporaryFolder folder;
    VideoWriter video(folder / "a.mp4", {});
    for (int frame = 0; frame < 3; ++frame) video.write(frame, test::testPicture(64, 48));
    video.finish();
    const std::string content = test::contentOf(folder / "a.mp4");
    EXPECT_LT(content.find("moov"), content.find("mdat"));
}

TEST(VideoWriter, OddSizesArePaddedToEvenOnes) {
    const TemporaryFolder folder;
    VideoWriter video(folder / "a.mkv", {.fps = 24.0});
    video.write(0, test::testPicture(65, 47));
    video.finish();
    EXPECT_EQ(streamOf(folder / "a.mkv"), "66,48,yuv420p,24/1,1");
}

// Odd sizes stay; 60 pictures a second become 50, and 25 stay 25.
TEST(VideoWriter, AGifIsEncodedByTheSamePipe) {
    const TemporaryFolder folder;
    for (const auto& [fps, text] : {std::pair(60.0, "65,47,bgra,50/1,5"), std::pair(25.0, "65,47,bgra,25/1,6")}) {
        VideoWriter video(folder / "a.gif", {.fps = fps});
        for (int frame = 0; frame < 6; ++frame) video.write(frame, test::testPicture(65, 47));
        video.finish();
        EXPECT_EQ(streamOf(folder / "a.gif"), text);
    }
    EXPECT_EQ(test::contentOf(folder / "a.gif").substr(0, 6), "GIF89a");
}

TEST(VideoWriter, AlphaGoesAlongWhereTheFormatHasIt) {
    const TemporaryFolder folder;
    for (const auto& [name, decoder] : {std::pair("a.webm", "-c:v libvpx-vp9"), {"a.mov", ""}}) {
        Image picture = test::testPicture(64, 48);
        picture.alpha.assign(64 * 48, 255);
        std::fill_n(picture.alpha.begin(), 64 * 24, std::uint8_t{0});
        VideoWriter video(folder / name, {.alpha = true});
        for (int frame = 0; frame < 2; ++frame) video.write(frame, picture);
        video.finish();
        const std::string raw = (folder / "raw").string();
        const std::string decoded = "ffmpeg -v error -y " + std::string(decoder) + " -i '" + (folder / name).string() +
                                    "' -frames:v 1 -vf alphaextract,format=gray -f rawvideo '" + raw + "'";
        ASSERT_EQ(std::system(decoded.c_str()), 0);
        const std::string alpha = test::contentOf(raw);
        ASSERT_EQ(alpha.size(), 64U * 48U);
        EXPECT_LT(static_cast<unsigned char>(alpha[64 * 10 + 32]), 4) << name;  // both encoders lose a little
        EXPECT_GT(static_cast<unsigned char>(alpha[64 * 38 + 32]), 251) << name;
    }
}

TEST(VideoWriter, WithoutFinishNothingStaysAndTheOldVideoIsUntouched) {
    const TemporaryFolder folder;
    test::writeText(folder / "a.mp4", "old");
    {
        VideoWriter video(folder / "a.mp4", {});
        video.write(0, test::testPicture(64, 48));
    }
    EXPECT_EQ(test::contentOf(folder / "a.mp4"), "old");
    EXPECT_EQ(folder.entryCount(), 1);
}

TEST(VideoWriter, MissingProgramIsReportedWithItsPackageBeforeTheFirstFrame) {
    const TemporaryFolder folder;
    for (const char* program : {"no-such-program-here", "/no/such/program"}) {
        const std::string message =
            messageOf(ErrorKind::inputOutput, [&] { VideoWriter v(folder / "a.mp4", {.program = program}); });
        EXPECT_NE(message.find("Install the package 'ffmpeg'"), std::string::npos) << message;
    }
    EXPECT_EQ(folder.entryCount(), 0);
}

TEST(VideoWriter, FailureOfTheEncoderIsReportedInItsOwnWords) {
    const TemporaryFolder folder;
    const auto program = script(folder, "cat >/dev/null; echo 'Unknown encoder libx264' >&2; exit 3");
    VideoWriter video(folder / "a.mp4", {.program = program.string()});
    video.write(0, test::testPicture(64, 48));
    const std::string message = messageOf(ErrorKind::inputOutput, [&] { video.finish(); });
    EXPECT_NE(message.find("exit code 3:\nUnknown encoder libx264"), std::string::npos) << message;
    EXPECT_EQ(folder.entryCount(), 1);  // the script
}

// Writing to a reader that has gone would raise SIGPIPE, whose default ends the process: the test ends with it.
TEST(VideoWriter, EncoderThatEndsEarlyIsAnErrorAndNoSignal) {
    const TemporaryFolder folder;
    const auto before = std::signal(SIGPIPE, SIG_DFL);
    const auto program = script(folder, "echo 'gone' >&2; exit 1");
    VideoWriter video(folder / "a.mp4", {.program = program.string()});
    const std::string message = messageOf(ErrorKind::inputOutput, [&] {
        for (int frame = 0; frame < 100; ++frame) video.write(frame, test::testPicture(320, 240));
    });
    EXPECT_NE(message.find("gone"), std::string::npos) << message;
    std::signal(SIGPIPE, before);
}

TEST(ChildProcess, ThatHangsIsEndedAfterAWhile) {
    using std::chrono::milliseconds;
    core::ChildProcess deaf({.arguments = {"sleep", "1000"}, .patience = milliseconds(50)});
    const std::vector<std::byte> much(1 << 20);
    EXPECT_FALSE(deaf.write(much));
    EXPECT_TRUE(deaf.wait().hung);
    core::ChildProcess endless({.arguments = {"sleep", "1000"}, .patience = milliseconds(50)});
    EXPECT_EQ(endless.wait().text(), "hung, and was ended");
}

// ffmpeg's own message comes through and nothing stays.
TEST(VideoWriter, FullDiskIsReported) {
    const TemporaryFolder folder;
    VideoWriter video(folder / "a.mkv", {});
    const test::FileSizeLimit limit(1000);
    const std::string message = messageOf(ErrorKind::inputOutput, [&] {
        for (int frame = 0; frame < 30; ++frame) video.write(frame, test::testPicture(64, 48));
        video.finish();
    });
    EXPECT_NE(message.find("File too large"), std::string::npos) << message;
    EXPECT_EQ(folder.entryCount(), 0);
}

TEST(VideoWriter, UnwritableFolderFailsBeforeTheFirstFrame) {
    const TemporaryFolder folder;
    test::writeText(folder / "file", "");
    messageOf(ErrorKind::inputOutput, [&] { VideoWriter v(folder / "file/a.mp4", {}); });
}

TEST(VideoWriter, KnowsVideosByTheirEnding) {
    EXPECT_TRUE(isVideoPath("a/b.mp4"));
    EXPECT_TRUE(isVideoPath("b.mkv"));
    EXPECT_TRUE(isVideoPath("b.gif"));
    EXPECT_TRUE(isVideoPath("b.webm"));
    EXPECT_FALSE(isVideoPath("a.mp4/frames"));
    EXPECT_FALSE(isVideoPath("frame_######.png"));
}

}  // namespace
}  // namespace taut::image
