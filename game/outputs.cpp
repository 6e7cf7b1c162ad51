#include "game/outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <system_error>

#include "game/messages.h"
#include "taut/core/error.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/video_writer.h"

namespace taut::game {
namespace {

// The first file that would be overwritten; empty when there is none.
std::filesystem::path firstExisting(const std::filesystem::path& output, std::int64_t first, std::int64_t last) {
    std::error_code ignored;  // a folder that may not be looked into is reported when it is written to
    if (image::isVideoPath(output)) return std::filesystem::exists(output, ignored) ? output : std::filesystem::path();
    const image::FramePattern pattern(output);
    for (std::int64_t frame = first; frame <= last; ++frame)
        if (std::filesystem::exists(pattern.pathOf(frame), ignored)) return pattern.pathOf(frame);
    return {};
}

bool answersYes() {
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "Y" || answer == "yes";
}

}  // namespace

void permitOverwriting(const std::filesystem::path& output, std::int64_t first, std::int64_t last,
                       Overwrite overwrite) {
    if (overwrite == Overwrite::yes) return;
    const std::filesystem::path existing = firstExisting(output, first, last);
    if (existing.empty()) return;
    if (overwrite == Overwrite::ask && ::isatty(STDIN_FILENO) == 1) {
        printNote("{} exists already. Overwrite? [y/N] ", existing.string());
        if (answersYes()) return;
        throw core::Error(core::ErrorKind::inputOutput, "nothing was overwritten");
    }
    throw core::Error(
        core::ErrorKind::inputOutput,
        fmt::format("{} exists already{}", existing.string(), overwrite == Overwrite::no ? "" : "; -y overwrites it"));
}

std::unique_ptr<image::FrameSink> makeSink(const std::filesystem::path& output, double fps) {
    if (image::isVideoPath(output))
        return std::make_unique<image::VideoWriter>(output, image::VideoOptions{.fps = fps});
    return std::make_unique<image::FrameSequence>(image::FramePattern(output));
}

void checkOutputName(const std::filesystem::path& output) {
    if (!image::isVideoPath(output)) image::FramePattern{output};
}

}  // namespace taut::game
