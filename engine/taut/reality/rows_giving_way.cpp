#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/core/trig.h"
#include "taut/reality/bench.h"
#include "taut/reality/elastica.h"
#include "taut/reality/rows.h"

namespace taut::reality {
namespace {

using glm::dvec3;

using core::pi;

// An upright strip that is given a push, after `seconds`: where its upper end is.
dvec3 leaned(Bench& bench, int cells, double gamma, double drag, double seconds) {
    LineScene scene;
    scene.cells = cells;
    scene.rigidity = scene.weight * scene.length * scene.length / gamma;
    scene.drag = drag;
    scene.place =
        fmt::format("ends = [[0, 1, 0], [0, {}, 0]]\nclamp = [\"start\"]\nvelocity = [1e-3, 0, 0]\n", 1 + scene.length);
    world::World world = bench.load("standing", lineScene(scene));
    bench.play(world, seconds);
    if (seconds > 1) bench.settle(world, "rope.strip", scene.length);
    const dvec3 end = world.positions(world.select("rope.strip@end")).front();
    return (end - dvec3(0, 1, 0)) / scene.length;
}

// Whether the end of a rope goes on sliding, after the swing by its loads: by a millimetre in the third
// second.
bool slides(Bench& bench, const std::string& name, const LineScene& scene) {
    world::World world = bench.load(name, lineScene(scene));
    const world::Selection end = world.select("rope.strip@end");
    bench.play(world, 2);
    const dvec3 before = world.positions(end).front();
    bench.play(world, 1);
    return glm::length(world.positions(end).front() - before) > 1e-3;
}

void holdIncline(Bench& bench) {
    const int cells = bench.cells(40);
    const double slope = std::atan(0.5), c = std::cos(slope), s = std::sin(slope);
    const auto sceneOf = [&](double friction) {
        LineScene scene;
        scene.cells = cells;
        scene.length = 1;
        scene.weight = 1;
        scene.stretch = 1e3;
        scene.damping = 1e-3;
        scene.method = "leapfrog";
        const double up = scene.length / 100;  // its radius
        scene.place =
            fmt::format("ends = [[{}, {}, 0], [{}, {}, 0]]\n", up * s, 1 + up * c, up * s + c, 1 + up * c - s);
        scene.more = fmt::format(
            "\n[collider.slope]\nshape = \"plane\"\nposition = [0, 1, 0]\nnormal = [{}, {}, 0]\nfriction = {}\n", s, c,
            friction);
        return scene;
    };
    bench.line("μ at which a rope stays on a slope of 1 in 2", "Coulomb", 0.5,
               Bench::threshold(0.45, 0.55, 5, [&](double mu) { return !slides(bench, "incline", sceneOf(mu)); }), 0.01,
               cells);
    world::World world = bench.load("incline", lineScene(sceneOf(0.3)));
    const world::Selection end = world.select("rope.strip@end");
    const dvec3 before = world.positions(end).front();
    bench.play(world, 1);
    bench.line("acceleration over g on that slope, μ = 0.3", "Coulomb", s - 0.3 * c,
               2 * glm::length(world.positions(end).front() - before) / g, 0.01, cells);
}

// A rope on a table with friction that goes over a round edge without. The edge, of radius R for the rope's middle, is
// pulled down by the weight of R of the rope and holds nothing: μ A = h + R of the lengths on the table and below.
void holdOverhang(Bench& bench) {
    const int cells = bench.cells(120);
    constexpr double mu = 0.5, length = 1, edge = 0.03;
    const auto sceneOf = [&](double share) {  // of A + h + R that pulls
        LineScene scene;
        scene.cells = cells;
        scene.length = length;
        scene.weight = 1;
        scene.stretch = 1e3;
        scene.drag = 2;
        scene.damping = 1e-3;
        scene.method = "leapfrog";
        const double thick = length / 100, arc = edge + thick;
        const double sum = length - arc * (pi / 2 - 1), onTable = sum - share * sum;
        scene.place = laidAlong(length, cells, [&](double along) -> dvec3 {
            if (along < onTable) return {along - onTable, 1 + thick, 0};
            const double angle = std::min((along - onTable) / arc, pi / 2), rest = along - onTable - arc * pi / 2;
            return {arc * std::sin(angle), 1 - edge + arc * std::cos(angle) - std::max(rest, 0.0), 0};
        });
        scene.more = fmt::format(R"(
[collider.table]
shape = "box"
size = [4, 1, 1]
position = [-2, 0.5, 0]
friction = {}

[collider.edge]
shape = "cylinder"
radius = {}
height = 1
position = [0, {}, 0]
rotation_deg = [90, 0, 0]
friction = 0
)",
                                 mu, edge, 1 - edge);
        return scene;
    };
    const double expected = mu / (1 + mu);
    bench.line("share of a rope that may hang over an edge, μ = 0.5", "μ/(1+μ)", expected,
               Bench::threshold(0.92 * expected, 1.08 * expected, 5,
                                [&](double share) { return slides(bench, "overhang", sceneOf(share)); }),
               0.01, cells);
}

// A rope over a round bar with a weight on either end, half a turn.
void holdCapstan(Bench& bench) {
    const int cells = bench.cells(64);
    constexpr double mu = 0.3, bar = 0.1, below = 0.1, lighter = 1;  // [1], [m], [m], [N]
    const auto sceneOf = [&](double ratio) {
        LineScene scene;
        scene.cells = cells;
        const double thick = 0.001, arc = bar + thick, length = pi * arc + 2 * below;
        scene.length = length;
        scene.weight = 1e-2 * lighter;
        scene.stretch = 1e3 * lighter;
        scene.drag = 2;
        scene.damping = 1e-4;
        scene.method = "leapfrog";
        scene.place = laidAlong(length, cells, [&](double along) -> dvec3 {
            if (along < below) return {-arc, 1 - below + along, 0};
            const double angle = std::min((along - below) / arc, pi), rest = along - below - arc * pi;
            return {-arc * std::cos(angle), 1 + arc * std::sin(angle) - std::max(rest, 0.0), 0};
        });
        scene.place += fmt::format("thickness = {}\n", thick);
        const double straight = scene.weight * below / length;  // [N] of the rope on either side
        scene.more = fmt::format(R"(
[[mass]]
target = "rope.strip@start"
mass_kg = {}

[[mass]]
target = "rope.strip@end"
mass_kg = {}

[collider.bar]
shape = "cylinder"
radius = {}
height = 1
position = [0, 1, 0]
rotation_deg = [90, 0, 0]
friction = {}
)",
                                 (lighter - straight) / g, (ratio * lighter - straight) / g, bar, mu);
        return scene;
    };
    const double expected = std::exp(mu * pi);
    bench.line("ratio of weights over a bar, half a turn, μ = 0.3", "Euler's capstan", expected,
               Bench::threshold(0.95 * expected, 1.05 * expected, 4,
                                [&](double ratio) { return slides(bench, "capstan", sceneOf(ratio)); }),
               0.01, cells);
}

}  // namespace

