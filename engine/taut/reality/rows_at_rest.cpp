#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "taut/core/private/bisect.h"
#include "taut/core/trig.h"
#include "taut/mechanics/bending.h"
#include "taut/reality/bench.h"
#include "taut/reality/elastica.h"
#include "taut/reality/rows.h"

namespace taut::reality {
namespace {

using glm::dvec3;

using core::pi;
constexpr double stripLength = 0.1, stripDensity = 0.2, stripWeight = stripDensity * g;  // [m], [kg/m²], [N/m²]

// The rigidity of a strip a metre wide, that makes Γ = w L³/B [N m].
double rigidityOf(double gamma) {
    return stripWeight * stripLength * stripLength * stripLength / gamma;
}

// Drag that damps the slowest swing of a strip that hangs from a clamp as fast as can be: ω = 3.516 √(g/ΓL) of a
// straight one, 1.2 √(g/L) of a limp one [1/s].
double dragOf(double gamma) {
    return 2 * std::sqrt(g / stripLength) * std::max(3.516 / std::sqrt(gamma), 1.2);
}

// Cells of a ninth of the bending length, or an eleventh of the strip.
int cellsOf(double gamma) {
    return static_cast<int>(std::ceil(std::max(9 * std::cbrt(gamma), 11.0)));
}

// A strip of cloth one cell wide that is clamped level; it runs along the warp, or along the weft.
struct SheetStrip {
    int cells;
    double density, along;  // [kg/m²], [N m] along the strip
    double across;          // [N m] across it
    bool isAlongWarp;
};

std::string sheetScene(const SheetStrip& strip) {
    const double gamma = strip.density * g * stripLength * stripLength * stripLength / strip.along;
    const double warp = strip.isAlongWarp ? strip.along : strip.across,
                 weft = strip.isAlongWarp ? strip.across : strip.along;
    const double width = stripLength / strip.cells;
    return fmt::format(R"(schema = 1

[run]
fps = 60
seconds = 5

[solver]
integrator = "implicit-euler"
precision = "double"
cg_tolerance = 1e-8
newton_steps = 4

[material.fabric]
density_kg_per_m2 = {}
stretch_N_per_m = {}
bending_rigidity_N_m = {{ warp = {}, weft = {} }}
damping_time_s = 0
drag_per_s = {}

[cloth.strip]
material = "fabric"
size = [{}, {}]
cells = [{}, {}]
origin = [0, 1, 0]
across = [{}]
down = [{}]
clamp = ["{}"]

[camera.main]
eye = [0.05, 1, 0.3]
target = [0.05, 0.96, 0]
)",
                       strip.density, 2.5e4 * strip.density, warp, weft, dragOf(gamma),
                       strip.isAlongWarp ? stripLength : width, strip.isAlongWarp ? width : stripLength,
                       strip.isAlongWarp ? strip.cells : 1, strip.isAlongWarp ? 1 : strip.cells,
                       strip.isAlongWarp ? "1, 0, 0" : "0, 0, 1", strip.isAlongWarp ? "0, 0, 1" : "1, 0, 0",
                       strip.isAlongWarp ? "left" : "top");
}

// Height over width of the line from the clamp to the free end at rest; none if it does not come to rest.
std::optional<double> droopOf(Bench& bench, const std::string& name, const std::string& scene, const std::string& body,
                              const std::string& end) {
    world::World world = bench.load(name, scene);
    if (!bench.settle(world, body, stripLength)) return std::nullopt;
    const dvec3 tip = world.positions(world.select(body + "@" + end)).front();
    return (1 - tip.y) / tip.x;
}

void addDroop(Bench& bench, const std::string& quantity, const std::string& source, double expected, double tolerance,
              int cells, std::optional<double> droop) {
    bench.restingLine(droop.has_value(), quantity, source, expected, droop.value_or(0), tolerance, cells);
}

// A rope in place of a strip a metre wide.
LineScene ropeStrip(int cells, double gamma) {
    LineScene scene;
    scene.cells = cells;
    scene.rigidity = rigidityOf(gamma);
    scene.drag = dragOf(gamma);
    scene.place = fmt::format("ends = [[0, 1, 0], [{}, 1, 0]]\nclamp = [\"start\"]\n", stripLength);
    return scene;
}

// With its rigidity, or with springs across two links instead.
std::optional<double> ropeDroop(Bench& bench, int cells, double gamma, double bend = 0) {
    LineScene scene = ropeStrip(cells, gamma);
    if (bend > 0) {  // their clamp is a cell more, which is held
        scene.rigidity = 0;
        scene.weight *= (cells + 1.0) / cells;
        ++scene.cells;
        scene.place = fmt::format("ends = [[{}, 1, 0], [{}, 1, 0]]\nhold = [\"start\", \"#1\"]\nbend_N = {}\n",
                                  -stripLength / cells, stripLength, bend);
    }
    return droopOf(bench, bend > 0 ? "cantilever-springs" : "cantilever-line", lineScene(scene), "rope.strip", "end");
}

// Curves over four decades: theory, four resolutions, and springs across two cells. Those are fitted to one strip, of
// Γ = 10 with 10 cells; other lengths L of it have Γ ∝ L³, so that their stiffness over the weight of all goes as 1/L.
void drawDroops(Bench& bench) {
    std::vector<DroopCurve>& curves = bench.droops();
    DroopCurve exact{"elastica", false, 0, {}};
    for (double power = -1; power <= 3.0001; power += 0.05)
        exact.points.emplace_back(std::pow(10, power), elasticaDroop(std::pow(10, power)));
    curves.push_back(exact);
    const auto curve = [&](const std::string& name, int cells, double fitted) {
        DroopCurve drawn{name, fitted > 0, cells, {}};
        for (const double gamma : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
            const double bend = fitted > 0 ? fitted * std::cbrt(10 / gamma) : 0;
            if (const auto droop = ropeDroop(bench, cells, gamma, bend); droop && *droop > 0)
                drawn.points.emplace_back(gamma, *droop);
        }
        curves.push_back(drawn);
    };
    for (const int cells : {5, 10, 20, 40}) curve(fmt::format("taut, {} cells", cells), cells, 0);
    const double expected = elasticaDroop(10);
    const double fitted = std::exp(
        core::rootOf([&](double logBend) { return ropeDroop(bench, 10, 10, std::exp(logBend)).value_or(0) - expected; },
                     std::log(0.1), std::log(1e5), 16));
    curve("taut, bend springs, 10 cells", 10, fitted);
    curve("taut, same springs, 20 cells", 20, fitted);
}

// Energy over area of a sheet of n × n cells, bent to a cylinder whose axis is at 45° to the threads.
double cylinderEnergy(const mechanics::BendingRigidity& rigidity, int n, double cell, double curvature) {
    const mechanics::Bending bending = mechanics::gridBending(n + 1, n + 1, rigidity, cell, cell);
    const auto place = [&](int i) {
        const double u = cell * (i % (n + 1)), v = cell * (i / (n + 1));
        const double along = (u + v) / std::sqrt(2.0), beside = (u - v) / std::sqrt(2.0);
        return dvec3(std::sin(curvature * along) / curvature, beside, (1 - std::cos(curvature * along)) / curvature);
    };
    double energy = 0;
    mechanics::eachTerm(bending, [&](const mechanics::BendingTerm& term) {
        dvec3 sum(0.0);
        for (int k = 0; k < term.count; ++k) sum += term.weights[k] * place(term.points[k]);
        energy += 0.5 * term.coefficient * glm::dot(sum, sum);
    });
    return energy;
}

// No fold and twist stands at an edge: of two sheets the energy that goes with the edge is taken out.
void addBias(Bench& bench) {
    constexpr double warp = 3.5e-5, weft = 2.1e-5, bias = 1.5e-5, curvature = 20, cell = 1e-3;  // [N m], [1/m], [m]
    const int n = bench.cells(20);
    const auto rigidity = mechanics::orthotropicRigidity(warp, weft, bias);
    const double more = cylinderEnergy(*rigidity, 2 * n, cell, curvature),
                 less = cylinderEnergy(*rigidity, n, cell, curvature);
    const double perArea = (more - 2 * less) / (2 * n * n * cell * cell);
    bench.line("B of a sheet bent at 45°, N·m", "4B₄₅ = B_u + B_v + 2B₁ + 4D_k", bias,
               2 * perArea / (curvature * curvature), 0.01, n);
}

}  // namespace

