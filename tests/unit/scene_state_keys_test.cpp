// The identity of two stored states: all that reaches the state, and nothing else.
#include "taut/scene/state_keys.h"

#include <gtest/gtest.h>

#include "taut/scene/load.h"

namespace taut::scene {
namespace {

const std::string base = R"(schema = 1
run = { fps = 60, seconds = 4.0 }
at = [
  { t = 1.0, do = "push", target = "cloth.flag@bottom", impulse_Ns = [0, 0, 0.1] },
  { t = 2.0, do = "free", target = "cloth.flag@left" },
]
[material.nylon]
[cloth.flag]
cells = [4, 4]
material = "nylon"
hold = ["left"]
[collider.ground]
shape = "plane"
[camera.main]
eye = [0, 1, 5]
)";

StateKeys keysOf(const std::string& text, std::vector<std::string> overrides = {}) {
    LoadOptions options;
    options.overrides = std::move(overrides);
    return loadSceneText(text, "a.toml", options).keys;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(StateKeys, DoNotSeeLayout) {
    const StateKeys a = keysOf(base);
    const StateKeys b = keysOf(replaced(replaced(base, "cells = [4, 4]\nmaterial = \"nylon\"\nhold = [\"left\"]",
                                                 "hold = [ \"left\" ] # held\nmaterial=\"nylon\"\ncells = [4,4]"),
                                        "t = 1.0", "t = 1"));
    EXPECT_EQ(a.stateAt(240), b.stateAt(240));
    EXPECT_EQ(a.picture(), b.picture());
}

TEST(StateKeys, SeeEveryChangeOfTheScene) {
    const StateKeys a = keysOf(base);
    for (const char* change : {"cloth.flag.cells=[4,5]", "world.gravity=[0,-9.8,0]", "solver.precision=double",
                               "run.fps=30", "collider.ground.friction=0.31", "cloth.flag.hold=[\"right\"]"})
        EXPECT_NE(a.stateAt(0), keysOf(base, {change}).stateAt(0)) << change;
}

TEST(StateKeys, TellPicturesFromStates) {
    const StateKeys a = keysOf(base);
    for (const char* change :
         {"camera.main.eye=[0,1,6]", "light.intensity=2", "cloth.flag.finish.weave=0.5", "picture.samples=1"}) {
        const StateKeys b = keysOf(base, {change});
        EXPECT_EQ(a.stateAt(240), b.stateAt(240)) << change;
        EXPECT_NE(a.picture(), b.picture()) << change;
    }
    for (const char* change : {"run.seconds=5", "title=waves"}) {
        EXPECT_EQ(a.stateAt(240), keysOf(base, {change}).stateAt(240)) << change;
        EXPECT_EQ(a.picture(), keysOf(base, {change}).picture()) << change;
    }
}

// The second action happens when tick 120 begins: the state at tick 120 does not know of it yet.
TEST(StateKeys, SeeAnActionFromItsTickOn) {
    const StateKeys a = keysOf(base);
    const StateKeys b = keysOf(replaced(base, "do = \"free\", target = \"cloth.flag@left\"",
                                        "do = \"free\", target = \"cloth.flag@top-left\""));
    EXPECT_EQ(a.stateAt(120), b.stateAt(120));
    EXPECT_NE(a.stateAt(121), b.stateAt(121));
    const StateKeys c = keysOf(replaced(base, "t = 2.0", "t = 2.5"));
    EXPECT_EQ(a.stateAt(120), c.stateAt(120));
    EXPECT_NE(a.stateAt(121), c.stateAt(121));
}

// A body that is spawned at the end is missing at the start already.
TEST(StateKeys, SeeASpawnFromTheStart) {
    const std::string more = base + "[rope.late]\nends = [[0, 1, 0], [1, 1, 0]]\n";
    const StateKeys a = keysOf(more);
    const StateKeys b =
        keysOf(replaced(more, "at = [", "at = [\n  { t = 3.0, do = \"spawn\", target = \"rope.late\" },"));
    EXPECT_NE(a.stateAt(0), b.stateAt(0));
}

}  // namespace
}  // namespace taut::scene
