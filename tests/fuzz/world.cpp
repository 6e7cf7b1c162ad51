#include "taut/world/world.h"

#include "fuzz/support.h"

namespace taut::fuzz {
namespace {

const world::SceneSpec& sceneOfStates() {
    static const world::SceneSpec spec =
        scene::loadSceneText(
            std::string(smallScene) +
                "[[at]]\nt = 0.05\ndo = \"grab\"\nid = \"h\"\ntarget = \"cloth.a@bottom-right\"\nradius = 0.3\n"
                "[[at]]\nt = 0.1\ndo = \"move\"\nid = \"h\"\nrotation_deg = [0, 90, 0]\nover_s = 0.2\n"
                "[[at]]\nt = 0.15\ndo = \"hold\"\ntarget = \"cloth.a@top-right\"\nhold_on = \"collider.a\"\n"
                "[[at]]\nt = 0.15\ndo = \"move\"\ntarget = \"collider.a\"\nrotation_deg = [0, 0, 90]\nover_s = 0.1\n"
                "[[at]]\nt = 0.1\ndo = \"cut\"\ntarget = \"cloth.a\"\nsegment = [[0, 0.5], [1, 0.5]]\n"
                "[[at]]\nt = 0.1\ndo = \"ramp\"\nkey = \"material.a.stretch_N_per_m\"\nto = 200\nover_s = 0.2\n"
                "[[at]]\nt = 0.2\ndo = \"spawn\"\ntarget = \"block.a\"\n",
            "fuzz.toml", alone())
            .spec;
    return spec;
}

}  // namespace

// A saved state: an accepted one answers queries and continues.
void readWorld(View bytes) {
    world::World world(sceneOfStates(), {.threads = 1});
    world.restore(std::as_bytes(bytes));
    if (world.advance()) return;
    (void)world.metrics();
    (void)world.view(true);
}

// The seeds are made here: of next to nothing becomes a state, at any tick.
Bytes changedWorld(const Bytes& bytes, const Change& change, unsigned number) {
    Bytes now = bytes;
    if (now.size() > 8) {
        change(now);
        return now;
    }
    world::World world(sceneOfStates(), {.threads = 1});
    while (world.tick() < number % 30) world.advance();
    return copyOf(world.save());
}

}  // namespace taut::fuzz
