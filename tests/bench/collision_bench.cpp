// Cost of a collider: to build it, and of a point of a cloth that lies on it, passes near by, or is far from it.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <string>

#include "taut/collision/colliders.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

// A ball of radius 0.5 m of 20 · 4^level triangles, of which the vertices are pushed in and out by up to `rough` [m].
ShapeSizes ballOfTriangles(int level, double rough) {
    const double t = 0.5 * (1.0 + std::sqrt(5.0));
    ShapeSizes ball;
    ball.vertices = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                     {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    ball.triangles = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                      4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                      6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    for (int i = 0; i < level; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, isNew] = middles.emplace(std::minmax(a, b), ball.vertices.size());
            if (isNew) ball.vertices.push_back(0.5 * (ball.vertices[a] + ball.vertices[b]));
            return place->second;
        };
        std::vector<std::uint32_t> finer;
        for (std::size_t k = 0; k < ball.triangles.size(); k += 3) {
            const std::uint32_t a = ball.triangles[k];
            const std::uint32_t b = ball.triangles[k + 1];
            const std::uint32_t c = ball.triangles[k + 2];
            const std::uint32_t ab = middle(a, b);
            const std::uint32_t bc = middle(b, c);
            const std::uint32_t ca = middle(c, a);
            finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
        ball.triangles = finer;
    }
    for (dvec3& v : ball.vertices) {
        const dvec3 d = glm::normalize(v);
        v = (0.5 + rough * std::sin(9.0 * d.x) * std::sin(8.0 * d.y + 1.0) * std::sin(7.0 * d.z + 2.0)) * d;
    }
    return ball;
}

struct Subject {
    const char* kind;
    int level;
    double rough;
};
constexpr Subject subjects[] = {{"sphere", 0, 0.0}, {"mesh", 3, 0.0},  {"mesh", 4, 0.0}, {"mesh", 4, 0.05},
                                {"mesh", 6, 0.0},   {"mesh", 6, 0.05}, {"hull", 4, 0.0}, {"hull", 4, 0.05},
                                {"hull", 6, 0.0},   {"hull", 6, 0.05}};

std::string nameOf(const Subject& subject, const ShapeSizes& sizes) {
    if (std::string(subject.kind) == "sphere") return "sphere";
    return subject.kind + std::string(subject.rough > 0.0 ? " of a rough ball, " : " of a ball, ") +
           std::to_string(sizes.triangles.size() / 3) + " triangles";
}

void build(benchmark::State& state) {
    const Subject& subject = subjects[state.range(0)];
    const ShapeSizes sizes = ballOfTriangles(subject.level, subject.rough);
    for (auto _ : state) benchmark::DoNotOptimize(builtInShapes().find(subject.kind)->shape(sizes).form);
    state.SetLabel(nameOf(subject, sizes));
}
BENCHMARK(build)
    ->DenseRange(1, std::size(subjects) - 1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

// 71 × 71 points over the upper half, row after row as those of a cloth, that keep 5 mm.
template <class Real>
struct Cloth {
    static constexpr int side = 71;
    static constexpr int count = side * side;
    std::vector<Real> before, x, v, inverseMass;
    Feet feet;
    std::vector<int> touched;
    std::vector<Contact> contacts;

    Cloth() : before(3 * count), x(3 * count), v(3 * count), inverseMass(count, Real(1)) {}

    // From outside inwards onto the surface, then off it again by `height` [m].
    void settle(const Colliders& colliders, double height) {
        for (int i = 0; i < count; ++i) {
            const double east = 2.0 * (i % side) / (side - 1) - 1.0;
            const double north = 2.0 * (i / side) / (side - 1) - 1.0;
            const dvec3 d = glm::normalize(dvec3(east, 0.6, north));
            for (int k = 0; k < 3; ++k) {
                before[at(i, k)] = static_cast<Real>(d[k]);
                x[at(i, k)] = static_cast<Real>(0.1 * d[k]);
            }
        }
        resolve(colliders);
        for (int i = 0; i < count; ++i) {
            const dvec3 d = glm::normalize(dvec3(x[at(i, 0)], x[at(i, 1)], x[at(i, 2)]));
            for (int k = 0; k < 3; ++k) before[at(i, k)] = x[at(i, k)] + static_cast<Real>(height * d[k]);
        }
    }
    // A step inwards of 0.1 mm and sideways of a third of that.
    void fall() {
        for (int i = 0; i < 3 * count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            v[k] = Real(-0.2) * before[k] + (i < count ? Real(0.03) : Real(0));
            x[k] = before[k] + Real(1e-3) * v[k];
        }
    }
    void resolve(const Colliders& colliders) {
        touched.clear();
        contacts.clear();
        MovingPoints<Real> points;
        points.last = count;
        points.stride = count;
        points.xBefore = before.data();
        points.x = x.data();
        points.v = v.data();
        points.inverseMass = inverseMass.data();
        points.thickness = 5e-3;
        colliders.resolve(std::span<const MovingPoints<Real>>(&points, 1), 1e-3, feet, touched, &contacts);
    }
    static std::size_t at(int i, int k) { return static_cast<std::size_t>(k * count + i); }
};

template <class Real>
void point(benchmark::State& state, double height) {
    const Subject& subject = subjects[state.range(0)];
    const ShapeSizes sizes = ballOfTriangles(subject.level, subject.rough);
    Colliders colliders;
    colliders.add({builtInShapes().find(subject.kind)->shape(sizes).form, {}}, {}, {});
    Cloth<Real> cloth;
    cloth.settle(colliders, height);
    for (auto _ : state) {
        cloth.fall();
        cloth.resolve(colliders);
    }
    state.counters["a point"] = benchmark::Counter(
        Cloth<Real>::count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    state.counters["touch"] = static_cast<double>(cloth.contacts.size()) / Cloth<Real>::count;
    state.SetLabel(nameOf(subject, sizes));
}
void rests(benchmark::State& state) {
    point<float>(state, 0.0);
}
void restsInDouble(benchmark::State& state) {
    point<double>(state, 0.0);
}
void passes(benchmark::State& state) {
    point<float>(state, 0.01);
}
void isFar(benchmark::State& state) {
    point<float>(state, 0.1);
}
BENCHMARK(rests)->DenseRange(0, std::size(subjects) - 1);
BENCHMARK(restsInDouble)->DenseRange(0, std::size(subjects) - 1);
BENCHMARK(passes)->DenseRange(0, std::size(subjects) - 1);
BENCHMARK(isFar)->DenseRange(0, std::size(subjects) - 1);

}  // namespace
}  // namespace taut::collision

BENCHMARK_MAIN();
