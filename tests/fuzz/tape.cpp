#include "taut/regression/tape.h"

#include "fuzz/support.h"
#include "taut/pipeline/sealed_file.h"

namespace taut::fuzz {

void readTape(View bytes) {
    regression::readTape(MemoryFile(bytes).path());
}

// Changes the content under the seal and seals it again, or little would come past the checksum; now and then the seal.
Bytes changedTape(const Bytes& bytes, const Change& change, unsigned number) {
    const pipeline::SealedKind kind{
        .mark = "tauttape", .version = 3, .title = "tape", .oldest = 1, .maxContent = std::uint64_t{1} << 20U};
    Bytes content;
    try {
        if (number % 16 != 0) content = copyOf(unsealed(kind, std::as_bytes(std::span(bytes)), "tape"));
    } catch (const core::Error&) {
        content.clear();
    }
    if (content.empty()) {
        content = bytes;
        change(content);
        return content;
    }
    change(content);
    return copyOf(sealed(kind, std::as_bytes(std::span(content))));
}

}  // namespace taut::fuzz
