#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image_support.h"
#include "program_support.h"
#include "taut/image/read.h"

namespace taut::game {
namespace {

using test::has;
using test::Outcome;
using test::run;
using test::TemporaryFolder;

TEST(ChartCommand, AloneOrAskedItListsTheProblems) {
    for (const Outcome& outcome : {run({"chart"}), run({"chart", "--list"})}) {
        EXPECT_EQ(outcome.code, 0);
        for (const char* word : {"growth", "cloth-corners", "leapfrog"})
            EXPECT_TRUE(has(outcome.out, word)) << word << " in " << outcome.out;
    }
}

TEST(ChartCommand, WrongWordsAreUsageErrorsWithASuggestion) {
    const Outcome problem = run({"chart", "groth"});
    EXPECT_EQ(problem.code, 2);
    EXPECT_TRUE(has(problem.err, "did you mean growth?")) << problem.err;
    const Outcome far = run({"chart", "xyzzy-nothing-like-it"});
    EXPECT_EQ(far.code, 2);
    EXPECT_TRUE(has(far.err, "--list")) << far.err;
    const Outcome method = run({"chart", "growth", "--methods", "rk4,eulr"});
    EXPECT_EQ(method.code, 2);
    EXPECT_TRUE(has(method.err, "there is no method 'eulr'; did you mean euler?")) << method.err;
    const Outcome unfit = run({"chart", "growth", "--methods", "leapfrog"});
    EXPECT_EQ(unfit.code, 2);
    EXPECT_TRUE(has(unfit.err, "x'' = a")) << unfit.err;
    EXPECT_EQ(run({"chart", "growth", "--precision", "half"}).code, 2);
    for (const char* number : {"nan", "-1", "0", "inf", "1e999", "1s", ""})
        for (const char* flag : {"--seconds", "--budget"}) {
            const Outcome wrong = run({"chart", "growth", flag, number});
            EXPECT_EQ(wrong.code, 2) << flag << " " << number;
            EXPECT_TRUE(has(wrong.err, flag)) << wrong.err;
            EXPECT_LT(wrong.err.size(), 200U) << wrong.err;  // no limit with hundreds of digits
        }
    EXPECT_EQ(run({"chart", "growth", "--set", "run.fps=30"}).code, 2);
    EXPECT_EQ(run({"chart", "no/such.toml"}).code, 6);
}

TEST(ChartCommand, WritesTablesAndPictures) {
    const TemporaryFolder folder;
    const std::string out = (folder / "charts").string();
    const Outcome outcome = run({"chart", "growth", "--methods", "euler,rk4", "--budget", "0.5", "--quiet", "-o", out});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(outcome.err.empty()) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "rk4")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "1359140")) << outcome.out;  // steps of Euler: e/2 · 1e6
    EXPECT_FALSE(has(outcome.out, "heun")) << outcome.out;
    for (const char* name : {"growth.csv", "growth.json", "growth-time.svg", "growth-evaluations.svg"})
        EXPECT_GT(std::filesystem::file_size(folder / "charts" / name), 0U) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "charts/growth-energy.png"));  // y' = y has none
    EXPECT_GT(image::readImage(folder / "charts/growth-time.png").width, 500);
    const auto json = nlohmann::json::parse(test::contentOf(folder / "charts/growth.json"));
    for (const char* key : {"processor", "compiler", "flags", "simd", "commit"})
        EXPECT_FALSE(json["machine"][key].get<std::string>().empty()) << key;
    EXPECT_TRUE(has(test::contentOf(folder / "charts/growth.csv"), "growth,euler,single,"));
}

TEST(ChartCommand, RefusesTheNameOfOneFile) {
    const TemporaryFolder folder;
    const std::string place = (folder / "ch").string();
    for (const char* ending : {".png", ".svg", ".csv"}) {
        const Outcome outcome = run({"chart", "growth", "--methods", "rk4", "--budget", "0.5", "-o", place + ending});
        EXPECT_EQ(outcome.code, 2) << ending;
        EXPECT_TRUE(has(outcome.err, "several files: -o " + place)) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(place + ending));
    }
}

TEST(ChartCommand, TakesAnySceneFile) {
    const TemporaryFolder folder;
    test::writeText(folder / "spring.toml", R"(schema = 1
[run]
seconds = 0.5
[net.spring]
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = 100.0 } ]
)");
    const Outcome outcome =
        run({"chart", (folder / "spring.toml").string(), "--methods", "leapfrog", "--precision", "double", "--budget",
             "1", "--quiet", "-o", (folder / "out").string(), "--set", "net.spring.drag_per_s=0"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(test::contentOf(folder / "out/spring.json"));
    EXPECT_EQ(json["reference"]["kind"], "fehlberg 7(8) at two tolerances");
    EXPECT_FALSE(json["horizon"]["is_reached"].get<bool>());
    ASSERT_FALSE(json["runs"].empty());
    EXPECT_LE(json["runs"][0]["step_s"].get<double>(), 1.0 / 60 * (1 + 1e-12));  // a tick at most
    EXPECT_TRUE(std::filesystem::exists(folder / "out/spring-energy.svg"));
    // A column of the CSV has the name that it has in the JSON.
    const std::string csv = test::contentOf(folder / "out/spring.csv");
    const std::string header = "," + csv.substr(0, csv.find('\n')) + ",";
    for (const auto& [name, value] : json["runs"][0].items()) EXPECT_TRUE(has(header, "," + name + ",")) << name;
}

TEST(ChartCommand, WithoutGnuplotItStillWritesTheNumbers) {
    const TemporaryFolder folder;
    const std::string command =
        "PATH=" + folder.path().string() + " " TAUT_PROGRAM " chart growth --methods rk4 --budget 0.5 -o " +
        (folder / "out").string() + " >" + (folder / "table").string() + " 2>" + (folder / "said").string();
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 6);
    EXPECT_TRUE(has(test::contentOf(folder / "said"), "gnuplot-nox")) << test::contentOf(folder / "said");
    EXPECT_TRUE(has(test::contentOf(folder / "table"), "rk4"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/growth.csv"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/growth.json"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/growth-time.svg"));
}

}  // namespace
}  // namespace taut::game
