// A gas or a liquid that closed bodies hold.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scene_support.h"
#include "support/timelines.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

// A box of 0.5 × 0.5 × 0.4 m whose upper face is a piston: rods keep it as it is, all else gives way at once. The
// diagonals of its sides run to and fro, so that the pressure on them does not turn the piston.
const char* const cubeObj = R"(v 0 0 0
v 0.5 0 0
v 0.5 0 0.5
v 0 0 0.5
v 0 0.4 0
v 0.5 0.4 0
v 0.5 0.4 0.5
v 0 0.4 0.5
f 1 2 3 4
f 5 8 7 6
f 1 5 6
f 1 6 2
f 2 6 3
f 6 7 3
f 3 7 8
f 3 8 4
f 4 8 1
f 8 5 1
)";

std::string piston(const std::string& filling, const std::string& more = "") {
    std::string text = R"(schema = 1
[solver]
precision = "double"
sleep_error_m = 0
[world]
air_pressure_Pa = 1000
[material.slack]
density_kg_per_m2 = 1e-6
stretch_N_per_m = 1e-3
shear_N_per_m = 1e-3
bend_N_per_m = 0
drag_per_s = 20
[cloth.box]
mesh = "box.obj"
material = "slack"
hold = ["#0", "#1", "#2", "#3"]
[[mass]]
target = "cloth.box@top"
mass_kg = 1
)";
    text += "[filling.gas]\nin = [\"cloth.box\"]\n" + filling + "\n";
    const int rods[6][2] = {{4, 5}, {5, 6}, {6, 7}, {7, 4}, {4, 6}, {5, 7}};
    for (const auto& [a, b] : rods)
        text += "[[joint]]\nkind = \"rod\"\na = \"cloth.box@#" + std::to_string(a) + "\"\nb = \"cloth.box@#" +
                std::to_string(b) + "\"\n";
    return text + more;
}

class Fillings : public ::testing::Test {
  protected:
    Fillings() { folder_.write("box.obj", cubeObj); }
    World load(const std::string& text) {
        folder_.write("scene.toml", text);
        return World(scene::loadScene(folder_ / "scene.toml", {}).spec);
    }
    std::string complaint(const std::string& text) {
        try {
            load(text);
        } catch (const core::Error& error) {
            return error.what();
        }
        return "";
    }

  private:
    scene::AssetFolder folder_;
};

double heightOf(const World& world) {
    return world.points("cloth.box@#4").x.front().y;
}
// [Pa] by which the piston presses on the filling.
double weightOf(const World& world) {
    double mass = 0;
    for (const double m : world.points("cloth.box@top").mass) mass += m;
    return mass * 9.81 / 0.25;
}

// (p₀ + P) V₀ = (p₀ + w) V. The slack sheet has 1e-5 of the piston's weight.
TEST_F(Fillings, ASealedGasCarriesAPistonAsBoyleSays) {
    World world = load(piston("keeps = \"amount\"\npressure_Pa = 20"));
    support::run(world, 180);
    EXPECT_NEAR(heightOf(world), 0.4 * 1020.0 / (1000.0 + weightOf(world)), 4e-5);
    World up = load(piston("keeps = \"amount\"\npressure_Pa = 20",
                           "[[at]]\nt = 0.1\nover_s = 0.4\ndo = \"ramp\"\nkey = \"world.air_pressure_Pa\"\n"
                           "to = 900\n"));
    support::run(up, 180);
    EXPECT_NEAR(heightOf(up), 0.4 * 1020.0 / (900.0 + weightOf(up)), 4e-5);
}

// V/V₀ = 1 - w/K: within a thousandth.
TEST_F(Fillings, ALiquidKeepsItsVolume) {
    World world = load(piston("keeps = \"volume\"\nbulk_modulus_Pa = 1e5"));
    support::run(world, 180);
    EXPECT_NEAR(heightOf(world), 0.4 * (1.0 - weightOf(world) / 1e5), 1e-6);
    EXPECT_NEAR(heightOf(world), 0.4, 4e-4);
}

// The piston falls as it would without a gas: its speed tends to g over the drag rate.
TEST_F(Fillings, CutFillingsHoldNothing) {
    World world = load(piston("keeps = \"amount\"",
                              "[[at]]\nt = 1.0\ndo = \"cut\"\ntarget = \"cloth.box\"\n"
                              "plane = [[0, 0.2, 0], [0, 1, 0]]\n"));
    support::run(world, 60);
    const double before = heightOf(world);
    support::run(world, 30);
    const double fall = 9.81 / 20.0 * (0.5 - 1.0 / 20.0);
    EXPECT_NEAR(heightOf(world), before - fall, 0.01 * fall);
}

