// The cost of contact between bodies per point and detection, including the steps in between: a sheet that
// falls on its edge while it piles up and when it lies, one that hangs and meets nothing, and two that lie on a ball;
// and boxes that fall into a heap, and that stand in a wall.
#include <benchmark/benchmark.h>

#include "taut/bodies/cloth.h"
#include "taut/bodies/solid.h"
#include "taut/spec/spec.h"
#include "taut/world/private/rigid_contacts.h"
#include "taut/world/world.h"

namespace taut {
namespace {

world::ClothSpec sheet(const std::string& name, const glm::dvec3& origin, const glm::dvec3& down) {
    world::ClothSpec cloth;
    cloth.name = name;
    cloth.material = "cotton";
    cloth.origin = origin;
    cloth.down = down;
    cloth.size = {1.0, 1.0};
    cloth.cells = {40, 40};
    cloth.thickness = 0.004;
    cloth.jitter = 0.001;
    cloth.touch = world::Touch::all;
    return cloth;
}

world::SceneSpec scene() {
    world::SceneSpec spec;
    world::MaterialSpec cotton;
    cotton.stretch = 200.0;
    spec.materials["cotton"] = cotton;
    return spec;
}

world::SceneSpec folding() {
    world::SceneSpec spec = scene();
    spec.bodies.add(sheet("sheet", {-0.5, 1.02, 0.0}, {0, -1, 0}));
    world::ColliderSpec ground;
    ground.shape = "plane";
    spec.colliders.push_back(ground);
    return spec;
}

world::SceneSpec hanging() {
    world::SceneSpec spec = scene();
    world::ClothSpec cloth = sheet("sheet", {-0.5, 1.0, 0.0}, {0, -1, 0});
    cloth.hold = {"top"};
    cloth.velocity = {0.0, 0.0, 1.0};
    spec.bodies.add(cloth);
    return spec;
}

world::SceneSpec draped() {
    world::SceneSpec spec = scene();
    spec.bodies.add(sheet("lower", {-0.5, 0.85, -0.5}, {0, 0, 1}));
    spec.bodies.add(sheet("upper", {-0.48, 0.9, -0.51}, {0, 0, 1}));
    world::ColliderSpec ball;
    ball.shape = "sphere";
    ball.radius = 0.3;
    ball.position = {0.0, 0.5, 0.0};
    spec.colliders.push_back(ball);
    return spec;
}

world::SolidSpec box(const glm::dvec3& position) {
    world::SolidSpec solid;
    solid.size = glm::dvec3(0.1);
    solid.thickness = 0.005;
    solid.position = position;
    return solid;
}

world::SceneSpec boxes(const std::vector<world::SolidSpec>& all) {
    world::SceneSpec spec = scene();
    for (world::SolidSpec own : all) {
        own.name = "box" + std::to_string(spec.bodies.size());
        spec.bodies.add(own);
    }
    world::ColliderSpec ground;
    ground.shape = "plane";
    ground.friction = spec.contact.friction = 0.5;
    spec.colliders.push_back(ground);
    return spec;
}

// Each turned otherwise, on top of each other in columns.
world::SceneSpec heap(int count, const std::string& shape = "box") {
    std::vector<world::SolidSpec> all;
    for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
            for (int z = 0; z < count; ++z) {
                all.push_back(box({0.16 * x + 0.01 * y, 0.15 + 0.17 * y, 0.16 * z}));
                all.back().shape = shape;
                all.back().radius = 0.05;
                all.back().height = 0.1;
                all.back().rotation = {1.1 * x + 0.3 * y, 0.7 * z, 0.9 * y};
            }
    return boxes(all);
}

world::SceneSpec wall(int width) {
    std::vector<world::SolidSpec> all;
    for (int row = 0; row < width; ++row)
        for (int k = 0; k < width - row; ++k) all.push_back(box({0.105 * (k + 0.5 * row), 0.05 + 0.1 * row, 0.0}));
    return boxes(all);
}

// After so many ticks.
void touching(benchmark::State& state, const world::SceneSpec& spec, int ticks) {
    world::World world(spec, {.threads = 1});
    for (int i = 0; i < ticks; ++i) (void)world.advance();
    const auto before = world.contact().detections;
    for (auto _ : state) (void)world.advance();
    double points = 0;
    for (const world::IslandInfo& island : world.islands()) points += island.points;
    const auto detections = static_cast<double>(world.contact().detections - before);
    state.counters["detections a tick"] = detections / static_cast<double>(state.iterations());
    state.counters["per point and detection"] =
        benchmark::Counter(points * detections, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(touching, piles up, folding(), 25)->Unit(benchmark::kMillisecond)->Iterations(20);
BENCHMARK_CAPTURE(touching, lies, folding(), 180)->Unit(benchmark::kMillisecond)->Iterations(20);
BENCHMARK_CAPTURE(touching, meets nothing, hanging(), 10)->Unit(benchmark::kMillisecond)->Iterations(60);
BENCHMARK_CAPTURE(touching, two on a ball, draped(), 90)->Unit(benchmark::kMillisecond)->Iterations(20);
BENCHMARK_CAPTURE(touching, 125 boxes fall, heap(5), 20)->Unit(benchmark::kMillisecond)->Iterations(60);
BENCHMARK_CAPTURE(touching, 1000 boxes fall, heap(10), 20)->Unit(benchmark::kMillisecond)->Iterations(60);
BENCHMARK_CAPTURE(touching, 55 bricks stand, wall(10), 20)->Unit(benchmark::kMillisecond)->Iterations(60);

// One detection among the shapes of solids, without the ground, the narrow phase and the solver.
void detecting(benchmark::State& state, const world::SceneSpec& spec, int ticks) {
    world::World world(spec, {.threads = 1});
    for (int i = 0; i < ticks; ++i) (void)world.advance();
    const std::vector<world::Body> bodies = world::buildBodies(spec);
    world::RigidContacts contacts;
    std::vector<glm::dvec3> x0, x1;
    const double seconds = 0.25 * world.tickSeconds();
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        world::RigidMarks marks = world::marksOf(bodies[k]);
        for (int& i : marks.points) i += static_cast<int>(x0.size());
        const world::RigidContacts::Solid solid{static_cast<int>(k), bodies[k].pieces[0], marks, 0.005};
        contacts.addSolid(solid);
        const world::PointsNow points = world.points(bodies[k].fullName());
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            x0.push_back(points.x[i]);
            x1.push_back(points.x[i] + seconds * points.v[i]);
        }
    }
    std::size_t touches = 0;
    for (auto _ : state) touches = contacts.find(x0, x1, seconds, {}, [](int, int, int) { return true; }).size();
    state.counters["touches"] = static_cast<double>(touches);
}
BENCHMARK_CAPTURE(detecting, 1000 boxes fall, heap(10), 20)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detecting, 1000 boxes lie, heap(10), 205)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detecting, 1000 cylinders lie, heap(10, "cylinder"), 205)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace taut
