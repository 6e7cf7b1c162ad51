#include "game/outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <system_error>

#include "game/command_line.h"
#include "game/messages.h"
#include "taut/core/error.h"
#include "taut/image/private/video_writer.h"

namespace taut::game {
namespace {

bool answersYes() {
    std::string answer;
    std::getline(std::cin, answer);
    return answer == "y" || answer == "Y" || answer == "yes";
}

}  // namespace

void addOverwriteFlags(Options& options, OverwriteFlags& flags) {
    const Option yes = options.flag("-y,--yes", flags.yes, "Overwrite existing files");
    options.flag("-n,--no", flags.no, "Never overwrite").excludes(yes);
}

void permitOverwriting(const std::vector<image::FramePattern>& patterns, std::int64_t first, std::int64_t last,
                       Overwrite overwrite) {
    if (overwrite == Overwrite::yes) return;
    for (const image::FramePattern& pattern : patterns)
        for (const std::int64_t frame : pattern.framesThere())  // looked up once, however many the run has
            if (frame >= first && frame <= last) return permitOverwritingFile(pattern.pathOf(frame), overwrite);
}

void permitOverwritingFile(const std::filesystem::path& existing, Overwrite overwrite) {
    std::error_code ignored;
    if (overwrite == Overwrite::yes || !std::filesystem::exists(existing, ignored)) return;
    if (overwrite == Overwrite::ask && ::isatty(STDIN_FILENO) == 1) {
        printNote("{} exists already. Overwrite? [y/N] ", existing.string());
        if (answersYes()) return;
        throw core::Error(core::ErrorKind::inputOutput, "nothing was overwritten");
    }
    throw core::Error(
        core::ErrorKind::inputOutput,
        fmt::format("{} exists already{}", existing.string(), overwrite == Overwrite::no ? "" : "; -y overwrites it"));
}

std::string largeRunText(std::int64_t pictures, int width, int height) {
    constexpr std::int64_t many = 100000;
    if (pictures < many) return "";
    constexpr double bytesOfPixel = 0.5,
                     picturesOfSecond = 100.0;  // of the shipped scenes' PNG files; of a quick machine
    const double count = static_cast<double>(pictures);
    return fmt::format(
        "{} pictures of {} x {} pixels: about {:.3g} GB of PNG files, and {:.3g} hours at {} pictures a "
        "second",
        pictures, width, height, 1e-9 * count * bytesOfPixel * width * height, count / picturesOfSecond / 3600.0,
        picturesOfSecond);
}

std::unique_ptr<image::FrameSink> makeVideo(const std::filesystem::path& output, double fps, bool alpha) {
    return std::make_unique<image::VideoWriter>(output, image::VideoOptions{.fps = fps, .alpha = alpha});
}

}  // namespace taut::game
