#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "image_support.h"
#include "program_support.h"

namespace taut::game {
namespace {

using test::has;
using test::Outcome;
using test::TemporaryFolder;

Outcome reality(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"reality", "--quiet"});
    return test::run(arguments);
}

TEST(RealityCommand, NamesItsRows) {
    EXPECT_TRUE(has(reality({"--list"}).out, "R6   a strip on edge leans aside (with --long)\n"));
    const Outcome wrong = reality({"--only", "R1,R99"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_TRUE(has(wrong.err, "there is no row 'R99'; there are R1, R2")) << wrong.err;
}

TEST(RealityCommand, WritesATableAPageAndScenesThatPlay) {
    const TemporaryFolder folder;
    const Outcome outcome = reality({"--only", "R5", "-o", (folder / "out").string()});
    ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_TRUE(has(outcome.out, "crest/L of a strip shortened by 0.030 L")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "8 of 8 pass")) << outcome.out;
    EXPECT_TRUE(has(test::contentOf(folder / "out/reality.csv"), "\nR5,crest/L of a strip shortened by 0.030 L,"));
    EXPECT_TRUE(has(test::contentOf(folder / "out/reality.html"), "scenes/column.toml"));
    const Outcome checked = test::run({"check", (folder / "out/scenes/column.toml").string()});
    EXPECT_EQ(checked.code, 0) << checked.err;
}

// Three cells are too few for a strip's third frequency and even its first.
TEST(RealityCommand, IsExitCodeOneWhereAQuantityIsBeyondItsTolerance) {
    const TemporaryFolder folder;
    const Outcome outcome = reality({"--only", "R8", "--cells", "3", "-o", (folder / "out").string()});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "FAIL")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "0 of 3 pass")) << outcome.out;
}

}  // namespace
}  // namespace taut::game
