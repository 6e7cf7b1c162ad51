// The spurious dependence of a tear in the wind. It is chaotic: one run says nothing, the mean
// over gusts does. Small and exact cases are in unit/world_tearing_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::test::tearing {
namespace {

struct Torn {
    double mean = 0, error = 0;  // of the mean
};

// Springs that the shipped banner has lost after its five seconds.
Torn tornBanners(const std::string& fps, const std::string& safety) {
    constexpr int seeds = 12;
    const std::filesystem::path assets = std::filesystem::path(TAUT_SOURCE_DIR) / "assets";
    double sum = 0, squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        scene::LoadOptions options;
        options.assetFolders = {assets};
        options.overrides = {"run.fps=" + fps, "solver.safety=" + safety,
                             "wind.storm.gust.seed=" + std::to_string(seed)};
        world::World world(scene::loadScene(assets / "scenarios" / "torn-banner.toml", options).spec);
        while (world.time() < 5.0) EXPECT_FALSE(world.advance());
        const double torn = world.metrics().brokenSprings;
        sum += torn;
        squares += torn * torn;
    }
    const double mean = sum / seeds;
    return {mean, std::sqrt((squares / seeds - mean * mean) / (seeds - 1))};
}

TEST(TearingLong, ABannerInTheWindTearsAsMuchAtAnyTickAndStep) {
    const Torn base = tornBanners("60", "0.9");
    for (const Torn& other : {tornBanners("120", "0.9"), tornBanners("240", "0.9"), tornBanners("60", "0.3")}) {
        // The same gusts, so that means differ by less than runs do; 8 % are about one error.
        const double allowed = std::min(2 * std::hypot(base.error, other.error), 0.08 * base.mean);
        EXPECT_NEAR(other.mean, base.mean, allowed) << "± " << base.error << ", ± " << other.error;
    }
}

// A sheet of 1.2 m held along its top, with a notch of 0.2 m and a weight along its bottom that grows by 20 N/s.
double loadOfNotch(int cells) {
    const std::string n = std::to_string(cells);
    const std::string text = R"(
schema = 1
[run]
seconds = 6.0
[world]
gravity = [0, 0, 0]
[material.m]
density_kg_per_m2 = 0.15
stretch_N_per_m = 600
damping_time_s = 2e-3
drag_per_s = 20
break_strain = 0.08
[cloth.sheet]
size = [1.2, 1.2]
cells = [)" + n + ", " + n + R"(]
material = "m"
hold = ["top"]
[[mass]]
target = "cloth.sheet@bottom"
mass_kg = 1.0
[[at]]
t = 0.0
do = "cut"
target = "cloth.sheet"
segment = [[0, 0.51], [0.1667, 0.51]]
[[at]]
t = 0.0
do = "ramp"
key = "world.gravity"
to = [0, -120, 0]
ease = "linear"
over_s = 6.0
)";
    world::World world(scene::loadSceneText(text, "notch.toml", {}).spec);
    EXPECT_FALSE(world.advance());
    const int cut = world.metrics().brokenSprings;
    while (world.metrics().brokenSprings == cut && world.time() < 5.9) EXPECT_FALSE(world.advance());
    return 20 * world.time();
}

TEST(TearingLong, ANotchRunsAtTheSameLoadFromSixToFortyEightCells) {
    std::vector<double> loads;
    for (const int cells : {6, 12, 24, 48}) loads.push_back(loadOfNotch(cells));
    const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
    EXPECT_LT(*most, 1.25 * *least);
}

}  // namespace
}  // namespace taut::test::tearing
