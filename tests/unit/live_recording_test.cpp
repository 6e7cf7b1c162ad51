#include "taut/live/recording.h"

#include <gtest/gtest.h>

#include "taut/scene/document.h"
#include "taut/scene/load.h"

namespace taut::live {
namespace {

TEST(Recording, OverridesBecomeLinesOfTheFile) {
    EXPECT_EQ(overrideLine("solver.dt=1e-4"), "solver.dt = 1e-4");
    EXPECT_EQ(overrideLine("solver.integrator=rk4"), "solver.integrator = \"rk4\"");
    EXPECT_EQ(overrideLine("solver.integrator=\"rk4\""), "solver.integrator = \"rk4\"");
    EXPECT_EQ(overrideLine("cloth.flag.cells=[72,48]"), "cloth.flag.cells = [72,48]");
    EXPECT_EQ(overrideLine("camera.main.keys.0.eye=[0,0,0]"), "");  // no file can say it of one element
}

// Every kind of action, written and read again by the loader of scenes.
TEST(Recording, ActionsAreReadAsTheyWereWritten) {
    const std::string scene = R"(schema = 1
at = [
  { t = 0.1, do = "grab", id = "a", target = "cloth.flag@#12", radius = 0.08, strength_N_per_m = 150.0, damping_ratio = 0.25 },
  { t = 0.15, do = "move", id = "a", to = [0.125, -0.5, 3.0], over_s = 0.05, ease = "linear" },
  { t = 0.2, do = "release", id = "a" },
  { t = 0.3, do = "push", target = "cloth.flag@left", impulse_Ns = [0.0, 0.1, 0.2] },
  { t = 0.3, do = "free", target = "cloth.flag@top-left" },
  { t = 0.35, do = "hold", target = "cloth.flag@all", near = [1.0, 2.0, 0.0] },
  { t = 0.4, do = "cut", target = "cloth.flag", plane = [[0.5, 0.0, 0.0], [1.0, 0.0, 0.0]] },
  { t = 0.45, do = "cut", target = "cloth.flag", segment = [[0.0, 0.5], [0.5, 0.5]] },
  { t = 0.5, do = "add-mass", target = "cloth.flag@right", mass_kg = 0.3 },
  { t = 0.6, do = "ramp", key = "wind.breeze.velocity", to = [14.0, 0.0, 0.0], over_s = 0.2, ease = "in" },
  { t = 0.7, do = "ramp", key = "light.intensity", to = 1.5, over_s = 0.1, ease = "out" },
  { t = 0.8, do = "move", target = "collider.ball", to = [1.0, 1.0, 1.0], rotation_deg = [0.0, 90.0, 0.0], over_s = 0.1 },
]
)";
    const std::string rest = R"(
[run]
seconds = 1.0
[material.nylon]
[cloth.flag]
material = "nylon"
hold = ["left"]
[wind.breeze]
velocity = [1.0, 0.0, 0.0]
[collider.ball]
shape = "sphere"
position = [0.0, -3.0, 0.0]
[camera.main]
)";
    const world::SceneSpec first = scene::loadSceneText(scene + rest, "first.toml", {}).spec;
    std::string again = "schema = 1\nat = [\n";
    for (const world::ActionSpec& action : first.actions) again += actionText(action, action.t) + ",\n";
    const world::SceneSpec second = scene::loadSceneText(again + "]\n" + rest, "second.toml", {}).spec;
    ASSERT_EQ(first.actions.size(), 12U);
    ASSERT_EQ(second.actions.size(), first.actions.size());
    for (std::size_t i = 0; i < first.actions.size(); ++i) {
        const world::ActionSpec &a = first.actions[i], &b = second.actions[i];
        EXPECT_EQ(a.what, b.what) << i;
        EXPECT_EQ(a.t, b.t) << i;
        EXPECT_EQ(a.id, b.id) << i;
        EXPECT_EQ(a.target, b.target) << i;
        EXPECT_EQ(a.near, b.near) << i;
        EXPECT_EQ(a.radius, b.radius) << i;
        EXPECT_EQ(a.strength, b.strength) << i;
        EXPECT_EQ(a.dampingRatio, b.dampingRatio) << i;
        EXPECT_EQ(a.to, b.to) << i;
        EXPECT_EQ(a.rotation.has_value(), b.rotation.has_value()) << i;
        if (a.rotation) {
            EXPECT_NEAR(a.rotation->y, b.rotation->y, 1e-15) << i;  // degrees and back
        }
        EXPECT_EQ(a.over, b.over) << i;
        EXPECT_EQ(a.ease, b.ease) << i;
        EXPECT_EQ(a.impulse, b.impulse) << i;
        EXPECT_EQ(a.planePoint, b.planePoint) << i;
        EXPECT_EQ(a.planeNormal, b.planeNormal) << i;
        EXPECT_EQ(a.from, b.from) << i;
        EXPECT_EQ(a.upTo, b.upTo) << i;
        EXPECT_EQ(a.mass, b.mass) << i;
        EXPECT_EQ(a.key, b.key) << i;
        EXPECT_EQ(a.value, b.value) << i;
    }
}

