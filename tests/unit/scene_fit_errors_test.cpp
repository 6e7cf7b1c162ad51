// Every row: a faulty fit and the exact message with file, line, column, caret and remedy.
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

constexpr const char* fittedRope =
    "[rope.r]\n"
    "ends = [[0, 0, 0], [1, 0, 0]]\n"
    "mass_kg = 0.5\n";
constexpr const char* fitTarget =
    "[[fit.target]]\n"
    "that = \"lowest(rope.r)\"\n"
    "at = 1\n"
    "value = 0.2\n"
    "sigma = 0.1\n";

std::string fitMessage(const std::string& fit, const AssetFolder& folder) {
    return folder.messageOf("schema = 1\n" + std::string(fittedRope) + fit);
}

std::string keyMessage(const std::string& key, const std::string& more = "") {
    const AssetFolder folder;
    return fitMessage("[fit]\nkeys = [\"" + key + "\"]\nlow = 0.1\nhigh = 1\n" + fitTarget + more, folder);
}

TEST(SceneErrors, KeysOfAFitLeadToNumbers) {
    EXPECT_EQ(keyMessage("rope.r.mass_kg"), "");
    EXPECT_EQ(keyMessage("rope.r.mass_gk"),
              "s.toml:6:9: error: rope.r has no \"mass_gk\" to begin from\n"
              "  keys = [\"rope.r.mass_gk\"]\n"
              "          ^ did you mean \"mass_kg\"?");
    EXPECT_EQ(keyMessage("rope.r.drag_per_s"),
              "s.toml:6:9: error: rope.r has no \"drag_per_s\" to begin from\n"
              "  keys = [\"rope.r.drag_per_s\"]\n"
              "          ^ give it a value in the scene");
    EXPECT_EQ(keyMessage("rope.r.ends.1"),
              "s.toml:6:9: error: rope.r.ends.1 is a list of 3, not a number\n"
              "  keys = [\"rope.r.ends.1\"]\n"
              "          ^ name one of its numbers, rope.r.ends.1.0");
    EXPECT_EQ(keyMessage("rope.r.ends.1.0"), "");
    EXPECT_EQ(keyMessage("picture.samples", "[picture]\nsamples = 4\n"),
              "s.toml:6:9: error: picture.samples is a whole number, which cannot be fitted\n"
              "  keys = [\"picture.samples\"]\n"
              "          ^");
    EXPECT_EQ(keyMessage("material.m.bending_rigidity_N_m",
                         "[material.m]\nbending_rigidity_N_m = { warp = 0.5, weft = 0.5 }\n"),
              "s.toml:6:9: error: material.m.bending_rigidity_N_m is a table, not a number\n"
              "  keys = [\"material.m.bending_rigidity_N_m\"]\n"
              "          ^ name one of its keys, material.m.bending_rigidity_N_m.warp");
}

TEST(SceneErrors, BoundsOfAFitAreInOrderAndHoldTheValue) {
    const AssetFolder folder;
    const auto bounds = [&](const std::string& low, const std::string& high) {
        return fitMessage("[fit]\nkeys = [\"rope.r.mass_kg\"]\nlow = " + low + "\nhigh = " + high + "\n" + fitTarget,
                          folder);
    };
    EXPECT_EQ(bounds("[2]", "[1]"),
              "s.toml:7:8: error: low of rope.r.mass_kg is 2, high is 1\n"
              "  low = [2]\n"
              "         ^ low must be less");
    EXPECT_EQ(bounds("[-1]", "[1]"),
              "s.toml:7:8: error: rope.r.mass_kg must be above 0 kg\n"
              "  low = [-1]\n"
              "         ^");
    EXPECT_EQ(bounds("[1, 2]", "[3]"),
              "s.toml:7:7: error: there are 1 keys and 2 numbers here\n"
              "  low = [1, 2]\n"
              "        ^ write one for each key");
    EXPECT_EQ(bounds("1", "3"),
              "s.toml:4:11: error: rope.r.mass_kg is 0.5, outside of the bounds of [fit], 1 and 3\n"
              "  mass_kg = 0.5\n"
              "            ^ begin within them");
}

TEST(SceneErrors, TargetsOfAFitAreNumbersWithASigma) {
    const AssetFolder folder;
    const auto with = [&](const std::string& lines) {
        return fitMessage("[fit]\nkeys = [\"rope.r.mass_kg\"]\nlow = 0.1\nhigh = 1\n[[fit.target]]\n" + lines, folder);
    };
    EXPECT_EQ(with("that = \"position(rope.r)\"\nat = 1\nvalue = 2\nsigma = 1\n"),
              "s.toml:10:8: error: this is 3 numbers, not one\n"
              "  that = \"position(rope.r)\"\n"
              "         ^ of a vector .x, .y or .z, or length(…)");
    EXPECT_EQ(with("that = \"lowest(rope.s)\"\nat = 1\nvalue = 2\nsigma = 1\n"),
              "s.toml:10:16: error: there is no rope.s\n"
              "  that = \"lowest(rope.s)\"\n"
              "                 ^ did you mean \"rope.r\"?");
    EXPECT_EQ(with("that = \"lowest(rope.r)\"\nat = 9\nvalue = 2\nsigma = 1\n"),
              "s.toml:11:6: error: 9 s is past the end: the last frame shows 4.98333 s\n"
              "  at = 9\n"
              "       ^ set seconds in [run]");
    EXPECT_EQ(with("that = \"lowest(rope.r)\"\nat = 1\nvalue = 2\n"),
              "s.toml:9:1: error: target[0] of [fit] needs sigma\n"
              "  [[fit.target]]\n"
              "  ^ how far the measured value may be off");
    EXPECT_EQ(with("that = \"time\"\ncurve = \"curve.csv\"\n"), "");
    folder.write("bad.csv", "time,value\n0,1\n1,x\n");
    EXPECT_EQ(with("that = \"time\"\ncurve = \"bad.csv\"\nsigma = 1\n"),
              "s.toml:11:9: error: cannot use this curve: bad.csv:3: \"1,x\" is not time, value, and optionally sigma\n"
              "  curve = \"bad.csv\"\n"
              "          ^");
    EXPECT_EQ(with("that = \"time\"\ncurve = \"bad.csv\"\n"),
              "s.toml:11:9: error: cannot use this curve: bad.csv:2: there is no sigma, here or at the target\n"
              "  curve = \"bad.csv\"\n"
              "          ^");
    EXPECT_EQ(with("that = \"time\"\ncurve = \"none.csv\"\nsigma = 1\n"),
              "s.toml:11:9: error: there is no file \"none.csv\"\n"
              "  curve = \"none.csv\"\n"
              "          ^ looked for none.csv");
}

}  // namespace
}  // namespace taut::scene
