// Cloth and ropes with a bending rigidity against the elastica: a strip's own shape, its frequency, its fall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::test::bending {
namespace {

constexpr double length = 0.1, weight = 0.2 * 9.81;  // [m], [N/m²]

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

// A strip of so many cells, clamped level at its left end, of the rigidity that makes Γ = w L³/B.
std::string strip(int cells, double gamma, const std::string& more) {
    return R"(
schema = 1
[run]
fps = 60
seconds = 20.0
[solver]
integrator = "implicit-euler"
precision = "double"
[material.m]
density_kg_per_m2 = 0.2
stretch_N_per_m = 5e3
drag_per_s = 4.0
bending_rigidity_N_m = )" +
           number(weight * length * length * length / gamma) +
           "\n[cloth.strip]\nmaterial = \"m\"\nsize = [0.1, 0.01]\n"
           "cells = [" +
           std::to_string(cells) + ", 1]\norigin = [0, 1, 0]\ndown = [0, 0, 1]\n" + more;
}

world::World worldOf(const std::string& text) {
    return world::World(scene::loadSceneText(text, "strip.toml", {}).spec);
}

// Until nothing moves by a hundred thousandth of the length in a second.
void settle(world::World& world) {
    for (int second = 0; second < 60; ++second) {
        const glm::dvec3 before = world.positions(world.select("cloth.strip@right")).front();
        for (int tick = 0; tick < 60; ++tick) ASSERT_FALSE(world.advance());
        if (glm::length(world.positions(world.select("cloth.strip@right")).front() - before) < 1e-6) return;
    }
    FAIL() << "it does not come to rest";
}

// Height over width of the line from the clamp to the end.
double droop(int cells, double gamma) {
    world::World world = worldOf(strip(cells, gamma, "clamp = [\"left\"]\n"));
    settle(world);
    const glm::dvec3 end = world.positions(world.select("cloth.strip@right")).front();
    return (1.0 - end.y) / end.x;
}

// Elastica by shooting (θ'' = -Γ (1 - s) cos θ), which two methods agree on to six digits. Cells of a ninth of the
// bending length (B/w)^⅓ or an eleventh of the strip.
TEST(Cantilever, HangsAsTheElasticaDoes) {
    EXPECT_NEAR(droop(11, 1), 0.124562, 0.01 * 0.124562);
    EXPECT_NEAR(droop(20, 10), 1.066802, 0.01 * 1.066802);
    EXPECT_NEAR(droop(42, 100), 5.888105, 0.01 * 5.888105);
}

TEST(Cantilever, ErrorFallsWithTheSquareOfTheCell) {
    const double coarse = droop(8, 10) / 1.066802 - 1, fine = droop(16, 10) / 1.066802 - 1;
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);  // 2.7 % and 0.72 %: 1.9, as the next order is still there
}

// The same strip as a mesh of so many cells along and four across. Right triangles all one way; or inner points moved
// by up to 0.3 of a cell, the shorter diagonal of each cell, and every fifth the longer one.
std::string meshOf(int cells, bool isIrregular) {
    constexpr int across = 4;
    const double cell = length / cells;
    std::vector<glm::dvec2> x;
    std::uint32_t state = 5;
    const auto next = [&state] {
        state = state * 1664525U + 1013904223U;
        return 0.3 * (static_cast<double>(state >> 8) / 0x800000 - 1.0);
    };
    std::string text;
    for (int j = 0; j <= across; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double right = i > 0 && i < cells ? next() : 0, down = j > 0 && j < across ? next() : 0;
            x.emplace_back(cell * (i + (isIrregular ? right : 0)), cell * (j + (isIrregular ? down : 0)));
            text += "v " + number(x.back().x) + " 0 " + number(x.back().y) + "\n";
        }
    const auto face = [&](int a, int b, int c) {
        text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
    };
    const auto distance = [&](int a, int b) { return glm::length(x[a] - x[b]); };
    for (int j = 0; j < across; ++j)
        for (int i = 0; i < cells; ++i) {
            const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            const bool isOther = isIrregular && (distance(b, c) < distance(a, d)) != ((i + 3 * j) % 5 == 0);
            face(a, isOther ? c : d, b);
            face(isOther ? b : a, c, d);
        }
    const auto path = std::filesystem::path(testing::TempDir()) /
                      ("strip-" + std::to_string(cells) + (isIrregular ? "-irregular.obj" : "-even.obj"));
    std::ofstream(path) << text;
    return path.string();
}

