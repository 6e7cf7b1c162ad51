#include "taut/regression/manifest.h"

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return taut::fuzz::read(
        [&] { taut::regression::readManifestText(std::string(taut::fuzz::textOf(data, size)), "manifest.json"); });
}
