// A world that is saved and restored before every tick, with other threads, goes on as one that is not: the input of a
// tick is in the bytes.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/playing.h"
#include "taut/ode/method_table.h"
#include "taut/scene/load.h"

namespace taut::world::restoring {
namespace {

struct Case {
    std::string name, text;
    int ticks = 12;
};

void PrintTo(const Case& each, std::ostream* out) {
    *out << each.name;
}

std::string nameOf(const testing::TestParamInfo<Case>& info) {
    return info.param.name;
}

class Restoring : public testing::TestWithParam<Case> {};

SceneSpec sceneOf(const Case& each) {
    return scene::loadSceneText("schema = 1\n" + each.text, "s.toml", {}).spec;
}

TEST_P(Restoring, AtEveryTickWithOtherThreadsChangesNothing) {
    const SceneSpec scene = sceneOf(GetParam());
    const support::Played through = support::play(scene, {.ticks = GetParam().ticks});
    EXPECT_EQ(through.end, "");
    EXPECT_TRUE(through.hasTouched);
    const support::Played restored =
        support::play(scene, {.ticks = GetParam().ticks, .threads = {2, 7, 1}, .restoresEvery = 1});
    EXPECT_EQ(support::differenceOf(through, restored), "");
}

TEST_P(Restoring, ChangesAsLittleAsAskingEverythingBetweenTicks) {
    const SceneSpec scene = sceneOf(GetParam());
    const support::Played asked = support::play(scene, {.ticks = GetParam().ticks, .asksEvery = 1});
    EXPECT_EQ(support::differenceOf(support::play(scene, {.ticks = GetParam().ticks}), asked), "");
    EXPECT_EQ(asked.fault, "");
}

// A stiff sheet that touches asks for more parts of a tick than it is made with.
constexpr const char* stiffCloth = R"(
[material.m]
density_kg_per_m2 = 0.00625
stretch_N_per_m = 50
damping_time_s = 1e-4
[cloth.a]
material = "m"
size = [0.17, 0.11]
cells = [2, 4]
origin = [0, 1, 0]
down = [0, 0, 1]
touch = "others"
hold = ["right"]
[net.ball]
points = [{ name = "p", position = [0.05, 1.012, 0.05] }]
velocity = [0, -0.3, 0]
touch = "others"
)";

std::vector<Case> everyMethod() {
    std::vector<Case> cases;
    for (const ode::MethodInfo& method : ode::methods()) {
        std::string name(method.name);
        std::replace(name.begin(), name.end(), '-', '_');
        cases.push_back({name, "solver.integrator = \"" + std::string(method.name) + "\"\n" + stiffCloth});
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, Restoring, testing::ValuesIn(everyMethod()), nameOf);

// A cloth that falls onto a ball and folds over it.
std::string draped(const std::string& more, const std::string& stretch = "900") {
    return more + R"(
[material.m]
density_kg_per_m2 = 0.057
stretch_N_per_m = )" +
           stretch + R"(
[cloth.a]
material = "m"
size = [0.33, 0.26]
cells = [7, 6]
origin = [-0.16, 0.21, -0.13]
down = [0, 0, 1]
velocity = [0, -2, 0]
touch = "all"
[collider.ball]
shape = "sphere"
radius = 0.2
)";
}

// A block that begins over the corner of a collider, partly inside it.
std::string comingOut(const std::string& shape) {
    return R"(
solver.precision = "double"
[block.b]
size = [0.14, 0.26, 0.36]
cells = [1, 1, 3]
position = [0.034, 0.066, 0.096]
touch = "others"
[collider.k]
)" + shape;
}

const std::vector<Case> cases = {
    {"a_stiff_cloth", draped("", "2e4")},
    {"a_ramp_at_the_start",
     draped("at = [{ t = 0, do = \"ramp\", key = \"material.m.stretch_N_per_m\", to = 1400, over_s = 0.1 }]\n")},
    {"a_hold_at_the_start", draped("at = [{ t = 0, do = \"hold\", target = \"cloth.a@left\" }]\n")},
    {"a_push", draped("at = [{ t = 0.04, do = \"push\", target = \"cloth.a@left\", impulse_Ns = [0, 0.01, 0.01] }]\n")},
    {"gravity_that_jumps", draped("at = [{ t = 0.07, do = \"ramp\", key = \"world.gravity\", to = [9, 9, 0] }]\n")},
    {"a_fixed_step", draped("solver.dt = 8e-5\n")},
    {"heun", draped("solver.integrator = \"heun\"\n")},
    {"double_precision", draped("solver.precision = \"double\"\n")},
    {"a_block_over_the_corner_of_a_box", comingOut("shape = \"box\"\nsize = [0.37, 0.42, 0.34]\n"), 20},
    {"a_compound",
     comingOut("shape = \"compound\"\n"
               "parts = [{ shape = \"box\", size = [0.37, 0.42, 0.34] }, { shape = \"sphere\", radius = 0.3, "
               "position = [-0.03, -0.26, -0.12] }]\n"),
     20},
};

INSTANTIATE_TEST_SUITE_P(Contact, Restoring, testing::ValuesIn(cases), nameOf);

}  // namespace
}  // namespace taut::world::restoring