// The scene of a grid, whose lines from `size` to `down` go, with this mesh instead.
std::string withMesh(const std::string& scene, int cells, bool isIrregular) {
    const auto from = scene.find("size ="), down = scene.find("down ="), to = scene.find('\n', down) + 1;
    return scene.substr(0, from) + "mesh = \"" + meshOf(cells, isIrregular) + "\"\nposition = [0, 1, 0]\n" +
           scene.substr(to);
}

TEST(Cantilever, OfAMeshHangsAsTheElasticaDoesOnUnlikeTriangulations) {
    for (const auto& [cells, gamma, exact] : {std::tuple(12, 1.0, 0.124562), std::tuple(24, 30.0, 2.547214)})
        for (const bool isIrregular : {false, true}) {
            world::World world = worldOf(withMesh(strip(cells, gamma, "clamp = [\"left\"]\n"), cells, isIrregular));
            settle(world);
            const glm::dvec3 end = world.positions(world.select("cloth.strip@right")).front();
            // As of a grid with cells like these: 0.7 % and 0.8 % on the even mesh, 0.7 % and 0.5 % on the other.
            EXPECT_NEAR((1.0 - end.y) / end.x, exact, 0.01 * exact) << cells << (isIrregular ? " irregular" : " even");
        }
}

// Greenhill: a strip that stands upright falls from Γ = 7.83735 on.
TEST(StandingStrip, FallsWhereTheoryHasIt) {
    const auto leaned = [](double gamma) {
        std::string text = strip(24, gamma, "clamp = [\"left\"]\nacross = [0, 1, 0]\nvelocity = [1e-3, 0, 0]\n");
        world::World world = worldOf(text);
        for (int tick = 0; tick < 60 * 20; ++tick) EXPECT_FALSE(world.advance());
        return std::abs(world.positions(world.select("cloth.strip@right")).front().x) / length;
    };
    EXPECT_LT(leaned(7.6), 1e-3);
    EXPECT_GT(leaned(8.1), 0.1);
}

// f₁ = 1.875104²/(2π) √(B/(ρ L⁴)), by leap-frog; of a rope with EI and its mass a metre. Gravity is so weak
// that it only sets the strip swinging about a sag of w L⁴/(8 B), a thousandth of its length: 1.4 % of that are of the
// second mode.
TEST(Cantilever, SwingsAtItsFrequency) {
    const double rigidity = 1e-3, omega = 1.875104 * 1.875104 * std::sqrt(rigidity / 0.2) / (length * length);
    const std::string head = R"(
schema = 1
[run]
fps = 240
[world]
gravity = [0, -0.04, 0]
[solver]
precision = "double"
)";
    const double sag = 0.2 * 0.04 * length * length * length * length / (8 * rigidity);
    const std::string sheet = R"(
[material.m]
density_kg_per_m2 = 0.2
stretch_N_per_m = 2e3
drag_per_s = 0
damping_time_s = 0
bending_rigidity_N_m = 1e-3
[cloth.strip]
material = "m"
size = [0.1, 0.01]
cells = [32, 1]
origin = [0, 1, 0]
down = [0, 0, 1]
clamp = ["left"]
)";
    const std::string rope = R"(
[rope.strip]
ends = [[0, 1, 0], [0.1, 1, 0]]
segments = 32
mass_kg = 2e-4
stretch_N = 20
bending_rigidity_N_m2 = 1e-5
drag_per_s = 0
damping_time_s = 0
clamp = ["start"]
)";
    for (const auto& [body, end] : {std::pair(sheet, "cloth.strip@right"), std::pair(rope, "rope.strip@end")}) {
        world::World world = worldOf(head + body);
        const world::Selection tip = world.select(end);
        double crossed = 0, first = 0, last = 0, before = 0;
        for (int tick = 0; tick < 1200; ++tick) {
            ASSERT_FALSE(world.advance());
            const double y = world.positions(tip).front().y - 1 + sag;
            if (before < 0 && y >= 0) {
                const double t = world.time() - world.tickSeconds() * y / (y - before);
                if (crossed++ == 0) first = t;
                last = t;
            }
            before = y;
        }
        ASSERT_GT(crossed, 10);
        EXPECT_NEAR(2 * M_PI * (crossed - 1) / (last - first), omega, 0.01 * omega) << end;
    }
}

