#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/core/trig.h"
#include "taut/reality/bench.h"
#include "taut/reality/rows.h"

namespace taut::reality {
namespace {

constexpr double radius = 0.5, stretch = 1000.0;  // [m], [N/m] of an isotropic sheet, whose ν is ⅓
constexpr double modulus = 4.0 / 3.0 * stretch;   // E h [N/m]

constexpr int ballCells = 8;  // edges of the mesh along an edge of its icosahedron

// A sheet without gravity, with the bodies that it is told of, and a filling in these.
std::string sheetScene(const std::string& bodies, const std::string& in, double pressure) {
    return fmt::format(R"(schema = 1

[run]
fps = 60
seconds = 6

[world]
gravity = [0, 0, 0]

[solver]
precision = "double"

[material.sheet]
density_kg_per_m2 = 0.2
stretch_N_per_m = {}
bend_N_per_m = 0
drag_per_s = 15
{}
[filling.air]
in = [{}]
pressure_Pa = {}

[camera.main]
eye = [1, 1.5, 4]
target = [0, 0, 0]
)",
                       stretch, bodies, in, pressure);
}

// A disc as a polygon of its area, clamped on its rim; a lid that is held everywhere closes it. Both lie flat.
std::string discScene(int cells, double pressure) {
    const int corners = static_cast<int>(std::lround(2 * core::pi * cells));
    const double angle = 2 * core::pi / corners;
    const double around = radius * std::sqrt(angle / std::sin(angle));
    std::string outline;
    for (int i = 0; i < corners; ++i)
        outline += fmt::format("[{}, {}], ", around * std::cos(angle * i), around * std::sin(angle * i));
    const std::string bodies = fmt::format(R"(
[cloth.disc]
material = "sheet"
outline = [{}]
cell_m = {}
hold = ["boundary"]

[cloth.lid]
like = "cloth.disc"
hold = ["all"]

[[joint]]
a = "cloth.disc@boundary"
b = "cloth.lid@boundary"
)",
                                           outline, radius / cells);
    return sheetScene(bodies, "\"cloth.disc\", \"cloth.lid\"", pressure);
}

// A ball of triangles with a radius of 1 m.
std::string ballScene(double pressure) {
    return sheetScene("\n[cloth.ball]\nmesh = \"ball.obj\"\nmaterial = \"sheet\"\n", "\"cloth.ball\"", pressure);
}

}  // namespace

// Hencky (1915): the middle rises by w₀ = 0.64478 a (q a / E h)^⅓ for ν = ⅓, as long as that is much less than a.
void holdDisc(Bench& bench) {
    const int cells = bench.cells(16);
    for (const double load : {1e-4, 8e-4}) {  // q a / E h
        world::World world = bench.load("disc", discScene(cells, load * modulus / radius));
        const double expected = 0.64478 * std::cbrt(load);
        const std::string quantity = fmt::format("rise of the middle over a at qa/Eh = {}", load);
        if (!bench.settle(world, "cloth.disc", radius)) {
            bench.missing(quantity, "Hencky 1915", expected, 0.01, cells, "does not come to rest");
            continue;
        }
        double highest = 0;
        for (const glm::dvec3& x : world.positions(world.select("cloth.disc")))
            highest = std::max(highest, std::abs(x.z));
        bench.line(quantity, "Hencky 1915", expected, highest / radius, 0.01, cells);
    }
}

// Laplace: p R = 2 T. The tension of springs is 2 k ε for each metre at rest, which is (1 + ε) m long then, so that
// p R₀ (1 + ε)² = 4 k ε, a quadratic equation.
void holdBall(Bench& bench) {
    for (const double load : {0.02, 0.4}) {  // p R₀ / k
        const double half = 2.0 - load, expected = (half - std::sqrt(half * half - load * load)) / load;
        world::World world = bench.load("ball", ballScene(load * stretch));
        const auto meanRadius = [&] {
            double sum = 0;
            const std::vector<glm::dvec3> x = world.positions(world.select("cloth.ball"));
            for (const glm::dvec3& place : x) sum += std::sqrt(glm::dot(place, place));
            return sum / static_cast<double>(x.size());
        };
        const double rest = meanRadius();
        const std::string quantity = fmt::format("stretch of a ball at pR/k = {}", load);
        if (bench.settle(world, "cloth.ball", 1.0))
            bench.line(quantity, "Laplace", expected, meanRadius() / rest - 1.0, 0.01, ballCells);
        else
            bench.missing(quantity, "Laplace", expected, 0.01, ballCells, "does not come to rest");
    }
}

}  // namespace taut::reality
