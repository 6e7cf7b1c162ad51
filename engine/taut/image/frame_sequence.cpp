#include "taut/image/frame_sequence.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <charconv>

#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/core/whole_file.h"
#include "taut/image/png.h"

namespace taut::image {

FramePattern::FramePattern(const std::filesystem::path& pattern) {
    const auto fail = [&](const std::string& reason) {
        throw core::Error(core::ErrorKind::usage, fmt::format("{}: {}", pattern.string(), reason));
    };
    if (pattern.empty()) fail("a name for the frames is missing, for example out/frame_######.png");
    const std::string name = pattern.filename().string();
    const std::size_t first = name.find('#');
    if (pattern.parent_path().string().find('#') != std::string::npos)
        fail("'#' stands for the frame number and belongs into the file name, not into a folder's");

    if (pattern.extension() != ".png") {
        if (first != std::string::npos) fail("frames are PNG files: let the name end in .png");
        std::error_code ignored;
        if (pattern.has_extension() && !std::filesystem::is_directory(pattern, ignored))
            fail(
                "pictures are .png files, videos .mp4, .mov, .mkv, .webm or .gif; a new folder of this name ends in /");
        folder_ = pattern;
        before_ = "frame_";
        after_ = ".png";
        return;
    }
    if (first == std::string::npos)
        fail(
            fmt::format("the frame number has no place; put '#' for each digit, for example {}_######.png, and for one "
                        "picture alone --at with its moment, or --frames with its number",
                        (pattern.parent_path() / pattern.stem()).string()));
    const std::size_t last = std::min(name.find_first_not_of('#', first), name.size());
    if (name.find('#', last) != std::string::npos) fail("'#' may stand at one place only");
    folder_ = pattern.parent_path();
    before_ = name.substr(0, first);
    after_ = name.substr(last);
    digits_ = last - first;
}

FramePattern FramePattern::ofOne(const std::filesystem::path& picture, std::int64_t frame) {
    TAUT_EXPECTS(picture.extension() == ".png");
    FramePattern pattern;
    pattern.folder_ = picture.parent_path();
    pattern.before_ = picture.stem().string();
    pattern.after_ = ".png";
    pattern.digits_ = 0;
    pattern.only_ = frame;
    return pattern;
}

std::filesystem::path FramePattern::pathOf(std::int64_t frame) const {
    TAUT_EXPECTS(frame >= 0);
    if (digits_ == 0) return folder_ / (before_ + after_);
    return folder_ / fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

std::string FramePattern::name() const {
    return before_ + std::string(digits_, '#') + after_;
}

std::vector<std::int64_t> FramePattern::framesThere() const {
    std::error_code ignored;
    if (digits_ == 0) return std::vector<std::int64_t>(std::filesystem::exists(pathOf(only_), ignored) ? 1 : 0, only_);
    std::vector<std::int64_t> frames;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.empty() ? "." : folder_, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() < before_.size() + digits_ + after_.size()) continue;
        std::int64_t frame = 0;
        const char* const first = name.data() + before_.size();
        const char* const last = name.data() + name.size() - after_.size();
        const auto [end, error] = std::from_chars(first, last, frame);
        if (error == std::errc() && end == last && frame >= 0 && pathOf(frame).filename() == name)
            frames.push_back(frame);
    }
    std::sort(frames.begin(), frames.end());
    return frames;
}

FramePattern FramePattern::beside(const std::string& kind) const {
    FramePattern other = *this;
    other.after_.insert(other.after_.size() - 4, "." + kind);  // before ".png"
    return other;
}

std::vector<FramePattern> FramePattern::with(const std::vector<std::string>& kinds) const {
    std::vector<FramePattern> all{*this};
    for (const std::string& kind : kinds) all.push_back(beside(kind));
    return all;
}

std::optional<std::uint32_t> checksumOf(const std::vector<FramePattern>& files, std::int64_t frame) {
    constexpr std::uint64_t mostBytes = std::uint64_t{1} << 32U;  // of a picture
    std::uint32_t sum = 0;
    for (const FramePattern& pattern : files) {
        const std::filesystem::path path = pattern.pathOf(frame);
        if (!core::isThere(path)) return std::nullopt;
        const std::string content = core::fileContent(path, mostBytes);
        sum = libdeflate_crc32(sum, content.data(), content.size());
    }
    return sum;
}

std::vector<std::optional<std::uint32_t>> checksumsOf(const std::vector<FramePattern>& files, std::int64_t first,
                                                      std::int64_t last) {
    std::vector<std::optional<std::uint32_t>> sums(std::max<std::int64_t>(0, last + 1 - first));
    core::parallelFor(static_cast<int>(sums.size()), [&](int i) { sums[i] = checksumOf(files, first + i); });
    return sums;
}

FrameSequence::FrameSequence(const FramePattern& pattern) : pattern_(pattern) {
    core::prepareFolderOf(pattern_.pathOf(0));
}

void FrameSequence::write(std::int64_t frame, const Image& image) {
    writePng(pattern_.pathOf(frame), image);
}

std::filesystem::path FrameSequence::companion(const std::string& name) const {
    return pattern_.folder() / name;
}

LayerSequence::LayerSequence(const FramePattern& pattern) : pattern_(pattern) {
    core::prepareFolderOf(pattern_.pathOf(0));
}

void LayerSequence::write(std::int64_t frame, const Image& image) {
    for (const Layer& layer : image.layers) {
        const std::filesystem::path path = pattern_.beside(layer.name).pathOf(frame);
        if (!layer.rgb.empty()) {
            writePng(path, Image{image.width, image.height, layer.rgb});
            continue;
        }
        core::WholeFile file(path);
        file.write(widePngBytes(image.width, image.height, layer.numbers, layer.comment));
        file.commit();
    }
}

std::filesystem::path LayerSequence::companion(const std::string& name) const {
    return pattern_.folder() / name;
}

}  // namespace taut::image
