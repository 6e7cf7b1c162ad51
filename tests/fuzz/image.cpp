#include <libdeflate.h>

#include "fuzz/support.h"
#include "taut/image/private/light_image.h"
#include "taut/image/read.h"

namespace taut::fuzz {
namespace {

std::size_t chunkLength(const Bytes& bytes, std::size_t at) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | bytes[at + i];
    return length;
}

// The checksum of every chunk of a PNG file, made to fit: a length, four letters, data, the checksum.
void mendChecksums(Bytes& bytes) {
    if (!textOf(bytes).starts_with("\x89PNG\r\n\x1a\n")) return;
    for (std::size_t at = 8; bytes.size() - at >= 12;) {
        const std::size_t length = chunkLength(bytes, at);
        if (length > bytes.size() - at - 12) return;
        const std::uint32_t sum = libdeflate_crc32(0, bytes.data() + at + 4, length + 4);
        for (unsigned i = 0; i < 4; ++i)
            bytes[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i) & 0xFFU);
        at += 12 + length;
    }
}

}  // namespace

void readImage(View bytes) {
    image::readImage(MemoryFile(bytes).path(), 1 << 16);
}

void readLightImage(View bytes) {
    image::readLightImage(MemoryFile(bytes).path(), 1 << 16);
}

// Little would come past the checksums of a PNG file; now and then they are left wrong.
Bytes changedImage(const Bytes& bytes, const Change& change, unsigned number) {
    Bytes now = bytes;
    change(now);
    if (number % 16 != 0) mendChecksums(now);
    return now;
}

}  // namespace taut::fuzz