// Within 7.6 … 8.1, and how far it has leaned beyond.
void holdStanding(Bench& bench) {
    const int cells = bench.cells(48);
    const double falls = Bench::threshold(
        7.6, 8.1, 3, [&](double gamma) { return std::abs(leaned(bench, cells, gamma, 1, 20).x) > 0.01; });
    bench.line("Γ from which an upright strip falls", "Greenhill 1881", standingWeight(), falls, 0.032, cells);
    for (const double gamma : {10.0, 20.0}) {
        const HangingStrip exact = hangingStrip(gamma, 0, pi);
        const dvec3 end = leaned(bench, cells, gamma, 20, 5);
        bench.line(fmt::format("height of its end over L at Γ = {}", gamma), "heavy elastica", -exact.down, end.y, 0.01,
                   cells);
        bench.line(fmt::format("its end aside over L at Γ = {}", gamma), "heavy elastica", exact.out, std::abs(end.x),
                   0.01, cells);
    }
}

// A long narrow strip, clamped on edge, stiff in its plane: Γ* = 6 j₋₁⸝₆ √(EI GJ) with EI = B b, GJ = 2 B b for ν = 0.
void holdLateral(Bench& bench) {
    const int cells = bench.cells(80), across = std::max(cells / 20, 1);
    constexpr double length = 0.1, width = length / 20, density = 0.2, weight = density * g;
    const auto leans = [&](double gamma) {
        const std::string scene = fmt::format(R"(schema = 1

[run]
fps = 60
seconds = 10

[solver]
integrator = "implicit-euler"
precision = "double"
cg_tolerance = 1e-7
cg_iterations = 20000

[material.fabric]
density_kg_per_m2 = {}
stretch_N_per_m = {}
bending_rigidity_N_m = {}
damping_time_s = 0
drag_per_s = 1

[cloth.strip]
material = "fabric"
size = [{}, {}]
cells = [{}, {}]
origin = [0, 1, 0]
clamp = ["left"]
velocity = [0, 0, 1e-3]

[camera.main]
eye = [0.1, 1.05, 0.2]
target = [0.05, 0.98, 0]
)",
                                              density, 1e5 * weight * length, weight * std::pow(length, 3) / gamma,
                                              length, width, cells, across);
        world::World world = bench.load("lateral", scene);
        // It goes on leaning rather than coming back: more in the fourth second than in the second.
        const world::Selection corner = world.select("cloth.strip@bottom-right");
        const auto mostAside = [&] {
            double most = 0;
            bench.play(world, 1, [&] { most = std::max(most, std::abs(world.positions(corner).front().z)); });
            return most;
        };
        bench.play(world, 1);
        const double second = mostAside();
        bench.play(world, 1);
        return mostAside() > second;
    };
    bench.line("Γ from which a strip on edge leans aside", "Timoshenko, narrow strip", 12.85376 * std::sqrt(2.0),
               Bench::threshold(0.93 * 18.178, 1.07 * 18.178, 3, leans), 0.04, cells);
}

