#include "taut/image/read.h"

#define STBI_NO_STDIO
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_ASSERT(condition) static_cast<void>(0)  // it asserts what a file says
#define STBI_MAX_DIMENSIONS 16384
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <libdeflate.h>
#include <stb/stb_image.h>

#include <cstdint>
#include <memory>
#include <string>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::image {
namespace {

constexpr std::uint64_t maxBytes = std::uint64_t{1} << 30U;  // of a file; stb_image counts them in an int

std::uint32_t bigEndian(const std::string& content, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(content[at + i]);
    return value;
}

bool isPng(const std::string& content) {
    return content.starts_with("\x89PNG\r\n\x1a\n");
}

bool isJpeg(const std::string& content) {
    return content.starts_with("\xFF\xD8");
}

// stb_image looks at no checksum. Each chunk is its length, a name of four letters, data, and a checksum of the two.
bool pngIsDamaged(const std::string& content) {
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

std::size_t byteAt(const std::string& content, std::size_t at) {
    return static_cast<unsigned char>(content[at]);
}

// What a JPEG file has defined so far, a bit a table: stb_image decodes with tables that were never filled.
struct JpegTables {
    unsigned huffman[2] = {0, 0};  // of DC, of AC
    bool isProgressive = false;

    bool has(std::size_t kind, std::size_t number) const { return (huffman[kind] >> number & 1U) != 0; }
};

// A Huffman table holds a symbol for each of 256 values at most (ITU-T T.81, B.2.4.2); stb_image believes more.
bool huffmanTablesFit(const std::string& content, std::size_t at, std::size_t end, JpegTables& tables) {
    while (at < end) {
        if (end - at < 17) return false;
        std::size_t symbols = 0;
        for (std::size_t i = 1; i <= 16; ++i) symbols += byteAt(content, at + i);
        if (symbols > 256 || end - at - 17 < symbols) return false;
        const std::size_t kind = byteAt(content, at) >> 4U, number = byteAt(content, at) & 15U;
        if (kind > 1 || number > 3) return false;
        tables.huffman[kind] |= 1U << number;
        at += 17 + symbols;
    }
    return true;
}

// The head of a scan (T.81, B.2.3): how many components, two bytes each, the first and last coefficient, two of four
// bits. A progressive one needs the tables of what it codes: DC values when they come first, AC values always.
bool scanHasItsTables(const std::string& content, std::size_t at, std::size_t end, const JpegTables& tables) {
    const std::size_t components = at < end ? byteAt(content, at) : 0;
    if (end - at != 4 + 2 * components) return false;
    const bool isFirst = byteAt(content, end - 3) == 0, isRefined = byteAt(content, end - 1) >> 4U != 0;
    const bool needsDc = !tables.isProgressive || (isFirst && !isRefined), needsAc = !tables.isProgressive || !isFirst;
    for (std::size_t i = at + 1; i + 3 < end; i += 2) {
        const std::size_t dc = byteAt(content, i + 1) >> 4U, ac = byteAt(content, i + 1) & 15U;
        if ((needsDc && !tables.has(0, dc)) || (needsAc && !tables.has(1, ac))) return false;
    }
    return true;
}

// Whether the segments of a JPEG file (T.81, annex B) do not follow each other to the marker of its end, or its tables
// are larger than they may be or missing; stb_image looks at none of it.
bool jpegIsDamaged(const std::string& content) {
    bool hasScan = false;
    JpegTables tables;
    for (std::size_t at = 2; at + 1 < content.size();) {
        if (byteAt(content, at) != 0xFF) return true;
        const std::size_t marker = byteAt(content, at + 1);
        if (marker == 0xFF) {  // fills up
            ++at;
            continue;
        }
        if (marker == 0xD9) return !hasScan;
        if (at + 4 > content.size()) return true;
        const std::size_t length = byteAt(content, at + 2) << 8U | byteAt(content, at + 3);
        const std::size_t end = at + 2 + length;
        if (length < 2 || end > content.size()) return true;
        if (marker == 0xC2) tables.isProgressive = true;
        if (marker == 0xC4 && !huffmanTablesFit(content, at + 4, end, tables)) return true;
        if (marker == 0xDA && !scanHasItsTables(content, at + 4, end, tables)) return true;
        at = end;
        if (marker != 0xDA) continue;
        hasScan = true;
        // Coded data: FF stands before 00, or before the number of a restart, and FF before these fills up; before
        // anything else it begins a segment.
        for (; at + 1 < content.size(); ++at) {
            const std::size_t next = byteAt(content, at + 1);
            if (byteAt(content, at) == 0xFF && next != 0 && next != 0xFF && (next < 0xD0 || next > 0xD7)) break;
        }
    }
    return true;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw core::Error(core::ErrorKind::badContent, path.string() + ": not a whole PNG or JPEG picture: " + reason);
}

// A file that has been looked through, and what its head says.
struct Content {
    std::string bytes;
    ImageSize size;
    int channels = 0;
    const stbi_uc* data() const { return reinterpret_cast<const stbi_uc*>(bytes.data()); }
    int length() const { return static_cast<int>(bytes.size()); }
};

Content wholeContent(const std::filesystem::path& path, std::int64_t maxPixels) {
    Content content;
    content.bytes = core::fileContent(path, maxBytes);
    const std::string& bytes = content.bytes;
    if (bytes.empty()) fail(path, "the file is empty");
    // Without this, what is not looked through here might be a JPEG picture to stb_image all the same.
    if (!isPng(bytes) && !isJpeg(bytes)) fail(path, "it begins as neither does");
    if (isPng(bytes) ? pngIsDamaged(bytes) : jpegIsDamaged(bytes)) fail(path, "the file breaks off or is damaged");

    ImageSize& size = content.size;
    if (stbi_info_from_memory(content.data(), content.length(), &size.width, &size.height, &content.channels) == 0)
        fail(path, stbi_failure_reason());
    if (std::int64_t{size.width} * size.height > maxPixels)
        throw core::Error(core::ErrorKind::badContent, path.string() + ": this picture has " +
                                                           std::to_string(size.width) + " x " +
                                                           std::to_string(size.height) + " pixels; up to " +
                                                           std::to_string(maxPixels / 1000000) + " million are read");
    return content;
}

// The pixels of a whole picture, so many channels each; its size goes to `image`.
using Pixels = std::unique_ptr<stbi_uc, decltype(&stbi_image_free)>;
Pixels readPixels(const std::filesystem::path& path, std::int64_t maxPixels, bool keepsAlpha, Image& image,
                  std::size_t& channels) {
    const Content content = wholeContent(path, maxPixels);
    const int wanted = keepsAlpha && content.channels % 2 == 0 ? 4 : 3;  // grey and colours with alpha have 2 and 4
    int channelsInFile = 0;
    Pixels pixels(
        stbi_load_from_memory(content.data(), content.length(), &image.width, &image.height, &channelsInFile, wanted),
        &stbi_image_free);
    if (!pixels) fail(path, stbi_failure_reason());
    channels = static_cast<std::size_t>(wanted);
    return pixels;
}

Image read(const std::filesystem::path& path, std::int64_t maxPixels, bool keepsAlpha) {
    Image image;
    std::size_t channels = 3;
    const Pixels pixels = readPixels(path, maxPixels, keepsAlpha, image, channels);
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (channels == 3) {
        image.rgb.assign(pixels.get(), pixels.get() + 3 * count);
        return image;
    }
    image.rgb.resize(3 * count);
    image.alpha.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] = pixels.get()[4 * i + c];
        image.alpha[i] = pixels.get()[4 * i + 3];
    }
    return image;
}

}  // namespace

ImageSize imageSize(const std::filesystem::path& path, std::int64_t maxPixels) {
    return wholeContent(path, maxPixels).size;
}

Image readImage(const std::filesystem::path& path, std::int64_t maxPixels) {
    return read(path, maxPixels, false);
}

Image readImageWithAlpha(const std::filesystem::path& path, std::int64_t maxPixels) {
    return read(path, maxPixels, true);
}

}  // namespace taut::image
