// The loop of a game. The world ticks at a pace of its own; a picture comes when the machine is ready for one, and
// shows a moment between the last two ticks. A saved state continues, in a new world, with the same bits.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "taut/bodies/rope.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

using namespace taut;

// A rope that is thrown and turns; its centre of mass falls like a stone: 2 + 5 t - g t²/2.
world::SceneSpec throwRope() {
    world::SceneSpec scene;
    scene.run.fps = 100.0;  // of which every one is a tick
    scene.solver.precision = world::Precision::double_;
    world::RopeSpec rope;
    rope.name = "bolas";
    rope.start = {-0.5, 2.0, 0.0};
    rope.end = {0.5, 2.0, 0.0};
    rope.velocity = {1.0, 5.0, 0.0};
    rope.spin = {0.0, 0.0, 9.0};
    rope.drag = 0.0;
    scene.bodies.add(rope);
    return scene;
}

double heightOf(const world::World& world) {
    const world::PointsNow rope = world.points("rope.bolas");
    double moment = 0.0, mass = 0.0;
    for (std::size_t i = 0; i < rope.x.size(); ++i) moment += rope.mass[i] * rope.x[i].y, mass += rope.mass[i];
    return moment / mass;
}

int main() {
    world::World world(throwRope());
    const double tick = world.tickSeconds();
    double before = heightOf(world), now = before;
    double owed = 0.0;   // [s] that have passed and are not simulated yet
    double worst = 0.0;  // [m]
    std::vector<std::byte> saved;
    for (int picture = 0; picture < 60; ++picture) {
        owed += picture % 3 == 0 ? 0.021 : 0.0137;  // [s] since the last picture: here a game reads its clock
        for (; owed >= tick; owed -= tick) {
            if (world.advance()) return 1;
            before = std::exchange(now, heightOf(world));
        }
        const double shown = before + (now - before) * owed / tick;
        const double t = world.time() - tick + owed;  // a tick late, so that the next one is known
        worst = std::max(worst, std::abs(shown - (2.0 + 5.0 * t - 0.5 * 9.81 * t * t)));
        if (picture == 30) saved = world.save();
    }
    std::printf("off the parabola by %.6e m at most\n", worst);  // its chord over a tick: by g tick²/8

    world::World again(throwRope());
    again.restore(saved);
    while (again.tick() < world.tick()) again.advance();
    std::printf("tick %ld: state %016lx, restored %016lx\n", world.tick(), world.stateHash(), again.stateHash());
}
