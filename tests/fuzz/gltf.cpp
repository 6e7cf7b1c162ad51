#include "taut/scene/private/gltf_file.h"

#include "fuzz/support.h"

// What it names lies in a folder that is not there.
void taut::fuzz::readGltf(View bytes) {
    scene::gltfMeshText(std::string(textOf(bytes)), "/none/fuzz.gltf", {{"/none"}});
}