void holdCantilever(Bench& bench) {
    for (const double gamma : {0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0}) {
        const int cells = bench.cells(cellsOf(gamma));
        const double b = rigidityOf(gamma);
        addDroop(bench, fmt::format("H/W at Γ = {}, warp", gamma), "heavy elastica", elasticaDroop(gamma), 0.01, cells,
                 droopOf(bench, "cantilever-warp", sheetScene({cells, stripDensity, b, b / 3, true}), "cloth.strip",
                         "right"));
    }
    for (const double gamma : {1.0, 10.0, 100.0}) {
        const int cells = bench.cells(cellsOf(gamma));
        const double b = rigidityOf(gamma);
        addDroop(bench, fmt::format("H/W at Γ = {}, weft", gamma), "heavy elastica", elasticaDroop(gamma), 0.01, cells,
                 droopOf(bench, "cantilever-weft", sheetScene({cells, stripDensity, b, 3 * b, false}), "cloth.strip",
                         "bottom"));
    }
    addBias(bench);
    const int cells = bench.cells(16);
    const auto coarse = ropeDroop(bench, cells, 10), fine = ropeDroop(bench, 2 * cells, 10);
    const double exact = elasticaDroop(10);
    bench.line("order of the error at Γ = 10", "second order", 2,
               std::log2(std::abs((coarse.value_or(0) - exact) / (fine.value_or(0) - exact))), 0.05, 2 * cells);
    if (bench.settings().draws) drawDroops(bench);
}

