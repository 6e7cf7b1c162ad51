// Actions that are read for a world that runs.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene_support.h"
#include "taut/spec/actions.h"
#include "taut/world/world.h"

namespace taut::scene::action_reader_test {
namespace {

constexpr const char* text =
    "schema = 1\n[rope.line]\nends = [[0, 2, 0], [1, 2, 0]]\nsegments = 4\n"
    "[wind.breeze]\nvelocity = [1, 0, 0]\n";

std::string messageOf(const Loaded& loaded, const std::string& action) {
    try {
        (void)loaded.actions->read(action, 0.5, "apply()", loaded.spec);
    } catch (const core::Error& error) {
        return error.what();
    }
    return "";
}

// 3 N s on the rope's kilogram are 3 m/s.
TEST(ActionReader, ReadsWhatATimelineMaySay) {
    const AssetFolder folder;
    const Loaded loaded = folder.load(text);
    world::World world(loaded.spec);
    const auto push = loaded.actions->read("{ do = \"push\", target = \"rope.line\", impulse_Ns = [3, 0, 0] }", 0.0,
                                           "push", loaded.spec);
    world.apply(*push);
    EXPECT_NEAR(world.metrics().momentum.x, 3.0, 1e-6);

    const auto ramp = loaded.actions->read("{ do = \"ramp\", key = \"wind.breeze.velocity\", to = [5, 0, 0] }", 0.0,
                                           "ramp", loaded.spec);
    const auto& change = dynamic_cast<const world::RampAction&>(*ramp);
    EXPECT_EQ(change.value, (std::vector<double>{5, 0, 0}));
    EXPECT_EQ(change.field->read(loaded.spec), (std::vector<double>{1, 0, 0}));
}

// Only keys that have a value to begin from, by the words of the file: this scene has no collider and gives its rope no
// EI.
TEST(ActionReader, ListsWhatRampsMayChange) {
    const AssetFolder folder;
    const Loaded loaded = folder.load(text);
    const std::vector<Rampable> all = loaded.actions->rampable(loaded.spec);
    const auto find = [&](const std::string& key) {
        return std::find_if(all.begin(), all.end(), [&](const Rampable& field) { return field.key == key; });
    };
    const auto wind = find("wind.breeze.velocity");
    ASSERT_NE(wind, all.end());
    EXPECT_EQ(wind->unit, "m/s");
    EXPECT_EQ(wind->value, (std::vector<double>{1, 0, 0}));
    EXPECT_NE(find("world.gravity"), all.end());
    EXPECT_TRUE(std::none_of(all.begin(), all.end(), [](const Rampable& field) { return field.value.empty(); }));
    for (const Rampable& field : all) EXPECT_NO_THROW(loaded.actions->ramp(field.key, loaded.spec)) << field.key;
}

TEST(ActionReader, RefusesTheRestWithItsRemedy) {
    const AssetFolder folder;
    const Loaded loaded = folder.load(text);
    const auto expect = [&](const std::string& action, const std::string& part) {
        const std::string message = messageOf(loaded, action);
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expect("{ do = \"push\", target = \"rope.lime\", impulse_Ns = [3, 0, 0] }", "did you mean \"rope.line\"?");
    expect("{ do = \"push\", target = \"rope.line\", impulse_Ns = [3, 0] }", "apply(): error: ");
    expect("{ do = \"pusch\", target = \"rope.line\" }", "did you mean \"push\"?");
    expect("{ do = \"push\", target = \"rope.line\", impulse_Ns = [3, 0, 0], t = 1.0 }", "leave t out");
    expect("{ do = \"ramp\", key = \"wind.breeze.sped\", to = 1 }", "keys of ramps: ");
    expect("{ do = \"release\" ", "apply(): error: ");
    expect("{ do = \"release\", id = \"hand\" }, { do = \"release\", id = \"hand\" }", "one action");
}

}  // namespace
}  // namespace taut::scene::action_reader_test
