#include "taut/image/read.h"

#include <fmt/format.h>
#include <spng.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "taut/core/error.h"
#include "taut/core/file_part.h"

namespace taut::image {
namespace {

constexpr std::size_t mostExtra = std::size_t{1}
                                  << 26U;  // [bytes] of the data in a PNG file beside its pixels, unpacked

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw core::Error(core::ErrorKind::badContent, path.string() + ": not a whole PNG or JPEG picture: " + reason);
}

[[noreturn]] void failDamaged(const std::filesystem::path& path, const std::string& reason) {
    fail(path, fmt::format("the file breaks off or is damaged ({})", reason));
}

// The number of pixels of such a picture.
std::size_t fittingCount(const std::filesystem::path& path, ImageSize size, std::int64_t maxPixels) {
    if (std::max(size.width, size.height) > mostEdge)
        fail(path, fmt::format("more than {} pixels a side are too many", mostEdge));
    expectFits(path, size, maxPixels);
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

Image pngImage(const std::filesystem::path& path, const std::string& content, std::int64_t maxPixels, bool keepsAlpha) {
    const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> png(spng_ctx_new(0), &spng_ctx_free);
    const auto expect = [&](int error) {
        if (error != SPNG_OK) failDamaged(path, spng_strerror(error));
    };
    expect(spng_set_chunk_limits(png.get(), mostExtra, mostExtra));
    expect(spng_set_crc_action(png.get(), SPNG_CRC_ERROR, SPNG_CRC_ERROR));
    expect(spng_set_png_buffer(png.get(), content.data(), content.size()));
    spng_ihdr head{};
    expect(spng_get_ihdr(png.get(), &head));
    Image image{static_cast<int>(head.width), static_cast<int>(head.height), {}};
    const std::size_t count = fittingCount(path, {image.width, image.height}, maxPixels);
    spng_trns ignored{};
    const bool hasAlpha = keepsAlpha && ((head.color_type & SPNG_COLOR_TYPE_GRAYSCALE_ALPHA) != 0 ||
                                         spng_get_trns(png.get(), &ignored) == SPNG_OK);

    std::vector<std::uint8_t> pixels(count * (hasAlpha ? 4 : 3));
    expect(spng_decode_image(png.get(), pixels.data(), pixels.size(), hasAlpha ? SPNG_FMT_RGBA8 : SPNG_FMT_RGB8,
                             hasAlpha ? SPNG_DECODE_TRNS : 0));
    expect(spng_decode_chunks(png.get()));  // those behind the pixels; that there is an end is not asked for
    if (content.find(std::string("\0\0\0\0IEND\xAE\x42\x60\x82", 12)) == std::string::npos) failDamaged(path, "no end");
    if (!hasAlpha) {
        image.rgb = std::move(pixels);
        return image;
    }
    image.rgb.resize(3 * count);
    image.alpha.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::copy_n(&pixels[4 * i], 3, &image.rgb[3 * i]);
        image.alpha[i] = pixels[4 * i + 3];
    }
    return image;
}

Image jpegImage(const std::filesystem::path& path, const std::string& content, std::int64_t maxPixels) {
    const std::unique_ptr<void, decltype(&tjDestroy)> jpeg(tjInitDecompress(), &tjDestroy);
    const auto expect = [&](int error) {
        if (error != 0) failDamaged(path, tjGetErrorStr2(jpeg.get()));
    };
    const auto* bytes = reinterpret_cast<const unsigned char*>(content.data());
    Image image;
    int sampling = 0, colours = 0;
    expect(tjDecompressHeader3(jpeg.get(), bytes, content.size(), &image.width, &image.height, &sampling, &colours));
    if (colours == TJCS_CMYK || colours == TJCS_YCCK) fail(path, "its colours are CMYK: save it as RGB");
    image.rgb.resize(3 * fittingCount(path, {image.width, image.height}, maxPixels));
    // Without the last two it would fill up missing data, and take hours for a few bytes.
    expect(tjDecompress2(jpeg.get(), bytes, content.size(), image.rgb.data(), 0, 0, 0, TJPF_RGB,
                         TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS));
    return image;
}

Image read(const std::filesystem::path& path, std::int64_t maxPixels, bool keepsAlpha) {
    const std::string content = core::filePartContent(path, mostFileBytes);
    if (content.empty()) fail(path, "the file is empty");
    if (content.starts_with("\x89PNG\r\n\x1a\n")) return pngImage(path, content, maxPixels, keepsAlpha);
    if (content.starts_with("\xFF\xD8")) return jpegImage(path, content, maxPixels);
    fail(path, "it begins as neither does");
}

}  // namespace

void expectFits(const std::filesystem::path& path, ImageSize size, std::int64_t maxPixels) {
    if (std::int64_t{size.width} * size.height <= maxPixels) return;
    throw core::Error(core::ErrorKind::badContent,
                      fmt::format("{}: this picture has {} x {} pixels; up to {} million are read", path.string(),
                                  size.width, size.height, maxPixels / 1000000));
}

Image readImage(const std::filesystem::path& path, std::int64_t maxPixels) {
    return read(path, maxPixels, false);
}

Image readImageWithAlpha(const std::filesystem::path& path, std::int64_t maxPixels) {
    return read(path, maxPixels, true);
}

}  // namespace taut::image
