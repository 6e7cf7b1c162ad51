// Cost of many bodies: both figures per body should be constant.
#include <benchmark/benchmark.h>

#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/spec/actions.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut {
namespace {

// Ropes of two points, apart from each other: nothing but the bookkeeping of bodies.
world::SceneSpec manyRopes(int count) {
    world::SceneSpec scene;
    for (int i = 0; i < count; ++i) {
        world::RopeSpec rope;
        rope.name = "r" + std::to_string(i);
        rope.segments = 1;
        rope.start = {0.0, 0.0, 1.0 * i};
        rope.end = {1.0, 0.0, 1.0 * i};
        scene.bodies.add(rope);
    }
    return scene;
}

void buildBodies(benchmark::State& state) {
    const world::SceneSpec scene = manyRopes(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        world::World world(scene, {.threads = 1});
        benchmark::DoNotOptimize(world.stateHash());
    }
    state.counters["per body"] =
        benchmark::Counter(static_cast<double>(state.range(0)),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(buildBodies)->Arg(250)->Arg(1000)->Arg(4000)->Arg(8000)->Unit(benchmark::kMillisecond);

void tickBodies(benchmark::State& state) {
    world::World world(manyRopes(static_cast<int>(state.range(0))), {.threads = 1});
    for (auto _ : state) (void)world.advance();
    state.counters["per body"] =
        benchmark::Counter(static_cast<double>(state.range(0)),
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(tickBodies)->Arg(250)->Arg(1000)->Arg(4000)->Arg(8000)->Unit(benchmark::kMillisecond);

struct StretchOfM final : world::RampField {
    StretchOfM() {
        affects = fields::Affects::springs;
        owner = "material.m";
    }
    std::vector<double> read(const world::SceneSpec& s) const override { return {s.materials.at("m").stretch}; }
    void write(world::SceneSpec& s, const std::vector<double>& v) const override { s.materials["m"].stretch = v[0]; }
};

world::SceneSpec hangingCloth() {
    world::SceneSpec scene;
    scene.materials["m"] = {};
    world::ClothSpec cloth;
    cloth.name = "c";
    cloth.material = "m";
    cloth.cells = {64, 64};
    cloth.hold = {"top"};
    scene.bodies.add(cloth);
    return scene;
}

// A tick in which the stiffness of a hanging cloth, or none of it, is on its way: not twice as much.
void tickRamp(benchmark::State& state) {
    world::SceneSpec scene = hangingCloth();
    if (state.range(0) == 1) {
        world::RampAction ramp;
        ramp.key = "material.m.stretch_N_per_m";
        ramp.value = {scene.materials["m"].stretch * 1.1};
        ramp.over = 1e6;
        ramp.field = std::make_shared<StretchOfM>();
        scene.actions = {ramp};
    }
    world::World world(scene, {.threads = 1});
    for (auto _ : state) (void)world.advance();
}
BENCHMARK(tickRamp)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

// A tick in which springs of a cloth that a hand draws ever longer, or none of it, give way: not twice as much.
void tickPlasticity(benchmark::State& state) {
    world::SceneSpec scene = hangingCloth();
    if (state.range(0) == 1) scene.materials["m"].plasticity.yieldStrain = 1e-3;
    world::GrabAction grab;
    grab.id = "h";
    grab.target = "cloth.c@bottom";
    grab.rigid = true;
    world::MoveAction move;
    move.id = "h";
    move.t = 0.1;
    move.to = glm::dvec3(0.0, -1e3, 0.0);
    move.over = 1e4;
    move.ease = world::Ease::linear;
    scene.actions = {grab, move};
    world::World world(scene, {.threads = 1});
    for (auto _ : state) (void)world.advance();
}
BENCHMARK(tickPlasticity)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace taut

BENCHMARK_MAIN();
