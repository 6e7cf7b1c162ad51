// Cost of a step per point: taut, one iteration of Bullet's soft body over the same springs, and a textbook
// object a spring end. Contestants take turns in short bouts, so that other work of the machine affects all alike;
// a ratio is the median over rounds of bout against bout.
//
//   Cloth/<float|double>/N/threads      counters: ns a point a step of each, and how many times faster taut is
//   Scaling/…                           the same cloth, taut alone: cost of a point as the state grows
//   Mesh/…                              the same, as a mesh with the numbering of a file
//   WindyCloth/…                        the same, with wind on its triangles
//
// Bullet's link solver and the textbook version run on one thread always, Bullet in single precision always.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "bullet_links.h"
#include "hanging_cloth.h"
#include "object_springs.h"
#include "taut/core/private/instruction_set.h"
#include "taut/core/private/parallel.h"

namespace taut::bench {
namespace {

constexpr double boutNanoseconds = 4e6;  // long against a clock reading, short against a time slice
constexpr int fewestSteps = 3;           // a bout of the largest cloths

// On one thread the processor time, which other programs on the machine hardly touch; on more the time on the wall.
double nanosecondsNow(int threads) {
    timespec now{};
    clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
    return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// One contestant: the number of steps of a bout, and the times of its bouts.
template <class Stepper>
class Contestant {
  public:
    Contestant(Stepper stepper, int points, int threads) : stepper_(stepper), points_(points), threads_(threads) {
        const double once = time();
        steps_ = std::clamp(static_cast<int>(boutNanoseconds / std::max(once, time())), fewestSteps, 100000);
    }
    // Runs a bout; returns its cost [ns per point per step]. A step before it, untimed, brings back into the caches
    // the data that the other contestant displaced, as in a long run.
    double bout() {
        stepper_(1);
        const double each = time() / steps_ / points_;
        bouts_.push_back(each);
        return each;
    }
    double typical() const { return median(bouts_); }
    double best() const { return *std::min_element(bouts_.begin(), bouts_.end()); }
    int steps() const { return steps_; }

  private:
    double time() {
        const double begin = nanosecondsNow(threads_);
        stepper_(steps_);
        return nanosecondsNow(threads_) - begin;
    }
    Stepper stepper_;
    int points_;
    int threads_;
    int steps_ = 1;
    std::vector<double> bouts_;
};

template <class Real>
void clothAgainstOthers(benchmark::State& state, int side, int threads) {
    const mechanics::Model cloth = hangingCloth(side);
    const int points = cloth.pointCount();
    const core::ThreadLimit limit(threads);
    ClothRun<Real> run(cloth, Air::still);
    BulletLinks links(cloth, LinkOrder::byPoint), reordered(cloth, LinkOrder::reordered);
    ObjectSprings<Real> objects(cloth, stableStep(cloth));
    Contestant taut([&](int n) { run.step(n); }, points, threads),
        bullet([&](int n) { links.iterate(n); }, points, threads),
        bulletReordered([&](int n) { reordered.iterate(n); }, points, threads),
        textbook([&](int n) { objects.step(n); }, points, threads);
    std::vector<double> overBullet, overReordered, overTextbook;
    for ([[maybe_unused]] auto _ : state) {
        // taut runs on both sides of each other contestant's bout: a trend in the machine's speed cancels.
        double before = taut.bout();
        state.SetIterationTime(before * taut.steps() * points * 1e-9);
        const auto compare = [&](auto& other, std::vector<double>& ratios) {
            const double its = other.bout(), after = taut.bout();
            ratios.push_back(2.0 * its / (before + after));
            before = after;
        };
        compare(bullet, overBullet);
        compare(bulletReordered, overReordered);
        compare(textbook, overTextbook);
    }
    if (!std::isfinite(run.lowestPoint() + links.lowestPoint() + reordered.lowestPoint() + objects.lowestPoint()))
        state.SkipWithError("a contestant's cloth blew up");
    state.counters["taut_ns"] = taut.typical();
    state.counters["taut_best_ns"] = taut.best();
    state.counters["bullet_best_ns"] = bullet.best();
    state.counters["bullet_ns"] = bullet.typical();
    state.counters["bullet_reordered_ns"] = bulletReordered.typical();
    state.counters["objects_ns"] = textbook.typical();
    state.counters["x_bullet_best"] = bullet.best() / taut.best();
    state.counters["x_bullet"] = median(overBullet);
    state.counters["x_bullet_reordered"] = median(overReordered);
    state.counters["x_objects"] = median(overTextbook);
}

template <class Real, Air air, mechanics::Model (*model)(int) = hangingCloth>
void clothAlone(benchmark::State& state, int side, int threads) {
    const core::ThreadLimit limit(threads);
    const mechanics::Model cloth = model(side);
    ClothRun<Real> run(cloth, air);
    Contestant taut([&](int n) { run.step(n); }, cloth.pointCount(), threads);
    for ([[maybe_unused]] auto _ : state)
        state.SetIterationTime(taut.bout() * taut.steps() * cloth.pointCount() * 1e-9);
    if (!std::isfinite(run.lowestPoint())) state.SkipWithError("the cloth blew up");
    state.counters["taut_ns"] = taut.typical();
    state.counters["taut_best_ns"] = taut.best();
}

void add(const std::string& name, void (*body)(benchmark::State&, int, int), int side, int threads, int rounds) {
    benchmark::RegisterBenchmark((name + "/" + std::to_string(side) + "/threads:" + std::to_string(threads)).c_str(),
                                 body, side, threads)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(rounds);
}

void addAll() {
    constexpr int rounds = 25;
    for (const int threads : {1, 2})
        for (const int side : {32, 64, 128, 256, 512}) {
            add("Cloth/float", clothAgainstOthers<float>, side, threads, rounds);
            add("Cloth/double", clothAgainstOthers<double>, side, threads, rounds);
        }
    for (const int threads : {1, 2})
        for (const int side : {32, 64, 128, 256, 512}) {
            add("Scaling/float", clothAlone<float, Air::still>, side, threads, 4 * rounds);
            add("Scaling/double", clothAlone<double, Air::still>, side, threads, 4 * rounds);
        }
    for (const int threads : {1, 2}) {
        for (const int side : {64, 256}) {
            add("Mesh/float", clothAlone<float, Air::still, hangingMesh>, side, threads, 2 * rounds);
            add("Mesh/double", clothAlone<double, Air::still, hangingMesh>, side, threads, 2 * rounds);
        }
        add("WindyCloth/float", clothAlone<float, Air::windy>, 256, threads, rounds);
        add("WindyCloth/double", clothAlone<double, Air::windy>, 256, threads, rounds);
    }
}

}  // namespace
}  // namespace taut::bench

int main(int argc, char** argv) {
    benchmark::AddCustomContext("instruction set", std::string(taut::core::nameOf(taut::core::instructionSet())));
    taut::bench::addAll();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