// The clamp comes down slowly; the lower end stays where it stood until friction does not hold it any more. The rod
// starts bent, with its end held until it presses: without pressure it would slide while it swings.
void holdStickSlip(Bench& bench) {
    const int cells = bench.cells(48);
    for (const double mu : {0.05, 0.1, 0.2, 0.3}) {
        const PushedRod exact = pushedRodAt(mu);
        LineScene scene;
        scene.cells = cells;
        scene.gravity = 0;
        scene.rigidity = 1e-3;
        scene.stretch = 1e5;
        scene.drag = 20;  // slowest swing 109 /s
        scene.method = "leapfrog";
        scene.fps = 240;
        const double thick = 1e-4, rests = 0.3, lowers = 3;  // [m], [s], [s]
        const double most = 1.25 * exact.lowering * scene.length;
        // Upright at the clamp, with an end below it.
        scene.place = laidAlong(1, cells, [&](double share) -> dvec3 {
            return {0.2 * scene.length * share * share * (1 - share), 1 - scene.length * share, 0};
        });
        scene.place += fmt::format("clamp = [\"start\"]\nhold_on = \"collider.jaw\"\nthickness = {}\n", thick);
        scene.more = fmt::format(R"(
[[at]]
t = 0
do = "hold"
target = "rope.strip@end"

[[at]]
t = {0}
do = "free"
target = "rope.strip@end"

[collider.jaw]
shape = "sphere"
radius = 0.00001
keys = [{{ t = {0}, position = [0, 1, 0] }}, {{ t = {1}, position = [0, {2}, 0] }}]

[collider.floor]
shape = "plane"
position = [0, {3}, 0]
friction = {4}
)",
                                 rests, rests + lowers, 1 - most, 1 - scene.length - thick, mu);
        world::World world = bench.load("stick-slip", lineScene(scene));
        const world::Selection all = world.select("rope.strip");
        const std::vector<dvec3> first = world.positions(all);
        const double length = cells * glm::length(first[1] - first[0]);
        double slipped = std::nan("");
        bench.play(world, rests + lowers, [&] {
            if (!std::isnan(slipped)) return;
            const std::vector<dvec3> x = world.positions(all);
            if (glm::length(x.back() - first.back()) > 1e-5 * length) slipped = 1 - (x.front().y - x.back().y) / length;
        });
        bench.line(fmt::format("lowering over L at which the end of a rod slips, μ = {}", mu),
                   "elastica and Coulomb, set-up of Sano et al. 2017", exact.lowering, slipped, 0.04, cells);
    }
}

void holdFriction(Bench& bench) {
    holdIncline(bench);
    holdOverhang(bench);
    holdCapstan(bench);
}

}  // namespace taut::reality
