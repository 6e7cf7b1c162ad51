// Where a run's pictures go, and whether what lies there may be overwritten. It knows nothing of what is drawn.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "taut/image/frame_sink.h"

namespace taut::game {

enum class Overwrite { ask, yes, no };

// Looks whether frames first … last of that output, or files of the kinds that go `besides` them
// (image::FramePattern::beside), or that video, are there already. When they are and may not be
// overwritten (no; or ask, and nobody is there to be asked or the answer is not y), throws core::Error(inputOutput).
void permitOverwriting(const std::filesystem::path& output, std::int64_t first, std::int64_t last, Overwrite overwrite,
                       const std::vector<std::string>& besides = {});

// The same of one file.
void permitOverwritingFile(const std::filesystem::path& existing, Overwrite overwrite);

// What a run of very many pictures will take on disk and of time, roughly; empty for others.
std::string largeRunText(std::int64_t pictures, int width, int height);

// A video for a name that ends like one, else a frame sequence. Throws core::Error: usage, inputOutput.
std::unique_ptr<image::FrameSink> makeSink(const std::filesystem::path& output, double fps, bool alpha = false);

// Throws core::Error(usage) when the name is neither a video nor a pattern of frames.
void checkOutputName(const std::filesystem::path& output);

}  // namespace taut::game