// Rows near the 2, 10, 25, 50, 75, 90 and 98 % of warp rigidities among 618 fabrics. B(κ) falls with κ there; a scene
// can state B₀ only.
void holdFabrics(Bench& bench) {
    struct Fabric {
        const char* rank;
        double density, warp, weft;  // [kg/m²], [1e-6 N m]
    };
    static constexpr Fabric fabrics[] = {
        {"2 %", 0.0224, 0.866, 1.141},  {"10 %", 0.1673, 1.645, 2.577}, {"25 %", 0.2314, 4.117, 1.411},
        {"50 %", 0.1691, 13.63, 5.642}, {"75 %", 0.2069, 35.33, 21.06}, {"90 %", 0.2563, 66.29, 71.71},
        {"98 %", 0.6918, 164.5, 102.2},
    };
    for (const Fabric& fabric : fabrics)
        for (const bool isAlongWarp : {true, false}) {
            const double rigidity = 1e-6 * (isAlongWarp ? fabric.warp : fabric.weft);
            const double gamma = fabric.density * g * stripLength * stripLength * stripLength / rigidity;
            const int cells = bench.cells(cellsOf(gamma));
            LineScene scene = ropeStrip(cells, gamma);
            scene.weight = fabric.density * g * stripLength;
            scene.rigidity = rigidity;
            scene.stretch = 2.5e4 * fabric.density;
            addDroop(bench, fmt::format("H/W of 100 mm, fabric at {}, {}", fabric.rank, isAlongWarp ? "warp" : "weft"),
                     "B₀ by Feng et al. 2022, heavy elastica", elasticaDroop(gamma), 0.02, cells,
                     droopOf(bench, "fabric", lineScene(scene), "rope.strip", "end"));
        }
}

// The load is a mass a thousand times that of the strip and more.
void holdTipLoad(Bench& bench) {
    const int cells = bench.cells(64);
    constexpr double load = 0.2;  // [N]
    for (const double gamma : {0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 8.0, 10.0}) {
        LineScene scene;
        scene.cells = cells;
        scene.weight = 2e-4 * load;
        scene.rigidity = load * stripLength * stripLength / gamma;
        scene.drag = 2 * std::sqrt(3 * g / (gamma * stripLength));
        scene.place = fmt::format("ends = [[0, 1, 0], [{}, 1, 0]]\nclamp = [\"start\"]\n", stripLength);
        scene.more = fmt::format("\n[[mass]]\ntarget = \"rope.strip@end\"\nmass_kg = {}\n", load / g);
        world::World world = bench.load("tip-load", lineScene(scene));
        const HangingStrip exact = hangingStrip(0, gamma, pi / 2);
        const bool isAtRest = bench.settle(world, "rope.strip", stripLength);
        const dvec3 tip = world.positions(world.select("rope.strip@end")).front();
        bench.restingLine(isAtRest, fmt::format("deflection/L at PL²/B = {}", gamma), "elastica, dead load", exact.down,
                          (1 - tip.y) / stripLength, 0.005, cells);
    }
}

