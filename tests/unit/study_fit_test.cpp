// Numbers known by theory, found again from measurements made by theory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "taut/core/error.h"
#include "taut/reality/elastica.h"
#include "taut/scene/load.h"
#include "taut/scene/private/by_key.h"
#include "taut/study/fit.h"
#include "taut/study/fit_text.h"

namespace taut::study {
namespace {

constexpr double earth = 9.81;  // [m/s²]

Fit fitOf(const std::string& text) {
    FitSettings settings;
    const world::SceneSpec spec = scene::loadSceneText(text, "strip.toml", {}).spec;
    settings.scene = [&](const std::vector<double>& values) {
        scene::LoadOptions options;
        for (std::size_t i = 0; i < values.size(); ++i)
            options.overrides.push_back(spec.fit.keys[i] + "=" + scene::numberText(values[i]));
        return scene::loadSceneText(text, "strip.toml", options).spec;
    };
    return makeFit(spec, settings);
}

const char* const solverLines = R"(schema = 1

[solver]
integrator = "implicit-euler"
precision = "double"

[camera.main]
eye = [0.05, 1, 0.3]
target = [0.05, 0.96, 0]

)";

// A strip of 100 mm and 0.2 kg/m² that is clamped level and hangs; drag that damps its slowest swing as fast as can be.
std::string hangingScene(const std::string& fit) {
    return solverLines + std::string(R"(
[run]
fps = 30
seconds = 1.6

[material.m]
density_kg_per_m2 = 0.2
stretch_N_per_m = 5000
bending_rigidity_N_m = 1e-3
damping_time_s = 0
drag_per_s = 24

[cloth.strip]
material = "m"
size = [0.1, 0.004]
cells = [24, 1]
origin = [0, 1, 0]
across = [1, 0, 0]
down = [0, 0, 1]
clamp = ["left"]

)") + fit;
}

constexpr double hungLength = 0.1, hungRigidity = 0.2 * earth * hungLength * hungLength * hungLength / 10;

const std::string droopLines = fmt::format(R"(
[[fit.target]]
that = "1 - position(cloth.strip@right).y"
at = 1.5
value = {}
sigma = 1e-5
)",
                                           hungLength* reality::hangingStrip(10, 0, std::numbers::pi / 2).down);

