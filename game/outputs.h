// Where a run's pictures go, and whether existing files there may be overwritten. It does not know what is drawn.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "taut/image/frame_sink.h"

namespace taut::game {

enum class Overwrite { ask, yes, no };

class Options;

// -y and -n.
struct OverwriteFlags {
    bool yes = false, no = false;
    Overwrite answer() const { return yes ? Overwrite::yes : no ? Overwrite::no : Overwrite::ask; }
};
void addOverwriteFlags(Options& options, OverwriteFlags& flags);

// Looks for existing frames first … last of that output, for files of the kinds `besides`
// (image::FramePattern::beside), and for that video. If there are any and they may not be overwritten (no; or ask, and
// nobody can answer or the answer is not y), throws core::Error(inputOutput).
void permitOverwriting(const std::filesystem::path& output, std::int64_t first, std::int64_t last, Overwrite overwrite,
                       const std::vector<std::string>& besides = {});

// The same for one file.
void permitOverwritingFile(const std::filesystem::path& existing, Overwrite overwrite);

// What a run of very many pictures will roughly need of disk and time; empty for other runs.
std::string largeRunText(std::int64_t pictures, int width, int height);

// A video if the name ends like one, else a sequence of frames. Throws core::Error: usage, inputOutput.
std::unique_ptr<image::FrameSink> makeSink(const std::filesystem::path& output, double fps, bool alpha = false);

// Throws core::Error(usage) if the name is neither a video nor a pattern of frames.
void checkOutputName(const std::filesystem::path& output);

}  // namespace taut::game
