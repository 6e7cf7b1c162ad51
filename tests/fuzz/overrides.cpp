#include "fuzz.h"
#include "taut/scene/load.h"

// A line is what follows one --set.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    taut::scene::LoadOptions options;
    options.isConfined = true;
    options.memoryLimit = 16e9;
    std::string_view text = taut::fuzz::textOf(data, size);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        options.overrides.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return taut::fuzz::read([&] { taut::scene::loadSceneText(taut::fuzz::smallScene, "fuzz.toml", options); });
}
