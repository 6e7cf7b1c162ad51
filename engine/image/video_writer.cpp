#include "taut/image/video_writer.h"

#include <fmt/format.h>

#include <span>
#include <vector>

#include "taut/core/child_process.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::image {
namespace {

constexpr int mostGifFps = 50;

std::string containerOf(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".mp4") return "mp4";
    if (extension == ".mov") return "mov";
    if (extension == ".mkv") return "matroska";
    if (extension == ".gif") return "gif";
    return "";
}

std::vector<std::string> filmEncoding(const std::string& container, int quality) {
    std::vector<std::string> arguments = {"-vf",
                                          "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
                                          "-c:v",
                                          "libx264",
                                          "-preset",
                                          "veryfast",
                                          "-crf",
                                          fmt::format("{}", quality),
                                          "-pix_fmt",
                                          "yuv420p",
                                          "-colorspace",
                                          "bt709",
                                          "-color_primaries",
                                          "bt709",
                                          "-color_trc",
                                          "iec61966-2-1"};
    if (container != "matroska") arguments.insert(arguments.end(), {"-movflags", "+faststart"});
    return arguments;
}

// Each picture has its own 256 colours: for common ones ffmpeg would keep all pictures until the last. A GIF counts
// hundredths of a second, and browsers slow down pictures of only one.
std::vector<std::string> gifEncoding(double fps) {
    const std::string palette = "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1";
    return {"-vf", (fps > mostGifFps ? fmt::format("fps={},", mostGifFps) : "") + palette, "-loop", "0"};
}

}  // namespace

bool isVideoPath(const std::filesystem::path& path) {
    return !containerOf(path).empty();
}

VideoWriter::VideoWriter(std::filesystem::path path, VideoOptions options)
    : path_(std::move(path)), options_(std::move(options)) {
    TAUT_EXPECTS(isVideoPath(path_));
    TAUT_EXPECTS(options_.fps > 0.0);
    if (!core::isInPath(options_.program))
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{}: {} is not installed. Install the package 'ffmpeg', or write pictures "
                                      "instead: -o {}/frame_######.png",
                                      path_.string(), options_.program, (path_.parent_path() / path_.stem()).string()));
    core::prepareFolderOf(path_);
    file_ = std::make_unique<core::WholeFile>(path_);
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::start(int width, int height) {
    width_ = width;
    height_ = height;
    std::vector<std::string> arguments = {options_.program,
                                          "-hide_banner",
                                          "-loglevel",
                                          "error",
                                          "-nostdin",
                                          "-xerror",
                                          "-y",
                                          "-f",
                                          "rawvideo",
                                          "-pixel_format",
                                          "rgb24",
                                          "-video_size",
                                          fmt::format("{}x{}", width, height),
                                          "-framerate",
                                          fmt::format("{}", options_.fps),
                                          "-i",
                                          "pipe:0",
                                          "-an"};
    const std::string container = containerOf(path_);
    const std::vector<std::string> encoding =
        container == "gif" ? gifEncoding(options_.fps) : filmEncoding(container, options_.quality);
    arguments.insert(arguments.end(), encoding.begin(), encoding.end());
    arguments.insert(arguments.end(), {"-f", container, "file:" + file_->temporary().string()});

    try {
        encoder_ = std::make_unique<core::ChildProcess>(core::ChildCommand{std::move(arguments)});
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), fmt::format("{}: {}", path_.string(), error.what()));
    }
}

void VideoWriter::write(std::int64_t /*frame*/, const Image& image) {
    TAUT_EXPECTS(image.isWhole());
    if (!encoder_) start(image.width, image.height);
    TAUT_EXPECTS(image.width == width_ && image.height == height_);
    if (!encoder_->write(std::as_bytes(std::span(image.rgb)))) fail("ended before it had all pictures");
}

void VideoWriter::finish() {
    if (!encoder_) return;  // no picture, no video
    // The end of its input tells ffmpeg that the last picture has come.
    const core::ChildEnd end = encoder_->wait();
    if (!end.succeeded()) fail(end.text());
    // ffmpeg ends well after some failures to write the end of the file; raw pictures give it nothing else to report.
    if (!encoder_->errors().empty()) fail("reported");
    file_->commit();
    encoder_.reset();
}

void VideoWriter::fail(const std::string& what) {
    const core::ChildEnd end = encoder_->wait();
    const std::string text = encoder_->errors();
    encoder_.reset();
    file_.reset();
    throw core::Error(core::ErrorKind::inputOutput,
                      fmt::format("{}: {} {}{}{}", path_.string(), options_.program, end.hung ? end.text() : what,
                                  text.empty() ? "" : ":\n", text));
}

std::filesystem::path VideoWriter::companion(const std::string& name) const {
    return path_.parent_path() / fmt::format("{}.{}", path_.stem().string(), name);
}

std::string ffmpegVersion(const std::string& program) {
    if (!core::isInPath(program)) return "";
    const core::ChildResult result = core::runChild({{program, "-version"}});
    return result.end.succeeded() ? result.output.substr(0, result.output.find('\n')) : "";
}

}  // namespace taut::image
