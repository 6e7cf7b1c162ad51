// A cloth that lies flat in the air, held by two corners, and swings down: a scene in code, played tick by tick.
// Nothing damps it, so that the sum of the energies stays.
#include <cstdio>

#include "taut/bodies/cloth.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

int main() {
    using namespace taut;

    world::SceneSpec scene;
    world::MaterialSpec silk;  // SI units
    silk.density = 0.1;
    silk.stretch = 100.0;
    silk.dampingTime = 0.0;
    silk.drag = 0.0;
    scene.materials["silk"] = silk;

    world::ClothSpec cloth;
    cloth.name = "scarf";
    cloth.size = {1.0, 1.0};
    cloth.cells = {16, 16};
    cloth.origin = {0.0, 2.0, 0.0};  // the top left corner; y is up
    cloth.down = {0.0, 0.0, 1.0};
    cloth.hold = {"top-left", "top-right"};
    cloth.material = "silk";
    scene.bodies.add(cloth);
    scene.solver.safety = 0.5;  // half of the largest step that is stable

    world::World world(scene);
    for (const world::IslandInfo& island : world.islands())
        std::printf("%s: %d points, %d springs, %s, %d steps a tick\n", island.name.c_str(), island.points,
                    island.springs, island.method.c_str(), island.substeps);

    std::printf("time [s]   lowest corner [m]       kinetic  elastic  gravitational      sum [J]\n");
    for (;;) {
        if (world.tick() % 10 == 0) {
            const world::Metrics m = world.metrics();
            const glm::dvec3 corner = world.points("cloth.scarf@bottom-left").x.front();
            std::printf("%8.3f   %6.3f %6.3f %6.3f  %8.5f %8.5f %14.5f %12.5f\n", world.time(), corner.x, corner.y,
                        corner.z, m.kinetic, m.elastic, m.gravitational, m.kinetic + m.elastic + m.gravitational);
        }
        if (world.time() >= 2.0) return 0;
        if (const auto divergence = world.advance()) {
            std::fprintf(stderr, "%s\n", divergence->message.c_str());
            return 1;
        }
    }
}
