#include "taut/image/private/video_writer.h"

#include <fmt/format.h>

#include <iterator>
#include <span>
#include <sstream>
#include <vector>

#include "taut/core/error.h"
#include "taut/core/private/child_process.h"
#include "taut/core/whole_file.h"
#include "taut/image/private/with_alpha.h"

namespace taut::image {
namespace {

constexpr int mostGifFps = 50;
constexpr const char* matching = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv";

std::string containerOf(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension == ".mp4") return "mp4";
    if (extension == ".mov") return "mov";
    if (extension == ".mkv") return "matroska";
    if (extension == ".gif") return "gif";
    if (extension == ".webm") return "webm";
    return "";
}

// The words of a text.
std::vector<std::string> wordsOf(const std::string& text) {
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

std::string filmEncoding(const std::string& container, int quality) {
    return fmt::format(
        "-vf {} -c:v libx264 -preset veryfast -crf {} -pix_fmt yuv420p -colorspace bt709 -color_primaries bt709 "
        "-color_trc iec61966-2-1{}",
        matching, quality, container == "matroska" ? "" : " -movflags +faststart");
}

// VP9: its frames that are shown by none hold no alpha. At this rate factor its quality is about that of x264's 18.
std::string webmEncoding(bool hasAlpha) {
    return fmt::format(
        "-vf {} -c:v libvpx-vp9 -deadline good -cpu-used 5 -row-mt 1 -crf 22 -b:v 0 -colorspace bt709 "
        "-color_primaries bt709 -color_trc iec61966-2-1 -pix_fmt {}",
        matching, hasAlpha ? "yuva420p -auto-alt-ref 0" : "yuv420p");
}

// ProRes 4444, which editors take. The encoder has the colours' meaning from the pictures alone.
std::string proresEncoding() {
    return "-vf scale=out_color_matrix=bt709:out_range=tv,format=yuva444p10le,"
           "setparams=colorspace=bt709:color_primaries=bt709:color_trc=bt709 -c:v prores_ks -profile:v 4444 "
           "-alpha_bits 16 -vendor apl0 -colorspace bt709 -color_primaries bt709 -color_trc bt709";
}

// Each picture has its own 256 colours: for common ones ffmpeg would keep all pictures until the last. A GIF counts
// hundredths of a second, and browsers slow down pictures of only one.
std::string gifEncoding(double fps) {
    const std::string palette = "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1";
    return "-vf " + (fps > mostGifFps ? fmt::format("fps={},", mostGifFps) : "") + palette + " -loop 0";
}

}  // namespace

bool mayHaveAlpha(const std::filesystem::path& path) {
    const std::string container = containerOf(path);
    return container == "webm" || container == "mov";
}

bool isVideoPath(const std::filesystem::path& path) {
    return !containerOf(path).empty();
}

VideoWriter::VideoWriter(std::filesystem::path path, VideoOptions options)
    : path_(std::move(path)), options_(std::move(options)) {
    TAUT_EXPECTS(isVideoPath(path_));
    TAUT_EXPECTS(options_.fps > 0.0);
    TAUT_EXPECTS(!options_.alpha || mayHaveAlpha(path_));
    if (!core::isInPath(options_.program))
        throw core::Error(core::ErrorKind::inputOutput,
                          fmt::format("{}: {} is not installed. Install the package 'ffmpeg', or write pictures "
                                      "instead: -o {}/frame_######.png",
                                      path_.string(), options_.program, (path_.parent_path() / path_.stem()).string()));
    expectEncoder();
    core::prepareFolderOf(path_);
    file_ = std::make_unique<core::WholeFile>(path_);
}

VideoWriter::~VideoWriter() = default;

// Not every ffmpeg is built with rarely needed encoders.
void VideoWriter::expectEncoder() const {
    const bool isWebm = containerOf(path_) == "webm";
    if (!isWebm && !options_.alpha) return;
    const std::string encoder = isWebm ? "libvpx-vp9" : "prores_ks";
    const core::ChildResult result = core::runChild({{options_.program, "-hide_banner", "-encoders"}});
    if (!result.end.succeeded() || result.output.find(" " + encoder + " ") != std::string::npos) return;
    throw core::Error(
        core::ErrorKind::inputOutput,
        fmt::format("{}: this {} has no encoder {}; write pictures instead: -o {}/frame_######.png", path_.string(),
                    options_.program, encoder, (path_.parent_path() / path_.stem()).string()));
}

void VideoWriter::start(int width, int height) {
    width_ = width;
    height_ = height;
    const std::string container = containerOf(path_);
    const std::string encoding = container == "gif"    ? gifEncoding(options_.fps)
                                 : container == "webm" ? webmEncoding(options_.alpha)
                                 : options_.alpha      ? proresEncoding()
                                                       : filmEncoding(container, options_.quality);
    std::vector<std::string> arguments = wordsOf(fmt::format(
        "-hide_banner -loglevel error -nostdin -xerror -y -f rawvideo -pixel_format {} -video_size {}x{} -framerate {} "
        "-i pipe:0 -an {} -f {}",
        options_.alpha ? "rgba" : "rgb24", width, height, options_.fps, encoding, container));
    arguments.insert(arguments.begin(), options_.program);
    arguments.push_back("file:" + file_->temporary().string());

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
    const std::vector<std::uint8_t> four = options_.alpha ? withAlpha(image) : std::vector<std::uint8_t>();
    if (!encoder_->write(std::as_bytes(std::span(options_.alpha ? four : image.rgb))))
        fail("ended before it had all pictures");
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