TEST_F(Fillings, ItGoesOnAsItWasSavedInTheMiddleOfARamp) {
    const std::string text = piston("keeps = \"amount\"",
                                    "[[at]]\nt = 0.1\nover_s = 0.4\ndo = \"ramp\"\n"
                                    "key = \"filling.gas.pressure_Pa\"\nto = 200\n");
    World world = load(text), other = load(text);
    support::run(world, 20);
    other.restore(world.save());
    support::run(world, 60);
    support::run(other, 60);
    EXPECT_EQ(world.stateHash(), other.stateHash());
    support::run(world, 120);
    EXPECT_NEAR(heightOf(world), 0.4 * 1200.0 / (1000.0 + weightOf(world)), 4e-5);
}

// Two sheets, sewn along their edges, part as they are blown up; without the seam nothing presses on them.
TEST_F(Fillings, SewnPartsHoldItWhileTheirSeamHolds) {
    const std::string sheet = "material = \"slack\"\nsize = [0.4, 0.4]\ncells = [4, 4]\norigin = [0, 0, 0]\n";
    const std::string text =
        "schema = 1\n[solver]\nprecision = \"double\"\n[world]\ngravity = [0, 0, 0]\n"
        "[material.slack]\ndrag_per_s = 0\n[cloth.front]\n" +
        sheet + "[cloth.back]\n" + sheet +
        "[[joint]]\nname = \"seam\"\na = \"cloth.front@edges\"\nb = \"cloth.back@edges\"\n"
        "[filling.air]\nin = [\"cloth.front\", \"cloth.back\"]\npressure_Pa = 10\n"
        "[[at]]\nt = 0.05\ndo = \"release\"\nid = \"seam\"\n";
    World world = load(text);
    support::run(world, 3);
    const double pushed = world.metrics("cloth.front").momentum.z;
    EXPECT_GT(pushed, 1e-4);  // its front looks along z, and it is the first
    EXPECT_NEAR(world.metrics("cloth.back").momentum.z, -pushed, 1e-12);
    support::run(world, 2);
    const double free = world.metrics("cloth.front").momentum.z;
    support::run(world, 5);
    EXPECT_NEAR(world.metrics("cloth.front").momentum.z, free, 1e-12);
}

// Eight cells are sewn to nine, by and by: some points of the nine go between those of the eight. The panels open about
// as far as those of eight and eight, and of nine and nine, whose folds are a tenth different.
TEST_F(Fillings, PanelsHoldItWhileTheyAreSewn) {
    const auto opening = [this](int ofFront, int ofBack) {
        const auto sheet = [](const char* name, int cells, double z) {
            return fmt::format(
                "[cloth.{}]\nmaterial = \"m\"\nsize = [0.4, 0.4]\ncells = [{}, {}]\norigin = [0, 0, {}]\n", name, cells,
                cells, z);
        };
        std::string text = "schema = 1\n[world]\ngravity = [0, 0, 0]\n[material.m]\ndrag_per_s = 5\n" +
                           sheet("front", ofFront, 0.02) + sheet("back", ofBack, -0.02) +
                           "[filling.air]\nin = [\"cloth.*\"]\npressure_Pa = 5\n";
        for (const char* side : {"left", "right", "top", "bottom"})
            text += fmt::format("[[seam]]\na = \"cloth.front@{0}\"\nb = \"cloth.back@{0}\"\nover_s = 0.2\n", side);
        World world = load(text);
        support::run(world, 60);
        EXPECT_LT(std::abs(world.points("cloth.front@top-left").x.front().z), 0.02);
        return world.points("cloth.front@(0.5,0.5)").x.front().z - world.points("cloth.back@(0.5,0.5)").x.front().z;
    };
    const double even = 0.5 * (opening(8, 8) + opening(9, 9));
    EXPECT_GT(even, 0.06);
    EXPECT_NEAR(opening(8, 9), even, 0.15 * even);
}

TEST_F(Fillings, BodiesThatHoldNothingAreNamed) {
    const std::string sheet = "schema = 1\n[material.m]\n[cloth.sheet]\nmaterial = \"m\"\ncells = [2, 2]\n";
    EXPECT_NE(complaint(sheet + "[filling.air]\nin = [\"cloth.sheet\"]\n")
                  .find("filling.air: the surface of cloth.sheet at [0, 0, 0] is open along 8 edges"),
              std::string::npos);
    EXPECT_NE(complaint(sheet + "[filling.air]\nin = [\"cloth.shed\"]\n").find("cloth.shed"), std::string::npos);
    const std::string pillow = sheet +
                               "[cloth.back]\nmaterial = \"m\"\ncells = [2, 2]\n[[joint]]\n"
                               "a = \"cloth.sheet@edges\"\nb = \"cloth.back@edges\"\n[filling.air]\n"
                               "in = [\"cloth.*\"]\n";
    EXPECT_EQ(complaint(pillow), "");
    EXPECT_NE(complaint(pillow + "keeps = \"amount\"\n").find("is flat when the scene starts"), std::string::npos);
}

}  // namespace
}  // namespace taut::world
