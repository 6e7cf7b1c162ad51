// The places of a run's pictures, and whether existing files there may be overwritten. Independent of drawing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "taut/image/frame_sequence.h"

namespace taut::game {

enum class Overwrite { ask, yes, no };

class Options;

// -y and -n.
struct OverwriteFlags {
    bool yes = false, no = false;
    Overwrite answer() const { return yes ? Overwrite::yes : no ? Overwrite::no : Overwrite::ask; }
};
void addOverwriteFlags(Options& options, OverwriteFlags& flags);

// Looks for existing frames first … last. If there are any and they may not be overwritten (no; or ask, and nobody can
// answer or the answer is not y), throws core::Error(inputOutput).
void permitOverwriting(const std::vector<image::FramePattern>& patterns, std::int64_t first, std::int64_t last,
                       Overwrite overwrite);

// The same for one file.
void permitOverwritingFile(const std::filesystem::path& existing, Overwrite overwrite);

// An estimate of disk and time for a run of very many pictures; empty for other runs.
std::string largeRunText(std::int64_t pictures, int width, int height);

// Throws core::Error(inputOutput).
std::unique_ptr<image::FrameSink> makeVideo(const std::filesystem::path& output, double fps, bool alpha);

}  // namespace taut::game
