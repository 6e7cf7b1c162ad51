#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/core/trig.h"
#include "taut/reality/bench.h"
#include "taut/reality/rows.h"

namespace taut::reality {
namespace {

using glm::dvec3;

using core::pi;

// Frequencies of a body's end that swings along an axis, after a push that all of it got, against those of theory.
struct Swing {
    std::string name, what, source;
    LineScene scene;
    int axis;
    std::vector<double> expected;    // [rad/s]
    std::vector<double> tolerances;  // (expected)
};

void addSwing(Bench& bench, const Swing& swing) {
    world::World world = bench.load(swing.name, lineScene(swing.scene));
    const world::Selection end = world.select("rope.strip@end");
    std::vector<double> speeds;  // higher modes show more in them than in places
    bench.play(world, 20 * 2 * pi / swing.expected.front(),
               [&] { speeds.push_back(world.points(end).v.front()[swing.axis]); });
    const std::vector<double> found = frequenciesNear(speeds, world.tickSeconds(), swing.expected);
    for (std::size_t i = 0; i < found.size(); ++i)
        bench.line(fmt::format("f{} of {}, Hz", i + 1, swing.what), swing.source, swing.expected[i] / (2 * pi),
                   found[i] / (2 * pi), swing.tolerances[i], swing.scene.cells);
}

}  // namespace

// cos β cosh β = -1. EA is such that stretching asks for no shorter steps than bending.
void holdStripModes(Bench& bench) {
    Swing swing{"strip-modes", "a clamped strip", "Euler and Bernoulli's beam", {}, 1, {}, {0.005, 0.01, 0.02}};
    LineScene& scene = swing.scene;
    scene.cells = bench.cells(64);
    scene.method = "leapfrog";
    scene.gravity = 0;
    scene.fps = 1000;
    const double perMetre = scene.weight / g / scene.length;  // [kg/m]
    const double slowest = 2 * pi * 10, beta[] = {1.8751040687, 4.6940911330, 7.8547574382};
    scene.rigidity = perMetre * std::pow(slowest * scene.length * scene.length / (beta[0] * beta[0]), 2);
    scene.stretch = 4 * std::pow(scene.cells / scene.length, 2) * scene.rigidity;
    scene.place =
        fmt::format("ends = [[0, 1, 0], [{}, 1, 0]]\nclamp = [\"start\"]\nvelocity = [0, 1e-3, 0]\n", scene.length);
    for (const double b : beta) swing.expected.push_back(slowest * b * b / (beta[0] * beta[0]));
    addSwing(bench, swing);
}

// ω = j₀ₙ/2 √(g/L), of the zeros of Bessel's J₀ (Daniel Bernoulli 1733).
void holdChainModes(Bench& bench) {
    Swing swing{"chain-modes", "a hanging chain", "Bernoulli's chain", {}, 0, {}, {0.002, 0.002, 0.002}};
    LineScene& scene = swing.scene;
    scene.cells = bench.cells(128);
    scene.method = "leapfrog";
    scene.length = 1;
    scene.weight = 1;
    scene.stretch = 2e3;
    scene.place = "ends = [[0, 1, 0], [0, 0, 0]]\nhold = [\"start\"]\nvelocity = [1e-3, 0, 0]\n";
    for (const double zero : {2.4048255577, 5.5200781103, 8.6537279129})
        swing.expected.push_back(zero / 2 * std::sqrt(g / scene.length));
    addSwing(bench, swing);
}

// An end that is released beside the other falls faster than free: v² = 2 g x (1 - x/2L)/(1 - x/L), so that energy is
// kept at a narrow fold.
void holdFoldedChain(Bench& bench) {
    LineScene scene;
    scene.cells = bench.cells(256);
    scene.method = "leapfrog";
    scene.length = 1;
    scene.weight = 1;
    scene.stretch = 5e3;
    scene.fps = 240;
    scene.seconds = 0.6;
    const double fold = 0.005, straight = 0.5 * (scene.length - pi * fold);  // [m] its radius; either side
    scene.place = laidAlong(scene.length, scene.cells, [&](double along) -> dvec3 {
        if (along < straight) return {0, 1 - along, 0};
        const double angle = std::min((along - straight) / fold, pi), rest = along - straight - fold * pi;
        return {fold * (1 - std::cos(angle)), 1 - straight - fold * std::sin(angle) + std::max(rest, 0.0), 0};
    });
    scene.place += "hold = [\"start\"]\n";
    world::World world = bench.load("folded-chain", lineScene(scene));
    const world::Selection all = world.select("rope.strip");
    double length = 0;
    const std::vector<dvec3> start = world.positions(all);
    for (std::size_t i = 0; i + 1 < start.size(); ++i) length += glm::length(start[i + 1] - start[i]);
    const double unit = std::sqrt(2 * length / g);
    std::vector<std::pair<double, double>> falls{{0.0, 0.0}};  // t over unit, x/L
    const world::Selection end = world.select("rope.strip@end");
    bench.play(world, unit,
               [&] { falls.emplace_back(world.time() / unit, (1 - world.positions(end).front().y) / length); });
    // ∫ √((1 - u)/(u (1 - u/2))) du/2 by u = sin² of an angle.
    const auto timeOf = [](double x) {
        const double last = std::asin(std::sqrt(x));
        constexpr int parts = 2000;
        double sum = 0;
        for (int k = 0; k < parts; ++k) {
            const double a = last * (k + 0.5) / parts, s = std::sin(a), c = std::cos(a);
            sum += c * c / std::sqrt(1 - s * s / 2) * last / parts;
        }
        return sum;
    };
    for (const double x : {0.25, 0.5, 0.75, 0.9, 0.95}) {
        const auto after = std::ranges::find_if(falls, [&](const auto& fall) { return fall.second >= x; });
        double time = 0;
        if (after != falls.end()) {
            const auto before = after - 1;
            const double share = (x - before->second) / (after->second - before->second);
            time = before->first + share * (after->first - before->first);
        }
        bench.line(fmt::format("time to fall by {} L, over √(2L/g)", x), "Calkin and March 1989", timeOf(x), time, 0.01,
                   scene.cells, after == falls.end() ? "does not fall so far" : "");
    }
}

}  // namespace taut::reality
