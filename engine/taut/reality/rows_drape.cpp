#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "taut/check/figures.h"
#include "taut/core/trig.h"
#include "taut/reality/bench.h"
#include "taut/reality/rows.h"

namespace taut::reality {
namespace {

using glm::dvec3;

using core::pi;
constexpr double discRadius = 0.09, clothRadius = 0.15, noise = 1e-5;  // [m]

// Measured are rigidity, hysteresis and drape coefficient; the areal weight is not, and swept.
struct Fabric {
    const char* name;
    const char* colour;
    double rigidity, hysteresis, measured;  // [N m], [N], [-]
    std::vector<double> weights;            // [kg/m²] the first is that of assets/fabrics
};

std::string drapeScene(const Fabric& fabric, double weight, int cells, int seed) {
    return fmt::format(R"toml(schema = 1

[run]
fps = 60
seconds = 2

[material.fabric]
density_kg_per_m2 = {}
stretch_N_per_m = 100
shear_N_per_m = 60
bending_rigidity_N_m = {}
bending_hysteresis_N = {}
bending_yield_per_m = {:.3g}
damping_time_s = 1e-4
drag_per_s = 2

[cloth.sheet]
material = "fabric"
round = true
size = [{}, {}]
cells = [{}, {}]
origin = [{}, 0.3, {}]
down = [0, 0, 1]
hold = ["(0.5,0.5,{})"]
collide = false
jitter_m = {}
seed = {}
finish = {{ colour = "{}", weave = 0.3, thread_m = 0.001 }}

[collider.disc]
shape = "cylinder"
position = [0, 0.148, 0]
radius = {}
height = 0.3

[camera.main]
eye = [0.11, 0.44, 0.27]
target = [0, 0.25, 0]
)toml",
                       weight, fabric.rigidity, fabric.hysteresis, 0.05 * fabric.hysteresis / fabric.rigidity,
                       2 * clothRadius, 2 * clothRadius, cells, cells, -clothRadius, -clothRadius, discRadius, noise,
                       seed, fabric.colour, discRadius - 0.002);
}

// How often a ring of values rises and falls again, each time by as much and more.
int wavesOf(std::vector<double> ring, double least) {
    std::rotate(ring.begin(), std::ranges::min_element(ring), ring.end());
    ring.push_back(ring.front());
    int waves = 0;
    bool isRising = true;
    double turn = ring.front();  // the highest since it rises, the lowest since it falls
    for (const double value : ring) {
        const double back = isRising ? turn - value : value - turn;
        if (back > least) {
            waves += isRising ? 1 : 0;
            isRising = !isRising;
        }
        if (back > least || back < 0) turn = value;
    }
    return waves;
}

// The rest of the ring of cloth beside the disc, seen from above, and the number of folds: waves of the hem by more
// than a twentieth of its radius.
struct Drape {
    double coefficient = 0;
    int folds = 0;
};
Drape dropped(Bench& bench, const std::string& scene) {
    world::World world = bench.load("drape", scene);
    check::Figures shadow = check::Figures::parse("shadow(cloth.sheet, y)");
    const double whole = shadow.of(world).front(), disc = pi * discRadius * discRadius;
    const world::Selection hem = world.select("cloth.sheet@edges");
    const auto out = [](const dvec3& x) { return std::hypot(x.x, x.z); };
    const std::vector<dvec3> flat = world.positions(hem);
    bench.play(world, 2);
    const std::vector<dvec3> hung = world.positions(hem);
    std::vector<std::pair<double, double>> byAngle;
    for (std::size_t i = 0; i < flat.size(); ++i)
        byAngle.emplace_back(std::atan2(flat[i].z, flat[i].x), out(hung[i]) / out(flat[i]));
    std::ranges::sort(byAngle);
    std::vector<double> ring;
    for (const auto& [angle, share] : byAngle) ring.push_back(share);
    return {(shadow.of(world).front() - disc) / (whole - disc), wavesOf(ring, 0.05)};
}

DrapeBand bandOf(Bench& bench, const Fabric& fabric, double weight, int cells, int drops) {
    DrapeBand band{fabric.name, fabric.colour, fabric.measured, weight, drops};
    double squares = 0;
    for (int seed = 1; seed <= drops; ++seed) {
        const Drape drape = dropped(bench, drapeScene(fabric, weight, cells, seed));
        band.mean += drape.coefficient / drops;
        band.folds += static_cast<double>(drape.folds) / drops;
        squares += drape.coefficient * drape.coefficient / drops;
    }
    band.spread = std::sqrt(std::max(squares - band.mean * band.mean, 0.0));
    return band;
}

}  // namespace

// Cusick's drape meter (ISO 9073-9): cloth of 15 cm on a disc of 9 cm, held between it and another one; released where
// it lies flat.
void holdDrape(Bench& bench) {
    const int cells = bench.cells(100);
    const Fabric fabrics[] = {
        {"cotton broadcloth", "#3f78b5", 1.1572e-5, 1.2160e-3, 0.829, {0.12, 0.08, 0.10, 0.15, 0.20}},
        {"polyester faille", "#7c2f5e", 1.8633e-6, 6.8647e-5, 0.283, {0.11, 0.06, 0.085, 0.15, 0.20}},
    };
    for (const Fabric& fabric : fabrics) {
        const DrapeBand band = bandOf(bench, fabric, fabric.weights.front(), cells, 12);
        bench.line(fmt::format("drape coefficient of {}, {} drops: spread {:.3f}, {:.1f} folds", fabric.name,
                               band.drops, band.spread, band.folds),
                   "Matsudaira et al. 2015; ±10 points", fabric.measured, band.mean, 0.10 / fabric.measured, cells);
        bench.drapes().push_back(band);
        if (!bench.settings().draws) continue;
        for (std::size_t i = 1; i < fabric.weights.size(); ++i)
            bench.drapes().push_back(bandOf(bench, fabric, fabric.weights[i], cells, 2));
    }
}

}  // namespace taut::reality
