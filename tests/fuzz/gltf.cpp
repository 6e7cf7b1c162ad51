#include "taut/scene/private/gltf_file.h"

#include "fuzz/support.h"

// It names files in a folder that does not exist.
void taut::fuzz::readGltf(View bytes) {
    scene::gltfMeshText(std::string(textOf(bytes)), "/none/fuzz.gltf", {{"/none"}});
}
