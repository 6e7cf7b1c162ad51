// The ticks of python_step.py from C++: seconds of processor time of a world of one scene, tick by tick.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "taut/scene/load.h"
#include "taut/world/world.h"

int main(int count, char** arguments) {
    if (count < 3) return 2;
    taut::world::World world(taut::scene::loadScene(arguments[1], {}).spec, {.threads = 1});
    const int ticks = std::atoi(arguments[2]);
    const auto seconds = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
    while (world.tick() < 30)
        if (world.advance()) return 4;
    const double start = seconds();
    for (int i = 0; i < ticks; ++i)
        if (world.advance()) return 4;
    std::printf("%.6f %016lx\n", seconds() - start, world.stateHash());
}