const std::string weightless = "[world]\ngravity = [0, 0, 0]\n";

// Held on a collider that turns by a quarter, a strip points where that points; a hinge would leave it behind.
TEST(Clamp, TurnsWithTheColliderThatHoldsIt) {
    const std::string text = strip(16, 10, "clamp = [\"left\"]\nhold_on = \"collider.jaw\"\ncollide = false\n") +
                             weightless +
                             R"([collider.jaw]
shape = "sphere"
radius = 0.001
keys = [{ t = 0, position = [0, 1, 0] }, { t = 1, position = [0.5, 1, 0], rotation_deg = [0, 0, 90] }]
)";
    for (const std::string& scene : {text, withMesh(text, 16, true)}) {
        world::World world = worldOf(scene);
        for (int tick = 0; tick < 60; ++tick) ASSERT_FALSE(world.advance());
        settle(world);
        const glm::dvec3 end = world.positions(world.select("cloth.strip@right")).front();
        // The rest of the motion after settling, a hundred thousandth of the length.
        EXPECT_NEAR(end.x, 0.5, 1e-6);
        EXPECT_NEAR(end.y, 1.0 + length, 1e-6);
    }
}

// Broadcloth whose threads rub hangs as stiffly with steps of 1/60 s, beyond which friction would turn back a thousand
// times, as with steps that follow it. With one Newton step threads slip late: the droop differs by some thousandths.
TEST(Hysteresis, ComesToRestWithLongImplicitStepsWhereItDoesWithShortOnes) {
    const auto hangs = [](const std::string& method) {
        const std::vector<std::string> overrides{
            "material.m.bending_hysteresis_N=1.2e-3", "material.m.bending_yield_per_m=5", "material.m.drag_per_s=20",
            "material.m.stretch_N_per_m=1e3", "solver.integrator=\"" + method + "\""};
        world::World world(scene::loadSceneText(strip(20, 100, "clamp = [\"left\"]\ncollide = false\n"), "strip.toml",
                                                {.overrides = overrides})
                               .spec);
        settle(world);
        return 1.0 - world.positions(world.select("cloth.strip@right")).front().y;
    };
    const double exact = hangs("leapfrog");
    EXPECT_NEAR(hangs("implicit-euler"), exact, 0.005 * exact);
    EXPECT_NEAR(hangs("sdirk2"), exact, 0.005 * exact);
}

// No fold, no twist and no friction is left across a cut: the cut part falls freely.
TEST(Bending, ActsNotAcrossACut) {
    const std::string text = R"(
schema = 1
[run]
fps = 60
[solver]
precision = "double"
[material.m]
density_kg_per_m2 = 0.2
stretch_N_per_m = 2e3
drag_per_s = 0
bending_rigidity_N_m = 1e-3
bending_hysteresis_N = 1e-2
bending_yield_per_m = 1
[cloth.strip]
material = "m"
size = [0.1, 0.02]
cells = [10, 2]
origin = [0, 1, 0]
down = [0, 0, 1]
clamp = ["left"]
[[at]]
t = 0
do = "cut"
target = "cloth.strip"
plane = [[0.055, 1, 0], [1, 0, 0]]
)";
    for (const std::string& scene : {text, withMesh(text, 10, false)}) {
        world::World world = worldOf(scene);
        while (world.time() < 0.2 - 1e-9) ASSERT_FALSE(world.advance());
        for (const glm::dvec3& x : world.positions(world.select("cloth.strip@right")))
            EXPECT_NEAR(x.y, 1.0 - 0.5 * 9.81 * 0.04, 1e-9);  // rounding: all of the piece falls alike
    }
}

}  // namespace
}  // namespace taut::test::bending
