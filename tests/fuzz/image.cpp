#include <libdeflate.h>

#include "fuzz.h"
#include "taut/image/read.h"

namespace {

// The checksum of every chunk of a PNG file, made to fit: a length, four letters, data, the checksum.
void mendChecksums(std::uint8_t* data, std::size_t size) {
    if (!taut::fuzz::textOf(data, size).starts_with("\x89PNG\r\n\x1a\n")) return;
    const auto bigEndian = [&](std::size_t at) {
        return std::size_t{data[at]} << 24U | std::size_t{data[at + 1]} << 16U | std::size_t{data[at + 2]} << 8U |
               data[at + 3];
    };
    for (std::size_t at = 8; size - at >= 12;) {
        const std::size_t length = bigEndian(at);
        if (length > size - at - 12) return;
        const std::uint32_t sum = libdeflate_crc32(0, data + at + 4, length + 4);
        for (unsigned i = 0; i < 4; ++i)
            data[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i) & 0xFFU);
        at += 12 + length;
    }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const taut::fuzz::MemoryFile file(data, size);
    return taut::fuzz::read([&] { taut::image::readImage(file.path(), 1 << 16); });
}

// Little would come past the checksums of a PNG file; now and then they are left wrong.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    const std::size_t now = LLVMFuzzerMutate(data, size, most);
    if (seed % 16 != 0) mendChecksums(data, now);
    return now;
}