Recording small() {
    Recording recording;
    recording.scene = "curtain.toml";
    recording.overrides = {"solver.dt=1e-3", "solver.integrator=rk4", "solver.dt=2e-4", "camera.main.keys.0.t=0"};
    recording.endTick = 89;
    recording.strains = {{"cloth.curtain", 0.061}};
    Hand hand("mouse", 60.0);
    hand.grab("cloth.curtain@#412", 0.08, 200.0, 0.3, {0.0, 1.0, 0.0});
    for (world::ActionSpec& action : hand.deedsAt(30)) recording.deeds.push_back({30, std::move(action)});
    world::ActionSpec own;
    own.what = world::Do::push;
    own.target = "cloth.curtain";
    own.t = 0.5;
    recording.timeline.push_back(own);
    own.t = 7.0;  // after the end
    recording.timeline.push_back(own);
    return recording;
}

TEST(Recording, TheFileIsAScenarioWithTheLastWordOnEachKey) {
    const std::string text = scenarioText(small());
    const scene::Node tree = scene::documentTree(text, 0);  // throws where the text is no TOML
    EXPECT_EQ(tree.find("scene")->value.text, "curtain.toml");
    EXPECT_EQ(tree.find("solver")->value.find("dt")->value.number, 2e-4);
    EXPECT_EQ(tree.find("solver")->value.find("integrator")->value.text, "rk4");
    EXPECT_TRUE(tree.find("hand")->value.find("anywhere")->value.flag);
    EXPECT_EQ(tree.find("run")->value.find("seconds")->value.number, 1.5);  // frames 0 … 89
    EXPECT_NE(text.find("# It was played with --set 'camera.main.keys.0.t=0'"), std::string::npos);
    EXPECT_NE(text.find("  # { that = \"max_strain(cloth.curtain) < 0.079\" },  # measured 0.061"), std::string::npos);
}

TEST(Recording, AScenarioIsTakenApartIntoItsSceneAndItsChanges) {
    const ScenarioParts parts = partsOf(R"(schema = 1
scene = "curtain"
title = "A \"pull\""
at = [ { t = 1.0, do = "release", id = "hand" } ]
[solver]
dt = 1e-4
[collider.ball]
keys = [ { t = 0.0, position = [0.0, 1.0, 2.0] } ]
[[check]]
that = "max_strain(cloth.*) < 0.1"
)");
    EXPECT_EQ(parts.scene, "curtain");
    EXPECT_EQ(parts.changes, (std::vector<std::string>{"title=\"A \\\"pull\\\"\"", "solver.dt=0.0001",
                                                       "collider.ball.keys=[{t = 0, position = [0, 1, 2]}]"}));
    EXPECT_TRUE(partsOf("schema = 1\ntitle = \"alone\"\n").changes.empty());
}

// At one tick the hand comes first, as it did when it was played.
TEST(Recording, TheScenesOwnTimelineIsKeptUpToTheEnd) {
    const scene::Node tree = scene::documentTree(scenarioText(small()), 0);
    const std::vector<scene::Node>& at = tree.find("at")->value.items;
    ASSERT_EQ(at.size(), 2U);
    EXPECT_EQ(at[0].find("do")->value.text, "grab");
    EXPECT_EQ(at[1].find("do")->value.text, "push");
}

}  // namespace
}  // namespace taut::live
