#include "taut/world/world.h"

#include <algorithm>

#include "fuzz.h"
#include "taut/scene/load.h"

namespace {

const taut::world::SceneSpec& scene() {
    static const taut::world::SceneSpec spec = taut::scene::loadSceneText(
        std::string(taut::fuzz::smallScene) +
            "at = [{ t = 0.05, do = \"grab\", id = \"h\", target = \"cloth.a@bottom-right\", radius = 0.3 },\n"
            "      { t = 0.1, do = \"cut\", target = \"cloth.a\", segment = [[0, 0.5], [1, 0.5]] },\n"
            "      { t = 0.1, do = \"ramp\", key = \"material.a.stretch_N_per_m\", to = 200, over_s = 0.2 },\n"
            "      { t = 0.2, do = \"spawn\", target = \"block.a\" }]\n",
        "fuzz.toml", {}).spec;
    return spec;
}

}  // namespace

// A saved state: what is taken as one can be asked and goes on.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return taut::fuzz::read([&] {
        taut::world::World world(scene(), {.threads = 1});
        world.restore(taut::fuzz::bytesOf(data, size));
        if (world.advance()) return;
        (void)world.metrics();
        (void)world.view(true);
    });
}

// The seeds are made here: states of that scene, at any tick.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    if (size > 8) return LLVMFuzzerMutate(data, size, most);
    taut::world::World world(scene(), {.threads = 1});
    while (world.tick() < seed % 30) world.advance();
    const std::vector<std::byte> state = world.save();
    if (state.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::transform(state.begin(), state.end(), data, [](std::byte b) { return static_cast<std::uint8_t>(b); });
    return state.size();
}
