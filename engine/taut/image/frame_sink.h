// Where finished pictures go, one after the other. It does not know where they come from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "taut/image/image.h"

namespace taut::image {

class FrameSink {
  public:
    virtual ~FrameSink() = default;

    // Takes a picture; frames come in ascending order and all have the same size. Throws core::Error(inputOutput).
    virtual void write(std::int64_t frame, const Image& image) = 0;

    // Makes everything that was written whole and final; throws core::Error(inputOutput). Without it a video does not
    // come into being, while the frames of a sequence stay.
    virtual void finish() = 0;

    // The file that accompanies the output: beside frames "NAME", beside out.mp4 "out.NAME".
    virtual std::filesystem::path companion(const std::string& name) const = 0;
};

}  // namespace taut::image
