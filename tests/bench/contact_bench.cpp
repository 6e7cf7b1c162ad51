// Cost per point of contact with a rigid shape: a cloth of 256 × 256 points in single precision, all of which lie on
// the shape, and the same cloth far from it and without any.
#include <benchmark/benchmark.h>

#include <ctime>

#include "taut/bodies/cloth.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut {
namespace {

constexpr int side = 256;
constexpr double thickness = 0.005;  // [m]

world::SceneSpec clothNear(const std::vector<world::ColliderSpec>& colliders, double height) {
    world::SceneSpec scene;
    scene.materials["m"].stretch = 5.0;  // soft, for few substeps
    scene.materials["m"].shear = 2.0;
    scene.materials["m"].bend = 0.1;
    world::ClothSpec cloth;
    cloth.name = "c";
    cloth.material = "m";
    cloth.cells = {side - 1, side - 1};
    cloth.size = {1.0, 1.0};
    cloth.origin = {-0.5, height, -0.5};
    cloth.across = {1.0, 0.0, 0.0};
    cloth.down = {0.0, 0.0, 1.0};
    cloth.thickness = thickness;
    scene.bodies.add(cloth);
    for (const world::ColliderSpec& collider : colliders) scene.colliders.push_back(collider);
    return scene;
}

world::ColliderSpec shaped(const std::string& shape) {
    world::ColliderSpec collider;
    collider.name = "under";
    collider.shape = shape;
    if (shape == "sphere") {  // so large that the cloth lies on it all over
        collider.radius = 100.0;
        collider.position.y = -100.0;
    }
    if (shape == "box") {
        collider.size = {4.0, 2.0, 4.0};
        collider.position.y = -1.0;
    }
    if (shape == "capsule" || shape == "cylinder" || shape == "cone") {
        collider.radius = 100.0;
        collider.height = shape == "cone" ? 1.0 : 40.0;
        collider.position.y = shape == "capsule" ? -120.0 : shape == "cylinder" ? -20.0 : -0.5;
    }
    return collider;
}

void ticks(benchmark::State& state, const world::SceneSpec& scene) {
    world::World world(scene, {.threads = 1});
    for (int i = 0; i < 3; ++i) (void)world.advance();
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
    };
    double least = 1e300;  // [ns] a tick
    for (auto _ : state) {
        const double start = now();
        (void)world.advance();
        least = std::min(least, now() - start);
    }
    state.counters["ns_per_point_and_substep"] = least / (world.islands().front().substeps * 1.0 * side * side);
}

void contactNone(benchmark::State& state) {
    ticks(state, clothNear({}, thickness));
}
BENCHMARK(contactNone)->Unit(benchmark::kMillisecond)->Iterations(8);

void contactFar(benchmark::State& state) {
    world::SceneSpec scene = clothNear({shaped("sphere")}, 1.0);
    scene.world.gravity = {};
    ticks(state, scene);
}
BENCHMARK(contactFar)->Unit(benchmark::kMillisecond)->Iterations(8);

template <class Name>
void contactOn(benchmark::State& state, Name name) {
    ticks(state, clothNear({shaped(name)}, thickness));
}
BENCHMARK_CAPTURE(contactOn, plane, "plane")->Unit(benchmark::kMillisecond)->Iterations(8);
BENCHMARK_CAPTURE(contactOn, sphere, "sphere")->Unit(benchmark::kMillisecond)->Iterations(8);
BENCHMARK_CAPTURE(contactOn, box, "box")->Unit(benchmark::kMillisecond)->Iterations(8);
BENCHMARK_CAPTURE(contactOn, capsule, "capsule")->Unit(benchmark::kMillisecond)->Iterations(8);
BENCHMARK_CAPTURE(contactOn, cylinder, "cylinder")->Unit(benchmark::kMillisecond)->Iterations(8);
BENCHMARK_CAPTURE(contactOn, cone, "cone")->Unit(benchmark::kMillisecond)->Iterations(8);

}  // namespace
}  // namespace taut
