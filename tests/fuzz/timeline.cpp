#include "fuzz.h"
#include "taut/scene/body_size.h"
#include "taut/scene/load.h"
#include "taut/world/ticks.h"
#include "taut/world/world.h"

namespace {

// Not what is too much for a moment: very many points, or very small steps.
void play(const taut::world::SceneSpec& scene) {
    if (taut::scene::sizeOf(scene).points > 200) return;
    taut::world::World world(scene, {.threads = 1});
    for (const taut::world::IslandInfo& island : world.islands())
        if (island.substeps > 50) return;
    const std::int64_t last = std::min<std::int64_t>(taut::world::Ticks(scene.run).last(), 40);
    while (world.tick() < last)
        if (world.advance()) return;
    world.view(true);
}

}  // namespace

// What happens to a small scene: [[at]] and whatever else may follow it.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    taut::scene::LoadOptions options;
    options.isConfined = true;
    options.memoryLimit = 16e9;
    std::string text(taut::fuzz::smallScene);
    text += taut::fuzz::textOf(data, size);
    return taut::fuzz::read([&] { play(taut::scene::loadSceneText(text, "fuzz.toml", options).spec); });
}