// Both ends are at one place. The first links say where the clamp points.
void holdLoops(Bench& bench) {
    const int cells = bench.cells(64);
    struct Shape {
        LoopKind kind;
        const char* name;
        std::vector<dvec3> half;  // places on the right half, from the clamp to the lowest [m]
    };
    const double s = stripLength / 10;
    const Shape shapes[] = {
        {LoopKind::ring, "ring", {{s / 2, 0, 0}, {s, 0, 0}, {1.6 * s, -s, 0}, {s, -2.6 * s, 0}, {0, -3.2 * s, 0}}},
        {LoopKind::heart,
         "heart",
         {{0, s / 2, 0}, {0, s, 0}, {0.8 * s, 1.8 * s, 0}, {1.6 * s, 0.5 * s, 0}, {s, -s, 0}, {0, -1.4 * s, 0}}},
        {LoopKind::pear,
         "pear",
         {{0, -s / 2, 0}, {0, -s, 0}, {0.9 * s, -3 * s, 0}, {0.7 * s, -4 * s, 0}, {0, -4.4 * s, 0}}},
    };
    for (const Shape& shape : shapes)
        for (const double gamma : {1.0, 20.0, 100.0}) {
            std::string places;
            const auto add = [&](dvec3 p) {
                places += fmt::format("  {{ position = [{}, {}, {}] }},\n", p.x, 1 + p.y, p.z);
            };
            for (const dvec3& p : shape.half) add(p);
            for (auto p = shape.half.rbegin() + 1; p != shape.half.rend(); ++p) add({-p->x, p->y, p->z});
            LineScene scene;
            scene.cells = cells;
            scene.place = "ends = [[0, 1, 0], [0, 1, 0]]\nthrough = [\n" + places + "]\nclamp = [\"ends\"]\n";
            scene.rigidity = 1;
            scene.stretch = 1e6;  // of a loop with Γ = 1 the thrust is 20 N
            const std::string name = fmt::format("loop-{}", shape.name);
            // As long as the way through the places turns out to be.
            const auto links = [&] {
                world::World world = bench.load(name, lineScene(scene));
                const std::vector<dvec3> x = world.positions(world.select("rope.strip"));
                return glm::length(x[1] - x[0]) * cells;
            };
            const double whole = links();
            scene.weight = stripWeight * whole;
            scene.rigidity = stripWeight * whole * whole * whole / gamma;
            // The slowest swing of a ring is some four times as fast as that of a strip of that length.
            scene.drag = 2 * dragOf(gamma);
            world::World world = bench.load(name, lineScene(scene));
            const Loop exact = loopOf(shape.kind, gamma);
            const bool isAtRest = bench.settle(world, "rope.strip", stripLength);
            double lowest = 0;
            for (const dvec3& x : world.positions(world.select("rope.strip"))) lowest = std::max(lowest, 1 - x.y);
            bench.restingLine(isAtRest, fmt::format("height of a {} over L at Γ = {}", shape.name, gamma),
                              "heavy elastica, Peirce 1930", exact.height, lowest / whole, 0.01, cells);
        }
}

// Hinged ends. A stiff anchor at one of them is the load cell: how far the end is from its place tells the thrust.
void holdColumn(Bench& bench) {
    const int cells = bench.cells(64);
    for (const double degrees : {20.0, 40.0, 60.0, 80.0}) {
        const Column aim = columnOf(degrees * pi / 180);
        LineScene scene;
        scene.cells = cells;
        scene.gravity = 0;
        scene.rigidity = 1e-4;
        const double thrust = aim.thrust * scene.rigidity / (stripLength * stripLength),
                     cellStiffness = 1e4 * thrust / stripLength;
        scene.stretch = 1e5 * thrust;
        // ω = π² √(EI/μL⁴) of the straight strip.
        scene.drag = 2 * pi * pi * std::sqrt(scene.rigidity * g / (scene.weight * std::pow(stripLength, 3)));
        const double end = stripLength * (1 - aim.shortening);
        scene.place =
            fmt::format("ends = [[0, 1, 0], [{}, 1, 0]]\nlength_m = {}\nhold = [\"start\"]\n", end, stripLength);
        scene.more =
            fmt::format("\n[anchor.cell]\ntarget = \"rope.strip@end\"\nat = [{}, 1, 0]\nstiffness_N_per_m = {}\n", end,
                        cellStiffness);
        world::World world = bench.load("column", lineScene(scene));
        const bool isAtRest = bench.settle(world, "rope.strip", stripLength);
        const std::vector<dvec3> x = world.positions(world.select("rope.strip"));
        double crest = 0;
        for (const dvec3& at : x) crest = std::max(crest, std::abs(at.y - 1));
        // Theory at the shortening that came of it.
        const double shortening = 1 - x.back().x / stripLength;
        const Column exact = columnOf(
            core::rootOf([&](double slope) { return shortening - columnOf(slope).shortening; }, 1e-3, 2.0, 50));
        const auto add = [&](const std::string& quantity, double expected, double value, double tolerance) {
            bench.restingLine(isAtRest, quantity, "elastica, elliptic integrals", expected, value, tolerance, cells);
        };
        add(fmt::format("crest/L of a strip shortened by {:.3f} L", aim.shortening), exact.crest, crest / stripLength,
            0.005);
        add(fmt::format("thrust PL²/B of a strip shortened by {:.3f} L", aim.shortening), exact.thrust,
            cellStiffness * (x.back().x - end) * stripLength * stripLength / scene.rigidity, 0.01);
    }
}

