#include "taut/image/png.h"

#include <libdeflate.h>

#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/image/private/with_alpha.h"

namespace {

constexpr int compressionLevel = 1;  // 11 ms a 720p picture; level 6 takes 5 times that and saves a fifth

// The two hooks of stb_image_write. The buffer goes back to its free().
unsigned char* compressed(unsigned char* data, int size, int* compressedSize, int /*quality*/) {
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(compressionLevel), &libdeflate_free_compressor);
    if (!compressor || size < 0) return nullptr;
    const auto length = static_cast<std::size_t>(size);
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), length);
    auto* out = static_cast<unsigned char*>(std::malloc(bound));
    if (out == nullptr) return nullptr;
    const std::size_t used = libdeflate_zlib_compress(compressor.get(), data, length, out, bound);
    if (used == 0 || used > static_cast<std::size_t>(std::numeric_limits<int>::max() - 64)) {
        std::free(out);
        return nullptr;
    }
    *compressedSize = static_cast<int>(used);
    return out;
}

unsigned int checksum(unsigned char* data, int size) {
    return libdeflate_crc32(0, data, static_cast<std::size_t>(size));
}

void appendNumber(std::vector<unsigned char>& to, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<unsigned char>(number >> shift));
}

void appendChunk(std::vector<unsigned char>& png, std::string_view type, std::span<const unsigned char> content) {
    appendNumber(png, static_cast<std::uint32_t>(content.size()));
    const std::size_t checked = png.size();
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), content.begin(), content.end());
    appendNumber(png, libdeflate_crc32(0, png.data() + checked, png.size() - checked));
}

}  // namespace

#define STBIW_ZLIB_COMPRESS compressed
#define STBIW_CRC32 checksum
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace taut::image {

std::vector<std::byte> pngBytes(const Image& image) {
    TAUT_EXPECTS(image.isWhole());
    constexpr int filterSub = 1;
    // Set once and never changed, so that several threads may write at once.
    static const bool filterChosen = [] {
        stbi_write_force_png_filter = filterSub;
        return true;
    }();
    TAUT_EXPECTS(filterChosen);

    const bool isOpaque = image.alpha.empty();
    const std::vector<std::uint8_t> four = isOpaque ? std::vector<std::uint8_t>() : withAlpha(image);
    const std::uint8_t* pixels = isOpaque ? image.rgb.data() : four.data();
    const int channels = isOpaque ? 3 : 4;
    int size = 0;
    const std::unique_ptr<unsigned char, decltype(&std::free)> png(
        stbi_write_png_to_mem(pixels, image.width * channels, image.width, image.height, channels, &size), &std::free);
    if (!png) throw std::bad_alloc();
    const auto* first = reinterpret_cast<const std::byte*>(png.get());
    return {first, first + size};
}

std::vector<std::byte> widePngBytes(int width, int height, std::span<const std::uint16_t> numbers,
                                    std::string_view comment) {
    TAUT_EXPECTS(width > 0 && height > 0);
    const auto rows = static_cast<std::size_t>(height), pixels = static_cast<std::size_t>(width) * rows;
    const std::size_t channels = numbers.size() / pixels;
    TAUT_EXPECTS(numbers.size() == channels * pixels && (channels == 1 || channels == 3));
    std::vector<unsigned char> lines;
    lines.reserve(rows + 2 * numbers.size());
    for (std::size_t y = 0; y < rows; ++y) {
        lines.push_back(1);  // SUB: each byte less that of the pixel before
        const auto row = numbers.subspan(y * (numbers.size() / rows), numbers.size() / rows);
        for (std::size_t i = 0; i < row.size(); ++i) {
            const unsigned here = row[i], before = i < channels ? 0U : row[i - channels];
            lines.push_back(static_cast<unsigned char>((here >> 8) - (before >> 8)));
            lines.push_back(static_cast<unsigned char>(here - before));
        }
    }
    if (lines.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw std::bad_alloc();
    int size = 0;
    const std::unique_ptr<unsigned char, decltype(&std::free)> packed(
        compressed(lines.data(), static_cast<int>(lines.size()), &size, 0), &std::free);
    if (!packed) throw std::bad_alloc();

    std::vector<unsigned char> header, png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    appendNumber(header, static_cast<std::uint32_t>(width));
    appendNumber(header, static_cast<std::uint32_t>(height));
    const unsigned char kind = channels == 1 ? 0 : 2;  // grey, RGB
    header.insert(header.end(), {16, kind, 0, 0, 0});  // bits, kind, deflate, filters a row, not interlaced
    std::string text = "Description";
    text += '\0';
    text += comment;
    appendChunk(png, "IHDR", header);
    appendChunk(png, "tEXt", std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
    appendChunk(png, "IDAT", std::span<const unsigned char>(packed.get(), static_cast<std::size_t>(size)));
    appendChunk(png, "IEND", {});
    const auto* first = reinterpret_cast<const std::byte*>(png.data());
    return {first, first + png.size()};
}

void writePng(const std::filesystem::path& path, const Image& image) {
    core::WholeFile file(path);
    file.write(pngBytes(image));
    file.commit();
}

}  // namespace taut::image
