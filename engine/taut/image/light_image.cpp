#include "taut/image/private/light_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/image/private/srgb_curve.h"
#include "taut/image/read.h"

namespace taut::image {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;  // red, green, blue over 256 · 2^(128 - last)

// Reads a Radiance file from front to back; any deviation from the format is an error.
class RadianceFile {
  public:
    RadianceFile(const std::filesystem::path& path, std::string_view content) : path_(path), content_(content) {}

    LightImage read(std::int64_t maxPixels);
    ImageSize size(std::int64_t maxPixels);  // from the head
    void skim(ImageSize size);               // the rest

  private:
    [[noreturn]] void fail(std::string_view reason) const {
        throw core::Error(core::ErrorKind::badContent,
                          fmt::format("{}: not a whole Radiance picture: {}", path_.string(), reason));
    }
    std::uint8_t byte() {
        if (at_ == content_.size()) fail("the file breaks off");
        return static_cast<std::uint8_t>(content_[at_++]);
    }
    std::string_view line() {
        const std::size_t end = content_.find('\n', at_);
        if (end == std::string_view::npos) fail("its head breaks off");
        const std::string_view text = content_.substr(at_, end - at_);
        at_ = end + 1;
        return text.substr(0, text.find_last_not_of(" \t\r") + 1);
    }
    void readHead();
    void readSize(ImageSize& size) const;
    void readScanline(std::span<Rgbe> line);
    void readPlanes(std::span<Rgbe> line);
    void readPixels(std::span<Rgbe> line, Rgbe first);

    const std::filesystem::path& path_;
    std::string_view content_;
    std::size_t at_ = 0;
    double exposure_ = 1.0;  // by which the numbers of the file have been multiplied
    std::string_view size_;
};

bool isRadiance(std::string_view content) {
    const std::string_view first = content.substr(0, content.find_first_of("\r\n"));
    return first == "#?RADIANCE" || first == "#?RGBE";
}

// Lines up to an empty one, and then the size. Unknown ones change nothing that is needed here.
void RadianceFile::readHead() {
    constexpr std::string_view format = "FORMAT=", exposure = "EXPOSURE=";
    line();
    for (std::string_view text = line(); !text.empty(); text = line()) {
        if (text.starts_with(format) && text != "FORMAT=32-bit_rle_rgbe")
            fail(fmt::format("its pixels are \"{}\", not 32-bit_rle_rgbe", text.substr(format.size())));
        if (!text.starts_with(exposure)) continue;
        text.remove_prefix(exposure.size());
        text.remove_prefix(std::min(text.find_first_not_of(" +"), text.size()));
        double factor = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), factor);
        if (error != std::errc() || !std::isfinite(factor) || factor <= 0.0)
            fail(fmt::format("EXPOSURE is \"{}\", not a number above 0", text));
        exposure_ *= factor;
    }
    size_ = line();
}

void RadianceFile::readSize(ImageSize& size) const {
    const char* at = size_.data();
    const char* const end = at + size_.size();
    const auto number = [&](std::string_view before, int& value) {
        if (!std::string_view(at, static_cast<std::size_t>(end - at)).starts_with(before)) return false;
        const auto [after, error] = std::from_chars(at + before.size(), end, value);
        at = after;
        return error == std::errc() && value > 0 && value <= mostEdge;
    };
    if (!number("-Y ", size.height) || !number(" +X ", size.width) || at != end)
        fail(fmt::format(
            "its size is \"{}\", not \"-Y height +X width\" of up to {} pixels, which is from the top, left to right",
            size_, mostEdge));
}

// A line of 8 to 32767 pixels may begin with 2, 2 and its length, and then has its four planes one after another.
void RadianceFile::readScanline(std::span<Rgbe> line) {
    Rgbe first{};
    for (std::uint8_t& value : first) value = byte();
    if (line.size() < 8 || first[0] != 2 || first[1] != 2 || first[2] > 127) {
        readPixels(line, first);
        return;
    }
    const std::size_t length = static_cast<std::size_t>(first[2]) << 8U | first[3];
    if (length != line.size()) fail("a line is not as long as the picture is wide");
    readPlanes(line);
}

