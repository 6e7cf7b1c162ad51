#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "image_support.h"
#include "program_support.h"
#include "taut/core/whole_file.h"

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

// Beside theory, which is 0.124562 at Γ = 1 by finite differences.
TEST(RealityCommand, ShowsBesideTautWhatOthersMeasured) {
    const TemporaryFolder folder;
    core::writeWholeFile(folder / "peers.csv",
                         "peer,gamma,cells,height_over_width,is_at_rest,simulated_s,processor_s,told\n"
                         "Sheet 1.0,1,7,0.124437,1,2.5,0.1,stiffness 3\n"
                         "Sheet 1.0,10,7,3.2,0,60,4,stiffness 30\n");
    const Outcome outcome = reality({"--only", "R11", "--cells", "8", "--beside", (folder / "peers.csv").string(), "-o",
                                     (folder / "out").string()});
    const std::string page = test::contentOf(folder / "out/reality.html");
    EXPECT_TRUE(has(page, "<td>Sheet 1.0, 7 cells</td><td class=\"number\">-0.1 %</td><td class=\"number\">–</td>"))
        << outcome.err;
}

TEST(RealityCommand, SaysWhereAFileOfOthersIsDamaged) {
    const TemporaryFolder folder;
    const std::string head = "peer,gamma,cells,height_over_width,is_at_rest,simulated_s,processor_s,told\n",
                      good = "Sheet,1,7,0.12,1,2.5,0.1,stiffness 3\n";
    const std::pair<std::string, std::string> damaged[] = {
        {"gamma,value\n", ":1: the first line is not \"peer,gamma,cells,"},
        {head + good + "Sheet,1,7,0.12,1,2.5\n", ":3: 6 columns instead of 8"},
        {head + good + "Sheet,much,7,0.12,1,2.5,0.1,3\n", ":3: \"much\" is no number from 1e-06 to 1e+06"},
        {head, ":1: there is no strip in it"},
    };
    for (const auto& [text, said] : damaged) {
        core::writeWholeFile(folder / "peers.csv", text);
        const Outcome outcome = reality({"--beside", (folder / "peers.csv").string(), "-o", (folder / "out").string()});
        EXPECT_NE(outcome.code, 0);
        EXPECT_TRUE(has(outcome.err, "peers.csv" + said)) << outcome.err;
        EXPECT_TRUE(has(outcome.err, "tests/bench/peers.sh")) << outcome.err;
    }
}

}  // namespace
}  // namespace taut::game
