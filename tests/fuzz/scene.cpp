#include "taut/scene/load.h"

#include "fuzz/support.h"

// As if it lay among the shipped scenarios, whose scenes, models and textures it finds, and nothing else.
void taut::fuzz::readScene(View bytes) {
    scene::LoadOptions options = alone();
    options.assetFolders = {TAUT_SOURCE_DIR "/assets"};
    scene::loadSceneText(textOf(bytes), TAUT_SOURCE_DIR "/assets/scenarios/fuzz.toml", options);
}
