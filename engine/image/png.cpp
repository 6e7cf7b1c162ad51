#include "taut/image/png.h"

#include <libdeflate.h>

#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

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

    int size = 0;
    const std::unique_ptr<unsigned char, decltype(&std::free)> png(
        stbi_write_png_to_mem(image.rgb.data(), image.width * 3, image.width, image.height, 3, &size), &std::free);
    if (!png) throw std::bad_alloc();
    const auto* first = reinterpret_cast<const std::byte*>(png.get());
    return {first, first + size};
}

void writePng(const std::filesystem::path& path, const Image& image) {
    core::WholeFile file(path);
    file.write(pngBytes(image));
    file.commit();
}

}  // namespace taut::image