// Of each plane, runs: more than 128, and the next byte comes as often as it is above that; else so many bytes.
void RadianceFile::readPlanes(std::span<Rgbe> line) {
    for (std::size_t plane = 0; plane < 4; ++plane) {
        for (std::size_t x = 0; x < line.size();) {
            const std::size_t code = byte(), count = code > 128 ? code - 128 : code;
            if (count == 0 || count > line.size() - x) fail("a run does not end with its line");
            const std::uint8_t value = code > 128 ? byte() : std::uint8_t{0};
            for (std::size_t i = 0; i < count; ++i) line[x++][plane] = code > 128 ? value : byte();
        }
    }
}

// Pixel by pixel; 1, 1, 1 and a number repeat the pixel before, and one that follows another counts 256 times as much.
void RadianceFile::readPixels(std::span<Rgbe> line, Rgbe first) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < line.size();) {
        Rgbe pixel = first;
        if (x > 0)
            for (std::uint8_t& value : pixel) value = byte();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[x++] = pixel;
            shift = 0;
            continue;
        }
        const std::size_t count = shift < 16 ? static_cast<std::size_t>(pixel[3]) << shift : 0;
        if (x == 0 || count == 0 || count > line.size() - x) fail("a run does not end with its line");
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(x), count, line[x - 1]);
        x += count;
        shift += 8;
    }
}

ImageSize RadianceFile::size(std::int64_t maxPixels) {
    readHead();
    ImageSize size;
    readSize(size);
    expectFits(path_, size, maxPixels);
    // A line has four bytes at least; that many are there before memory is taken.
    if ((content_.size() - at_) / 4 < static_cast<std::size_t>(size.height)) fail("the file breaks off");
    return size;
}

void RadianceFile::skim(ImageSize size) {
    std::vector<Rgbe> line(size.width);
    for (int y = 0; y < size.height; ++y) readScanline(line);
}

LightImage RadianceFile::read(std::int64_t maxPixels) {
    const ImageSize found = size(maxPixels);
    LightImage image{found.width, found.height, {}};
    const std::size_t width = static_cast<std::size_t>(image.width);
    std::array<float, 256> units{};
    for (int e = 1; e < 256; ++e)
        units[e] = static_cast<float>(std::clamp(std::ldexp(1.0, e - 136) / exposure_, 0.0, double{brightest}));
    std::vector<Rgbe> line(width);
    image.rgb.reserve(3 * width * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y) {
        readScanline(line);
        for (const Rgbe& pixel : line)
            for (std::size_t i = 0; i < 3; ++i)
                image.rgb.push_back(std::min(static_cast<float>(pixel[i]) * units[pixel[3]], brightest));
    }
    return image;
}

void expectKnown(const std::filesystem::path& path, std::string_view content) {
    if (!content.starts_with("\x89PNG") && !content.starts_with("\xFF\xD8"))
        throw core::Error(core::ErrorKind::badContent,
                          path.string() + ": no picture: it begins neither as Radiance HDR nor as PNG or JPEG");
}

}  // namespace

ImageSize lightImageSize(const std::filesystem::path& path, std::int64_t maxPixels) {
    const std::string content = core::fileContent(path, mostFileBytes);
    if (isRadiance(content)) {
        RadianceFile file(path, content);
        const ImageSize size = file.size(maxPixels);
        file.skim(size);
        return size;
    }
    expectKnown(path, content);
    const Image picture = readImage(path, maxPixels);
    return {picture.width, picture.height};
}

void expectAllAround(const std::filesystem::path& path, ImageSize size) {
    if (size.width == 2 * size.height) return;
    throw core::Error(core::ErrorKind::badContent,
                      fmt::format("{}: this picture has {} x {} pixels; one of all that is around is twice as wide as "
                                  "high (equirectangular)",
                                  path.string(), size.width, size.height));
}

LightImage readLightImage(const std::filesystem::path& path, std::int64_t maxPixels) {
    const std::string content = core::fileContent(path, mostFileBytes);
    if (isRadiance(content)) return RadianceFile(path, content).read(maxPixels);
    expectKnown(path, content);
    const Image bytes = readImage(path, maxPixels);
    const SrgbCurve curve;
    LightImage image{bytes.width, bytes.height, {}};
    image.rgb.reserve(bytes.rgb.size());
    for (const std::uint8_t value : bytes.rgb) image.rgb.push_back(curve.light(value));
    return image;
}

}  // namespace taut::image
