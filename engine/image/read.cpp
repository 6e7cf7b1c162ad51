#include "taut/image/read.h"

#define STBI_NO_STDIO
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_MAX_DIMENSIONS 16384
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <libdeflate.h>
#include <stb/stb_image.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::image {
namespace {

// stb_image takes a JPEG that breaks off for a whole one. Inside the coded data FF is always followed by 00, so an
// end marker behind the last start of a scan is a real one.
bool jpegBreaksOff(const std::string& content) {
    if (!content.starts_with("\xFF\xD8")) return false;
    const std::size_t lastScan = content.rfind("\xFF\xDA");
    const std::size_t end = content.rfind("\xFF\xD9");
    return lastScan == std::string::npos || end == std::string::npos || end < lastScan;
}

std::uint32_t bigEndian(const std::string& content, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(content[at + i]);
    return value;
}

// stb_image looks at no checksum. Each chunk is its length, a name of four letters, data, and a checksum of the two.
bool pngIsDamaged(const std::string& content) {
    if (!content.starts_with("\x89PNG\r\n\x1a\n")) return false;
    std::size_t at = 8;
    while (content.size() - at >= 12) {
        const std::size_t length = bigEndian(content, at);
        if (length > content.size() - at - 12) return true;
        if (libdeflate_crc32(0, content.data() + at + 4, length + 4) != bigEndian(content, at + 8 + length))
            return true;
        if (content.compare(at + 4, 4, "IEND") == 0) return false;
        at += 12 + length;
    }
    return true;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw core::Error(core::ErrorKind::badContent, path.string() + ": not a whole PNG or JPEG picture: " + reason);
}

}  // namespace

Image readImage(const std::filesystem::path& path) {
    const std::string content = core::fileContent(path);
    if (content.empty()) fail(path, "the file is empty");
    if (content.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) fail(path, "the file is too large");
    if (pngIsDamaged(content)) fail(path, "the file breaks off or is damaged");
    if (jpegBreaksOff(content)) fail(path, "the file breaks off");

    Image image;
    int channelsInFile = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(content.data()), static_cast<int>(content.size()),
                              &image.width, &image.height, &channelsInFile, 3),
        &stbi_image_free);
    if (!pixels) fail(path, stbi_failure_reason());
    const std::size_t size = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3;
    image.rgb.assign(pixels.get(), pixels.get() + size);
    return image;
}

}  // namespace taut::image
