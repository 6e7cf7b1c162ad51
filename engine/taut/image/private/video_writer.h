// Encodes pictures as an H.264, VP9 or ProRes video or a GIF by piping them to ffmpeg. It knows neither scenes nor GL.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "taut/image/frame_sink.h"

namespace taut::core {
class ChildProcess;
class WholeFile;
}  // namespace taut::core

namespace taut::image {

struct VideoOptions {
    double fps = 60.0;               // pictures a second
    std::string program = "ffmpeg";  // looked up in PATH
    int quality = 18;                // of H.264, constant rate factor: 0 lossless … 51 worst
    bool alpha = false;              // of the pictures goes along; expects mayHaveAlpha()
};

// Whether a path names a video that VideoWriter can write: .mp4, .mov, .mkv, .webm or .gif.
bool isVideoPath(const std::filesystem::path& path);

// Whether such a video can be transparent: .webm (VP9), .mov (ProRes 4444).
bool mayHaveAlpha(const std::filesystem::path& path);

// The video appears under its name when finish() has returned; before, it has a temporary name, and without finish()
// it is removed. A GIF has at most 50 pictures a second. Of a video an odd width or height is padded by one black
// column or row, because yuv420p needs even numbers.
class VideoWriter : public FrameSink {
  public:
    // Finds the program, makes the folder and, under its temporary name, the file. Throws core::Error(inputOutput),
    // with the name of the package if the program is missing, and an alternative if it lacks the encoder. The program
    // starts with the first picture, because the size is unknown before.
    VideoWriter(std::filesystem::path path, VideoOptions options);
    ~VideoWriter() override;
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    // Both throw core::Error(inputOutput) with ffmpeg's own message.
    void write(std::int64_t frame, const Image& image) override;
    void finish() override;
    std::filesystem::path companion(const std::string& name) const override;

  private:
    void expectEncoder() const;
    void start(int width, int height);
    [[noreturn]] void fail(const std::string& what);

    std::filesystem::path path_;
    VideoOptions options_;
    int width_ = 0, height_ = 0;
    std::unique_ptr<core::WholeFile> file_;        // that it writes
    std::unique_ptr<core::ChildProcess> encoder_;  // ffmpeg, from the first picture on
};

// The first line that "ffmpeg -version" prints; empty when it does not run.
std::string ffmpegVersion(const std::string& program = "ffmpeg");

}  // namespace taut::image
