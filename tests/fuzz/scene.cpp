#include "fuzz.h"
#include "taut/scene/load.h"

// As if it lay among the shipped scenarios, whose scenes, models and textures it finds, and nothing else.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    taut::scene::LoadOptions options;
    options.assetFolders = {TAUT_SOURCE_DIR "/assets"};
    options.isConfined = true;
    options.memoryLimit = 16e9;
    return taut::fuzz::read([&] {
        taut::scene::loadSceneText(taut::fuzz::textOf(data, size), TAUT_SOURCE_DIR "/assets/scenarios/fuzz.toml", options);
    });
}
