#include "fuzz/targets.h"

#include "taut/core/error.h"

namespace taut::fuzz {

std::span<const Target> targets() {
    static constexpr Target all[] = {
        {"check", readCheck},
        {"gltf", readGltf},
        {"image", readImage, changedImage},
        {"light", readLightImage},
        {"manifest", readManifest},
        {"obj", readObj},
        {"overrides", readOverrides},
        {"play", readPlay},
        {"scene", readScene},
        {"tape", readTape, changedTape},
        {"timeline", readTimeline},
        {"world", readWorld, changedWorld},
    };
    return all;
}

void give(const Target& target, View bytes) {
    try {
        target.read(bytes);
    } catch (const core::Error& error) {
        TAUT_EXPECTS(!std::string_view(error.what()).empty());
    }
}

Bytes changed(const Target& target, Bytes bytes, const Change& change, unsigned number) {
    if (target.changed != nullptr) return target.changed(bytes, change, number);
    change(bytes);
    return bytes;
}

}  // namespace taut::fuzz