// As Kawabata's tester bends it: a centimetre between a jaw at rest and one that goes along the ends of ever narrower
// circles, to 250 /m. Then that jaw releases it, in air so thick that the strip unbends without a swing. Where nothing
// pulls any more B κ is the moment of friction. Leap-frog, as the jaw turns: implicit Euler would wrinkle the strip.
// Over 60 lines: most of them are the scene.
void holdCreases(Bench& bench) {
    const int cells = bench.cells(10);
    constexpr double length = 0.01, most = 250, bends = 0.3;  // [m], [1/m], [s]
    struct Fabric {
        const char* name;
        double density, rigidity, hysteresis;  // [kg/m²], [N m], [N]
    };
    static constexpr Fabric fabrics[] = {{"cotton broadcloth", 0.12, 1.1572e-5, 1.2160e-3},
                                         {"tropical wool", 0.18, 6.5705e-6, 3.2362e-4},
                                         {"polyester faille", 0.11, 1.8633e-6, 6.8647e-5}};
    for (const Fabric& fabric : fabrics) {
        const double crease = 0.5 * fabric.hysteresis / fabric.rigidity, cell = length / cells;
        const double swing = 3.516 * std::sqrt(fabric.rigidity / fabric.density) / (length * length);  // [1/s]
        std::string keys;  // of the last column but one, which the jaw holds too
        constexpr int arcs = 30;
        for (int i = 0; i <= arcs; ++i) {
            const double curvature = most * i / arcs, angle = curvature * (length - cell);
            const dvec3 place = i == 0 ? dvec3(length - cell, 1, 0)
                                       : dvec3(std::sin(angle) / curvature, 1 + (1 - std::cos(angle)) / curvature, 0);
            keys += fmt::format("  {{ t = {}, position = [{}, {}, 0], rotation_deg = [0, 0, {}] }},\n",
                                bends * i / arcs, place.x, place.y, angle * 180 / pi);
        }
        const std::string scene = fmt::format(
            R"(schema = 1

[run]
fps = 100
seconds = 2

[world]
gravity = [0, 0, 0]

[solver]
precision = "double"

[material.fabric]
density_kg_per_m2 = {}
stretch_N_per_m = 100
bending_rigidity_N_m = {}
bending_hysteresis_N = {}
bending_yield_per_m = {}
damping_time_s = 0
drag_per_s = {}

[cloth.strip]
material = "fabric"
size = [{}, {}]
cells = [{}, 1]
origin = [0, 1, 0]
down = [0, 0, 1]
clamp = ["left"]
collide = false

[[joint]]
name = "jaw"
a = ["cloth.strip@right", "cloth.strip@#{}", "cloth.strip@#{}"]
b = "collider.jaw"

[collider.jaw]
shape = "sphere"
radius = 0.0001
keys = [
{}]

[[at]]
t = {}
do = "ramp"
key = "material.fabric.drag_per_s"
to = {}
over_s = 0.01

[[at]]
t = {}
do = "release"
id = "jaw"

[camera.main]
eye = [0, 1, 0.03]
target = [0, 1, 0]
)",
            fabric.density, fabric.rigidity, fabric.hysteresis, 0.1 * crease, swing, length, cell, cells, cells - 1,
            2 * cells, keys, bends, 25 * swing, bends + 0.02);
        world::World world = bench.load("crease", scene);
        bench.play(world, bends + 0.02);
        const bool isAtRest = bench.settle(world, "cloth.strip", length);
        const std::vector<dvec3> x = world.positions(world.select("cloth.strip"));
        const auto direction = [&](std::size_t i) { return std::atan2(x[i + 1].y - x[i].y, x[i + 1].x - x[i].x); };
        // From the middle of the first cell to that of the last.
        const double curvature = (direction(static_cast<std::size_t>(cells) - 1) - direction(0)) / (length - cell);
        bench.restingLine(isAtRest, fmt::format("curvature that {} keeps, 1/m", fabric.name),
                          "2HB/(2B), Matsudaira et al. 2015", crease, curvature, 0.01, cells);
    }
}

}  // namespace taut::reality
