// Gives each picture to several sinks: frames and a video from one run. Independent of the kinds of sinks.
#pragma once

#include <memory>
#include <vector>

#include "taut/image/frame_sink.h"

namespace taut::image {

class SeveralSinks : public FrameSink {
  public:
    // Expects at least one, none null; files that accompany the output lie with the first.
    explicit SeveralSinks(std::vector<std::unique_ptr<FrameSink>> sinks);

    void write(std::int64_t frame, const Image& image) override;
    void finish() override;
    std::filesystem::path companion(const std::string& name) const override;

  private:
    std::vector<std::unique_ptr<FrameSink>> sinks_;
};

}  // namespace taut::image
