// The entry of libFuzzer: taut_fuzz --target=obj FOLDER goes on with the files of the folder for as long as one likes.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fuzz/targets.h"

// Called by libFuzzer, and one of its own: changes bytes in place and returns how many there are then.
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using namespace taut::fuzz;

// libFuzzer has no other place for the common data of its calls.
const Target*& target() {
    static const Target* chosen = nullptr;
    return chosen;
}

}  // namespace

int LLVMFuzzerInitialize(int* count, char*** arguments) {
    for (const Target& each : targets())
        for (int i = 1; i < *count; ++i)
            if ((*arguments)[i] == "--target=" + std::string(each.name)) target() = &each;
    if (target() != nullptr) return 0;
    std::fputs("usage: taut_fuzz --target=TARGET [FLAGS OF libFuzzer] FOLDER...\n", stderr);
    std::exit(2);
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    give(*target(), {data, size});
    return 0;
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    const Change change = [](Bytes& bytes) {
        const std::size_t before = bytes.size();
        bytes.resize(before + 64);
        bytes.resize(LLVMFuzzerMutate(bytes.data(), before, bytes.size()));
    };
    const Bytes bytes = changed(*target(), Bytes(data, data + size), change, seed);
    if (bytes.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::copy(bytes.begin(), bytes.end(), data);
    return bytes.size();
}
