#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "taut/core/trig.h"
#include "taut/reality/bench.h"
#include "taut/reality/rows.h"

namespace taut::reality {
namespace {

constexpr double radius = 0.5, stretch = 1000.0;  // [m], [N/m] of an isotropic sheet, whose ν is ⅓
constexpr double modulus = 4.0 / 3.0 * stretch;   // E h [N/m]

constexpr int ballCells = 8;  // edges of the mesh along an edge of its icosahedron

constexpr int spokes = 28, links = 8;  // threads of a balloon's disc, and their segments

// Bodies without gravity, with a filling in the named ones.
std::string blownUpScene(const std::string& bodies, const std::string& in, double pressure) {
    return fmt::format(R"(schema = 1

[run]
fps = 60
seconds = 6

[world]
gravity = [0, 0, 0]

[solver]
precision = "double"
{}
[filling.air]
in = [{}]
pressure_Pa = {}

[camera.main]
eye = [1, 1.5, 4]
target = [0, 0, 0]
)",
                       bodies, in, pressure);
}

std::string sheetScene(const std::string& bodies, const std::string& in, double pressure) {
    const std::string material = fmt::format(R"(
[material.sheet]
density_kg_per_m2 = 0.2
stretch_N_per_m = {}
bend_N_per_m = 0
drag_per_s = 15
)",
                                             stretch);
    return blownUpScene(material + bodies, in, pressure);
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

// Two flat discs with a radius of 1 m, sewn at their rims, of a foil that does not stretch and folds at will: on each,
// threads from the middle to the rim, and between two of them a gore of a skin that is a thousand times softer. Its
// points all lie on the threads, so that it holds the air, carries nothing along them and is hardly against folds.
std::string balloonScene() {
    const double angle = 2 * core::pi / spokes, chord = 2 * std::sin(angle / 2);
    std::string outline = "[0, 0]";
    for (const int side : {1, -1})
        for (int k = 1; k <= links; ++k) {
            const double share = static_cast<double>(side > 0 ? k : links + 1 - k) / links;
            outline += fmt::format(", [{}, {}]", side * share * chord / 2, -share * std::cos(angle / 2));
        }
    // Links and chord are one edge each: they lie between half of a cell and one and a half.
    std::string bodies = fmt::format(R"(
[material.skin]
density_kg_per_m2 = 0.05
lumping = "uniform"
stretch_N_per_m = 0.1
bend_N_per_m = 0
damping_time_s = 0
drag_per_s = 12

[defaults.cloth]
material = "skin"
outline = [{}]
cell_m = {}

[defaults.rope]
segments = {}
stretch_N = 100
mass_kg = 0.003
damping_time_s = 0
drag_per_s = 12
)",
                                     outline, std::sqrt(chord / 1.5 * 2 / links), links);
    const auto join = [&](const std::string& a, const std::string& b) {
        bodies += fmt::format("\n[[joint]]\na = \"{}\"\nb = \"{}\"\nreach_m = 0.001\n", a, b);
    };
    for (int i = 0; i < spokes; ++i) {
        const double turn = angle * i, middle = turn + angle / 2;
        for (const char* const disc : {"upper", "lower"}) {
            bodies += fmt::format("\n[rope.{}{}]\nends = [[0, 0, 0], [{}, 0, {}]]\n", disc, i, std::cos(turn),
                                  std::sin(turn));
            bodies += fmt::format("\n[cloth.{}{}]\nacross = [{}, 0, {}]\ndown = [{}, 0, {}]\n", disc, i,
                                  -std::sin(middle), std::cos(middle), std::cos(middle), std::sin(middle));
            for (const int thread : {i, (i + 1) % spokes})
                join(fmt::format("cloth.{}{}@all", disc, i), fmt::format("rope.{}{}@all", disc, thread));
        }
        join(fmt::format("rope.upper{}@end", i), fmt::format("rope.lower{}@end", i));
    }
    return blownUpScene(bodies, "\"cloth.*\"", 1.0);
}

}  // namespace

// Hencky (1915): the middle rises by w₀ = 0.64478 a (q a / E h)^⅓ for ν = ⅓, as long as that is much less than a.
void holdDisc(Bench& bench) {
    const int cells = bench.cells(16);
    for (const double load : {1e-4, 8e-4}) {  // q a / E h
        world::World world = bench.load("disc", discScene(cells, load * modulus / radius));
        const bool isAtRest = bench.settle(world, "cloth.disc", radius);
        double highest = 0;
        for (const glm::dvec3& x : world.positions(world.select("cloth.disc")))
            highest = std::max(highest, std::abs(x.z));
        bench.restingLine(isAtRest, fmt::format("rise of the middle over a at qa/Eh = {}", load), "Hencky 1915",
                          0.64478 * std::cbrt(load), highest / radius, 0.01, cells);
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
        const bool isAtRest = bench.settle(world, "cloth.ball", 1.0);
        bench.restingLine(isAtRest, fmt::format("stretch of a ball at pR/k = {}", load), "Laplace", expected,
                          meanRadius() / rest - 1.0, 0.01, ballCells);
    }
}

// A Mylar balloon: meridians keep their length a, and nothing resists that the discs gather around them. With the
// meridian dz/dx = -x² / √(r⁴ - x⁴) it has a = 1.31103 r, the thickness 1.19814 r, the volume 2.74581 r³.
void holdMylar(Bench& bench) {
    world::World world = bench.load("mylar", balloonScene());
    const bool isAtRest = bench.settle(world, "rope.*", 1.0);
    double sum = 0, middles = 0, volumes = 0;
    for (const char* const disc : {"upper", "lower"}) {
        std::vector<std::vector<glm::dvec3>> threads;
        for (int i = 0; i < spokes; ++i)
            threads.push_back(world.positions(world.select(fmt::format("rope.{}{}", disc, i))));
        middles += std::abs(threads[0].front().y);
        double under = 0;
        for (std::size_t i = 0; i < threads.size(); ++i) {
            const std::vector<glm::dvec3>&a = threads[i], &b = threads[(i + 1) % threads.size()];
            sum += std::hypot(a.back().x, a.back().z);
            for (std::size_t k = 0; k + 1 < a.size(); ++k)
                under +=
                    (glm::dot(a[k], glm::cross(a[k + 1], b[k + 1])) + glm::dot(a[k], glm::cross(b[k + 1], b[k]))) / 6;
        }
        volumes += std::abs(under);
    }
    const auto add = [&](const char* quantity, double expected, double value) {
        bench.restingLine(isAtRest, quantity, "Paulsen 1994", expected, value, 0.02, links);
    };
    add("radius of a Mylar balloon over that of its discs", 0.762760, sum / (2 * spokes));
    add("its thickness over that radius", 0.913893, middles);
    add("its volume over the cube", 1.218524, volumes);
}

}  // namespace taut::reality
