#include "fuzz/support.h"
#include "taut/scene/private/body_size.h"
#include "taut/spec/ticks.h"
#include "taut/world/world.h"

namespace taut::fuzz {
namespace {

// Excludes long runs: very many points, or very small steps.
void play(const world::SceneSpec& spec) {
    if (scene::sizeOf(spec).points > 200) return;
    world::World world(spec, {.threads = 1});
    for (const world::IslandInfo& island : world.islands())
        if (island.substeps > 50) return;
    const std::int64_t last = std::min<std::int64_t>(world::Ticks(spec.run).last(), 40);
    while (world.tick() < last)
        if (world.advance()) return;
    (void)world.view(true);
}

}  // namespace

// The actions of a small scene: [[at]] and other tables that may follow it.
void readTimeline(View bytes) {
    play(scene::loadSceneText(std::string(smallScene) + std::string(textOf(bytes)), "fuzz.toml", alone()).spec);
}

}  // namespace taut::fuzz
