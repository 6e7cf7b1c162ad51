#include "taut/live/recording.h"

#include <gtest/gtest.h>

#include "taut/live/mouse_hand.h"
#include "taut/scene/load.h"
#include "taut/scene/private/document.h"

namespace taut::live {
namespace {

TEST(Recording, OverridesBecomeLinesOfTheFile) {
    EXPECT_EQ(overrideLine("solver.dt=1e-4"), "solver.dt = 1e-4");
    EXPECT_EQ(overrideLine("solver.integrator=rk4"), "solver.integrator = \"rk4\"");
    EXPECT_EQ(overrideLine("solver.integrator=\"rk4\""), "solver.integrator = \"rk4\"");
    EXPECT_EQ(overrideLine("cloth.flag.cells=[72,48]"), "cloth.flag.cells = [72,48]");
    EXPECT_EQ(overrideLine("camera.main.keys.0.eye=[0,0,0]"), "");  // no file can say it of one element
}

// Every kind of action: the text of an action read from a text is that text.
TEST(Recording, ActionsAreReadAsTheyWereWritten) {
    const std::vector<std::string> lines = {
        R"({ t = 0.1, do = "grab", id = "a", target = "cloth.flag@#12", radius = 0.08, strength_N_per_m = 150, damping_ratio = 0.25 })",
        R"({ t = 0.15, do = "move", id = "a", to = [0.125, -0.5, 3], over_s = 0.05, ease = "linear" })",
        R"({ t = 0.2, do = "release", id = "a" })",
        R"({ t = 0.25, do = "spawn", target = "rope.late" })",
        R"({ t = 0.3, do = "push", target = "cloth.flag@left", impulse_Ns = [0, 0.1, 0.2] })",
        R"({ t = 0.3, do = "free", target = "cloth.flag@top-left" })",
        R"({ t = 0.35, do = "hold", target = "cloth.flag@all", near = [1, 2, 0] })",
        R"({ t = 0.4, do = "cut", target = "cloth.flag", plane = [[0.5, 0, 0], [1, 0, 0]] })",
        R"({ t = 0.45, do = "cut", target = "cloth.flag", segment = [[0, 0.5], [0.5, 0.5]] })",
        R"({ t = 0.5, do = "add-mass", target = "cloth.flag@right", mass_kg = 0.3 })",
        R"({ t = 0.6, do = "ramp", key = "wind.breeze.velocity", to = [14, 0, 0], over_s = 0.2, ease = "in" })",
        R"({ t = 0.7, do = "ramp", key = "light.intensity", to = 1.5, over_s = 0.1, ease = "smooth" })",
        R"({ t = 0.8, do = "move", target = "collider.ball", to = [1, 1, 1], rotation_deg = [0, 90, 0], over_s = 0.1, ease = "out" })",
        R"({ t = 0.9, do = "grab", id = "b", target = "rope.late@end", rigid = true, strength_N_per_m = 200, damping_ratio = 0.3 })",
    };
    std::string text = "schema = 1\nat = [\n";
    for (const std::string& line : lines) text += line + ",\n";
    const world::SceneSpec scene = scene::loadSceneText(text + R"(]
[run]
seconds = 1.0
[material.nylon]
[cloth.flag]
material = "nylon"
hold = ["left"]
[rope.late]
ends = [[0, 0, 5], [1, 0, 5]]
[wind.breeze]
velocity = [1.0, 0.0, 0.0]
[collider.ball]
shape = "sphere"
position = [0.0, -3.0, 0.0]
[camera.main]
)",
                                                        "scene.toml", {})
                                       .spec;
    ASSERT_EQ(scene.actions.size(), lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i)
        EXPECT_EQ(actionText(scene.actions[i], scene.actions[i].t, world::builtInActions()), lines[i]);
}

Recording small() {
    Recording recording;
    recording.scene = "curtain.toml";
    recording.overrides = {"solver.dt=1e-3", "solver.integrator=rk4", "solver.dt=2e-4", "camera.main.keys.0.t=0"};
    recording.endTick = 89;
    recording.strains = {{"cloth.curtain", 0.061}};
    MouseHand hand("mouse", 60.0);
    hand.grab("cloth.curtain@#412", 0.08, 200.0, 0.3, {0.0, 1.0, 0.0});
    recording.deeds = hand.deedsAt(30);
    world::PushAction own;
    own.target = "cloth.curtain";
    own.t = 0.5;
    recording.timeline.add(own);
    own.t = 7.0;  // after the end
    recording.timeline.add(own);
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

TEST(Recording, AnOverrideOfSeveralThingsIsACommentAsAFileCannotSayIt) {
    Recording recording = small();
    recording.overrides = {"rope.*.segments=9"};
    const std::string text = scenarioText(recording);
    EXPECT_EQ(scene::documentTree(text, 0).find("rope"), nullptr);
    EXPECT_NE(text.find("# It was played with --set 'rope.*.segments=9'"), std::string::npos);
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