// From five times as much.
TEST(Fit, FindsTheRigidityOfAHangingStrip) {
    const Fit fit = fitOf(hangingScene(R"([fit]
keys = ["material.m.bending_rigidity_N_m"]
low = 1e-6
high = 1e-2
)" + droopLines));
    EXPECT_TRUE(fit.isMet()) << fitSummary(fit);
    EXPECT_NEAR(fit.keys[0].value / hungRigidity, 1.0, 0.01) << "cells of an eleventh of the bending length";
    EXPECT_LT(fit.keys[0].deviation, 0.01 * hungRigidity);
    EXPECT_EQ(fitVerdict(fit), "The targets are met.");
    EXPECT_LE(fit.trials.size(), 40U) << "one number, 5 steps of 2 + 3 runs";
}

// How far a strip hangs down says how stiff it is for its weight, no more.
TEST(Fit, SaysThatStiffnessAndWeightCannotBeToldApart) {
    const Fit fit = fitOf(hangingScene(R"([fit]
keys = ["material.m.bending_rigidity_N_m", "material.m.density_kg_per_m2"]
low = [1e-6, 0.1]
high = [1e-2, 0.5]
)" + droopLines));
    EXPECT_FALSE(fit.isMet());
    EXPECT_NE(fitVerdict(fit).find("they see only material.m.bending_rigidity_N_m / material.m.density_kg_per_m2."),
              std::string::npos)
        << fitSummary(fit);
}

// The end of a held rope swings: with little drag it is at the height of 0.78 m on its way, with more a second time.
// From a drag of 0.3 /s the slope leads to the bound.
TEST(Fit, SeeksFromOtherStartsWhatASlopeLeadsAwayFrom) {
    const Fit fit = fitOf(R"toml(schema = 1
run = { seconds = 2.0 }
[rope.p]
ends = [[0, 1, 0], [0.3, 1, 0]]
segments = 8
radius = 0.005
stretch_N = 500
mass_kg = 0.05
drag_per_s = 0.3
hold = ["start"]
[fit]
keys = ["rope.p.drag_per_s"]
low = [0.01]
high = [10.0]
[[fit.target]]
that = "lowest(rope.p@end)"
at = 1.0
value = 0.78
sigma = 0.01
)toml");
    EXPECT_TRUE(fit.isMet()) << fitSummary(fit);
    EXPECT_GT(fit.starts, 1);
}

TEST(Fit, SaysWhatIsNotMetAndWhichBoundIsInTheWay) {
    const Fit fit = fitOf(hangingScene(R"([fit]
keys = ["material.m.bending_rigidity_N_m"]
low = 5e-4
high = 1e-2
)" + droopLines));
    EXPECT_FALSE(fit.isMet());
    EXPECT_TRUE(fit.keys[0].isHeld);
    EXPECT_EQ(fit.keys[0].value, 5e-4);
    const std::string verdict = fitVerdict(fit);
    EXPECT_TRUE(verdict.starts_with("The targets are not met from these ")) << verdict;
    EXPECT_LE(fit.trials.size(), 300U);
    EXPECT_NE(
        verdict.find("material.m.bending_rigidity_N_m is at its bound: the targets would have it lower than 0.0005."),
        std::string::npos)
        << verdict;
}

// A short strip of width 1 under a weight w that comes and goes, all rotations small: the moment at s from the free end
// is M = w s²/2 at most. Its threads take min(k κ, H) of it, with H = 2HB/2 and k = H over the curvature at which they
// slip. Then κ(M) = M/(B + k), or (M - H)/B where they slip, and the curvature without weight is held against B:
// min(H/B, (k κ - H)/(B + k)) where they slipped, else nothing. The free end has moved by ∫ κ s ds.
struct Loaded {
    double full = 0, after = 0;  // [m]
};
Loaded loadedStrip(double w, double l, double b, double h, double yield) {
    const double k = h / yield;
    Loaded sums;
    constexpr int parts = 10000;
    for (int i = 0; i < parts; ++i) {
        const double s = l * (i + 0.5) / parts, moment = 0.5 * w * s * s;
        const bool slips = moment > (b + k) * yield;
        const double curvature = slips ? (moment - h) / b : moment / (b + k);
        sums.full += curvature * s * l / parts;
        // The threads go back by as much as they were pulled, and slip again when they pull the other way with H.
        if (slips) sums.after += std::min(h / b, (k * curvature - h) / (b + k)) * s * l / parts;
    }
    return sums;
}

TEST(Fit, FindsRigidityAndHysteresisFromLoadingAndUnloading) {
    constexpr double b = 2e-4, twoHb = 1e-3, yield = 0.5, l = 0.04;
    const Loaded exact = loadedStrip(0.2 * earth, l, b, 0.5 * twoHb, yield);
    const Fit fit = fitOf(solverLines + fmt::format(R"(
[run]
fps = 60
seconds = 1.7

[world]
gravity = [0, 0, 0]

[material.m]
density_kg_per_m2 = 0.2
stretch_N_per_m = 5000
bending_rigidity_N_m = 1e-4
bending_hysteresis_N = 4e-4
bending_yield_per_m = {}
damping_time_s = 0
drag_per_s = 140

[cloth.strip]
material = "m"
size = [{}, 0.004]
cells = [16, 1]
origin = [0, 1, 0]
across = [1, 0, 0]
down = [0, 0, 1]
clamp = ["left"]

[[at]]
t = 0.0
do = "ramp"
key = "world.gravity"
to = [0, -9.81, 0]
over_s = 0.4

[[at]]
t = 0.8
do = "ramp"
key = "world.gravity"
to = [0, 0, 0]
over_s = 0.4

[fit]
keys = ["material.m.bending_rigidity_N_m", "material.m.bending_hysteresis_N"]
low = [1e-5, 1e-5]
high = [1e-3, 1e-2]

[[fit.target]]
that = "1 - position(cloth.strip@right).y"
at = 0.8
value = {}
sigma = 1e-5

[[fit.target]]
that = "1 - position(cloth.strip@right).y"
at = 1.6
value = {}
sigma = 1e-5
)",
                                                    yield, l, exact.full, exact.after));
    EXPECT_TRUE(fit.isMet()) << fitSummary(fit);
    EXPECT_NEAR(fit.keys[0].value / b, 1.0, 0.02);
    EXPECT_NEAR(fit.keys[1].value / twoHb, 1.0, 0.02);
}

// A strip along the warp of weight w with a load F becomes longer by (F / W + w L / 2) L / (C11 - C12²/C22), with C11 =
// C22 = stretch + shear and C12 = shear. A strip of width a that is held along both sides is sheared by its own weight:
// its middle comes down by w a² / (8 shear). All strains are below 1 %.
TEST(Fit, FindsStretchAndShearFromTwoStrips) {
    constexpr double stretch = 2000, shear = 10, w = 0.5 * earth, load = 0.02 * earth;
    const double young = stretch + shear - shear * shear / (stretch + shear);
    const double longer = (load / 0.02 + 0.5 * w * 0.1) * 0.1 / young, lower = w * 0.04 * 0.04 / (8 * shear);
    const Fit fit = fitOf(solverLines + fmt::format(R"(
[run]
fps = 30
seconds = 0.6

[material.m]
density_kg_per_m2 = 0.5
stretch_N_per_m = 1000
shear_N_per_m = 30
damping_time_s = 0
drag_per_s = 200

[cloth.pulled]
material = "m"
size = [0.02, 0.1]
cells = [1, 5]
origin = [0, 1, 0]
hold = ["top"]

[[mass]]
target = "cloth.pulled@bottom"
mass_kg = 0.02

[cloth.sheared]
material = "m"
size = [0.04, 0.16]
cells = [2, 8]
origin = [0.1, 1, 0]
hold = ["left", "right"]

[fit]
keys = ["material.m.stretch_N_per_m", "material.m.shear_N_per_m"]
low = [100, 1]
high = [1e4, 1e3]

[[fit.target]]
that = "0.9 - position(cloth.pulled@bottom).y"
at = 0.5
value = {}
sigma = 5e-7

[[fit.target]]
that = "0.92 - position(cloth.sheared@#13).y"
at = 0.5
value = {}
sigma = 1e-7
)",
                                                    longer, lower));
    EXPECT_TRUE(fit.isMet()) << fitSummary(fit);
    EXPECT_NEAR(fit.keys[0].value / stretch, 1.0, 0.01);
    EXPECT_NEAR(fit.keys[1].value / shear, 1.0, 0.01);
}

}  // namespace
}  // namespace taut::study
