// Picture files a frame, numbered. It knows PNG and nothing else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "taut/image/frame_sink.h"

namespace taut::image {

// Names of numbered files: "out/frame_######.png" has the number in six digits (more where it needs more).
class FramePattern {
  public:
    // A path that ends in ".png" must have one run of '#' in its file name; any other path is a folder, whose files
    // are then frame_######.png. Throws core::Error(usage) with an example.
    explicit FramePattern(const std::filesystem::path& pattern);
    // One picture alone, whose name ends in ".png" and has no number.
    static FramePattern ofOne(const std::filesystem::path& picture, std::int64_t frame);

    std::filesystem::path pathOf(std::int64_t frame) const;  // expects frame >= 0
    const std::filesystem::path& folder() const { return folder_; }
    std::string name() const;  // of the files: "frame_######.png"

    // Files of another kind beside these: "out/frame_######.depth.png".
    FramePattern beside(const std::string& kind) const;
    // These files, and those of the kinds beside them.
    std::vector<FramePattern> with(const std::vector<std::string>& kinds) const;

    // The numbers of the frames that are there, ascending; none when the folder is missing.
    std::vector<std::int64_t> framesThere() const;

  private:
    FramePattern() = default;

    std::filesystem::path folder_;
    std::string before_, after_;
    std::size_t digits_ = 6;  // 0: of one picture alone
    std::int64_t only_ = 0;   // its number
};

// CRC-32 of the bytes of a frame's files, one after the other; none where one of them is missing. Throws
// core::Error(inputOutput) where one cannot be read.
std::optional<std::uint32_t> checksumOf(const std::vector<FramePattern>& files, std::int64_t frame);
// Of frames first … last, by several threads.
std::vector<std::optional<std::uint32_t>> checksumsOf(const std::vector<FramePattern>& files, std::int64_t first,
                                                      std::int64_t last);

class FrameSequence : public FrameSink {
  public:
    // Makes the folder; throws core::Error: usage for a bad pattern, inputOutput when nothing can be written there.
    explicit FrameSequence(const FramePattern& pattern);

    // The file of that number; replaces one that is there.
    void write(std::int64_t frame, const Image& image) override;
    void finish() override {}
    std::filesystem::path companion(const std::string& name) const override;

  private:
    FramePattern pattern_;
};

// Image::layers, in files by their names (FramePattern::beside). A picture that has none leaves nothing.
class LayerSequence : public FrameSink {
  public:
    // Makes the folder; throws core::Error(inputOutput).
    explicit LayerSequence(const FramePattern& pattern);

    void write(std::int64_t frame, const Image& image) override;
    void finish() override {}
    std::filesystem::path companion(const std::string& name) const override;

  private:
    FramePattern pattern_;
};

}  // namespace taut::image
