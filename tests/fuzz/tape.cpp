#include "taut/regression/tape.h"

#include <algorithm>

#include "fuzz.h"
#include "taut/pipeline/sealed_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const taut::fuzz::MemoryFile file(data, size);
    return taut::fuzz::read([&] { taut::regression::readTape(file.path()); });
}

// Changes what is under the seal and seals it again, or little would come past the checksum; now and then the seal.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    const taut::pipeline::SealedKind kind{"tauttape", 1, "tape", std::uint64_t{1} << 20U};
    std::vector<std::byte> content;
    if (seed % 16 != 0) {
        taut::fuzz::read([&] { content = unsealed(kind, taut::fuzz::bytesOf(data, size), "tape"); });
    }
    if (content.empty()) return LLVMFuzzerMutate(data, size, most);
    const std::size_t before = content.size();
    content.resize(before + 64);
    content.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(content.data()), before, content.size()));
    const std::vector<std::byte> whole = sealed(kind, content);
    if (whole.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::transform(whole.begin(), whole.end(), data, [](std::byte b) { return static_cast<std::uint8_t>(b); });
    return whole.size();
}
