#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "game/folders.h"
#include "image_support.h"
#include "program_support.h"
#include "taut/pipeline/self_test.h"
#include "taut/render/renderer.h"
#include "taut/world/result_bits.h"

namespace taut::game {
namespace {

using test::has;
using test::Outcome;
using test::run;
using test::TemporaryFolder;

// A mass on a spring, half a second at 20 pictures a second.
std::filesystem::path springScene(const TemporaryFolder& folder) {
    const auto path = folder / "spring.toml";
    test::writeText(path, R"(schema = 1
[run]
fps = 20
seconds = 0.5
[picture]
size = [64, 48]
[net.spring]
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0] } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = 100.0 } ]
)");
    return path;
}

TEST(Program, AloneItShowsHowToBegin) {
    const Outcome outcome = run({});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(has(outcome.out, "taut render flag -o flag.mp4")) << outcome.out;
    int commands = 0;  // a line each, with its example
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("  ")) continue;
        const std::string command = line.substr(2, line.find(' ', 2) - 2);
        EXPECT_TRUE(has(line, " taut " + command + " ")) << line;
        EXPECT_EQ(run({command, "--help"}).code, 0) << command;
        ++commands;
    }
    EXPECT_EQ(commands, 6);
}

TEST(Program, HelpIsAResult) {
    EXPECT_EQ(run({"--help"}).code, 0);
    EXPECT_TRUE(has(run({"--help"}).out, "doctor"));
    EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
    EXPECT_EQ(run({"help", "render"}).out, run({"render", "--help"}).out);
    EXPECT_EQ(run({"help", "rendr"}).code, 2);
    EXPECT_TRUE(has(run({"help", "rendr"}).err, "did you mean render?"));
    EXPECT_EQ(run({"-V"}).out, run({"--version"}).out);
    EXPECT_TRUE(has(run({"render", "--help"}).out, "--frames"));
}

TEST(Program, ListsShippedScenesWithALineEach) {
    const Outcome outcome = run({"list"});
    EXPECT_EQ(outcome.code, 0);
    std::istringstream lines(outcome.out);
    std::size_t files = 0;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("  ") && line.size() > 30) ++files;  // a name and a sentence
    EXPECT_EQ(files, shippedScenes().size() + shippedScenarios().size()) << outcome.out;
}

TEST(Program, TheManualIsFoundByTheWordsOfItsHeadings) {
    EXPECT_EQ(run({"manual", "sleep"}).out, run({"manual", "contact"}).out);
    const std::string several = run({"manual", "limits"}).out;
    EXPECT_TRUE(has(several, "taut manual contact ") && has(several, "taut manual scenes ")) << several;
    const Outcome none = run({"manual", "quarks"});
    EXPECT_EQ(none.code, 2);
    EXPECT_TRUE(has(none.err, "contact")) << none.err;
}

TEST(Program, UnknownWordsAreUsageErrorsWithASuggestion) {
    const Outcome command = run({"rendr", "flag"});
    EXPECT_EQ(command.code, 2);
    EXPECT_TRUE(has(command.err, "unknown command 'rendr'; did you mean render?")) << command.err;
    const Outcome flag = run({"render", "flag", "--sise", "64x48", "-o", "x.mp4"});
    EXPECT_EQ(flag.code, 2);
    EXPECT_TRUE(has(flag.err, "unknown flag --sise; did you mean --size?")) << flag.err;
    EXPECT_EQ(run({"--nonsense"}).code, 2);
    EXPECT_EQ(run({"render"}).code, 2);
    EXPECT_EQ(run({"render", "flag", "-y", "-n", "-o", "x.mp4"}).code, 2);
    EXPECT_EQ(run({"render", "flag", "--threads", "0", "-o", "x.mp4"}).code, 2);
    EXPECT_TRUE(has(run({"plan", "flag", "--effort", "2e8"}).err, "1000000.000000 times 1e9: 0.2 means 2e8"));
    EXPECT_TRUE(has(run({"render", "flag", "-o", "a.png"}).err, "a_######.png"));
}

TEST(Program, OutputsThatCannotBeMeantAreUsageErrors) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string(), video = (folder / "a.mp4").string();
    const Outcome twice = run({"render", scene, "-o", video, "--video", video});
    EXPECT_EQ(twice.code, 2);
    EXPECT_TRUE(has(twice.err, "name the same file")) << twice.err;
    const Outcome webp = run({"render", scene, "-o", (folder / "a.webp").string()});
    EXPECT_EQ(webp.code, 2);
    EXPECT_TRUE(has(webp.err, ".mp4, .mov, .mkv, .webm or .gif")) << webp.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.webp"));
}

TEST(Program, LayersThatAnOutputCannotHoldAreUsageErrorsWithARemedy) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    const Outcome alpha = run({"render", scene, "-o", (folder / "a.mp4").string(), "--alpha"});
    EXPECT_EQ(alpha.code, 2);
    EXPECT_TRUE(has(alpha.err, "a .mp4 has no transparency: write") && has(alpha.err, "a.webm")) << alpha.err;
    const Outcome depth = run({"render", scene, "-o", (folder / "a.webm").string(), "--depth"});
    EXPECT_EQ(depth.code, 2);
    EXPECT_TRUE(has(depth.err, "--depth writes files beside frames")) << depth.err;
    EXPECT_EQ(run({"render", scene, "-o", (folder / "a").string(), "--alpha", "--debug"}).code, 2);
    EXPECT_EQ(run({"render", scene, "-o", (folder / "a").string(), "--depth-range", "5"}).code, 2);
}

TEST(Program, PicturesAreTheSameHoweverManyAreDrawnAtOnce) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    std::vector<std::string> frames;
    for (const char* drawers : {"1", "3"}) {
        const Outcome outcome = run({"render", scene, "-o", (folder / drawers).string(), "--threads", drawers,
                                     "--quiet", "--hash", "--overlay"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        std::string all = outcome.out;
        for (int i = 0; i < 10; ++i)
            all += test::contentOf(folder / drawers / ("frame_00000" + std::to_string(i) + ".png"));
        frames.push_back(all);
    }
    EXPECT_EQ(frames[0], frames[1]);
}

TEST(Program, LayersLieBesideTheirFramesAndTheRecordExplainsThem) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string(), out = (folder / "out").string();
    EXPECT_EQ(run({"render", scene, "-o", out, "--frames", "0", "--depth", "--mask", "--quiet"}).code, 0);
    for (const char* name : {"frame_000000.png", "frame_000000.depth.png", "frame_000000.mask.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
    const auto layers = nlohmann::json::parse(test::contentOf(folder / "out/run_0-0.json"))["layers"];
    EXPECT_DOUBLE_EQ(layers["depth"]["metres_per_unit"].get<double>(), 0.001);
    EXPECT_EQ(layers["mask"]["net.spring"], "#800000");
    // The frame itself is not there any more, but the files beside it are spared too.
    std::filesystem::remove(folder / "out/frame_000000.png");
    std::filesystem::remove(folder / "out/run_0-0.json");
    EXPECT_EQ(run({"render", scene, "-o", out, "--frames", "0", "--depth", "-n", "--quiet"}).code, 6);
}

TEST(Program, MetricsOfExpressionsAreColumnsBesideTheOthers) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string(), out = (folder / "out").string();
    const Outcome wrong =
        run({"render", scene, "-o", out, "--no-pictures", "--quiet", "--metrics-of", "position(net.sprig@bob)"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_TRUE(has(wrong.err, "--metrics-of: there is no net.sprig; did you mean \"net.spring\"?")) << wrong.err;
    const Outcome right = run({"render", scene, "-o", out, "--no-pictures", "--quiet", "--metrics-of",
                               "position(net.spring@bob).y,speed(net.spring@bob)"});
    EXPECT_EQ(right.code, 0) << right.err;
    const std::string csv = test::contentOf(folder / "out/metrics.csv");
    EXPECT_TRUE(has(csv, "kinetic_J")) << csv;
    EXPECT_TRUE(has(csv, ",position(net.spring@bob).y,speed(net.spring@bob)\n")) << csv;
    EXPECT_TRUE(has(csv, ",1,0\n")) << csv;
}

TEST(Program, NeverOverwritingSparesTheRecordOfTheRunToo) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string(), frames = (folder / "f_######.png").string();
    EXPECT_EQ(run({"render", scene, "-o", frames, "--seconds", "0.1", "--quiet"}).code, 0);
    const Outcome again = run({"render", scene, "-o", frames, "--no-pictures", "-n"});
    EXPECT_EQ(again.code, 6);
    EXPECT_TRUE(has(again.err, "run.json exists already")) << again.err;
}

TEST(Program, WithoutAGlContextItIsExitCodeSevenAndTellsWhatWasTried) {
    const TemporaryFolder folder;
    // A vendor folder that is empty leaves EGL without any implementation.
    const std::string command = "__EGL_VENDOR_LIBRARY_DIRS=" + folder.path().string() + " " TAUT_PROGRAM " render " +
                                springScene(folder).string() + " -o " + (folder / "f_######.png").string() +
                                " --gl egl 2>" + (folder / "said").string();
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 7);
    EXPECT_TRUE(has(test::contentOf(folder / "said"), "egl")) << test::contentOf(folder / "said");
}

TEST(Program, DoctorSaysWhatIsLostWithoutEachThingAndWhichPackageHasIt) {
    if (render::backends().front() != render::Backend::osmesa) GTEST_SKIP() << "draws by OSMesa while EGL is missing";
    const TemporaryFolder folder;  // empty: neither programs nor drivers of EGL
    const std::string bare =
        "env -u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER TAUT_FONT=/no/font PATH=" + folder.path().string() +
        " __EGL_VENDOR_LIBRARY_DIRS=" + folder.path().string();
    const std::filesystem::path told = folder / "told";
    EXPECT_EQ(WEXITSTATUS(std::system((bare + " " TAUT_PROGRAM " doctor >" + told.string()).c_str())), 0);
    const std::string text = test::contentOf(told);
    for (const char* line : {"ffmpeg      MISSING: no videos; ", "gnuplot     MISSING: no charts and maps; ",
                             "font        MISSING: no labels in scenes and no figures over pictures: ",
                             "window      MISSING: no taut play, ", " the package xvfb\n", "egl         no device here",
                             "All packages are installed.\n",
                             "apt install ffmpeg gnuplot-nox fonts-dejavu-core libegl-mesa0 libgl1-mesa-dri\n"})
        EXPECT_TRUE(has(text, line)) << line << " in " << text;
    const std::string nothing = bare + " TAUT_ASSETS=" + folder.path().string() +
                                " TAUT_SHADERS=" + folder.path().string() + " " TAUT_PROGRAM " doctor >" +
                                told.string();
    EXPECT_EQ(WEXITSTATUS(std::system(nothing.c_str())), 7);
    EXPECT_TRUE(has(test::contentOf(told), "pictures    MISSING: none without osmesa or egl;"))
        << test::contentOf(told);
    EXPECT_TRUE(has(test::contentOf(told), "\nPackages are missing.\n")) << test::contentOf(told);
}

TEST(Program, ADeviceIsANumber) {
    for (const char* name : {"egl:", "egl:-1", "egl:0x", "osmesa:0", "glx"})
        EXPECT_EQ(run({"render", "flag", "--gl", name, "--no-pictures"}).code, 2) << name;
}

TEST(Program, DoctorTellsOfEverythingTheProgramNeeds) {
    const TemporaryFolder folder;
    const Outcome outcome = run({"doctor"});
    for (const char* word : {"ffmpeg", "osmesa", "egl:0 ", "avx2", "shaders", "font "})
        EXPECT_TRUE(has(outcome.out, word)) << word << " in " << outcome.out;
    const bool hasOsmesa = render::backends().front() == render::Backend::osmesa;
    EXPECT_TRUE(has(outcome.out, hasOsmesa ? "the same pixels as OSMesa" : "OSMesa was not found")) << outcome.out;
    EXPECT_EQ(outcome.code, 0);
}

TEST(Program, MissingSceneIsExitCodeSix) {
    const Outcome outcome = run({"check", "no/such.toml"});
    EXPECT_EQ(outcome.code, 6);
    EXPECT_TRUE(has(outcome.err, "there is no such scene file")) << outcome.err;
    EXPECT_EQ(run({"info", "no-such-scene-at-all"}).code, 6);
}

TEST(Program, CheckReportsEveryFaultAndTheRightFilesToo) {
    const TemporaryFolder folder;
    test::writeText(folder / "bad.toml", "schema = 1\n[run]\nfps = -3\nsecond = 4\n");
    const Outcome outcome = run({"check", (folder / "bad.toml").string(), springScene(folder).string()});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(has(outcome.err, "bad.toml:3:")) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "bad.toml:4:")) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "spring.toml: ok")) << outcome.out;
}

TEST(Program, CheckOfAFolderHasALineForEveryFileAndTheWorstCode) {
    const TemporaryFolder folder;
    springScene(folder);
    test::writeText(folder / "bad.toml", "schema = 1\n[run]\nfps = -3\n");
    test::writeText(folder / "notes.txt", "no scene\n");
    const Outcome outcome = run({"check", (folder / "no-such-scene.toml").string(), (folder / "").string()});
    EXPECT_EQ(outcome.code, 6);  // of 6 and 3
    EXPECT_TRUE(has(outcome.out, "no-such-scene.toml: wrong\n")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "bad.toml: wrong\n")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "spring.toml: ok\n")) << outcome.out;
    EXPECT_FALSE(has(outcome.out + outcome.err, "notes.txt")) << outcome.err;
    EXPECT_EQ(run({"check", (folder / "bad.toml").string()}).out, "");
}

TEST(Program, CheckForEditorsAndCi) {
    const TemporaryFolder folder;
    const std::string spring = springScene(folder).string(), bad = (folder / "bad.toml").string();
    test::writeText(bad, "schema = 1\n[run]\nfps = -3\nsecond = 4\n");
    const Outcome outcome = run({"check", bad, spring, "--json"});
    EXPECT_EQ(outcome.code, 3);
    const auto all = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0]["ok"], false);
    ASSERT_EQ(all[0]["errors"].size(), 2U) << outcome.out;
    EXPECT_EQ(all[0]["errors"][1]["file"], bad);
    EXPECT_EQ(all[0]["errors"][1]["line"], 4);
    EXPECT_EQ(all[0]["errors"][1]["column"], 1);
    EXPECT_EQ(all[0]["errors"][1]["message"], "[run] has no key \"second\"");
    EXPECT_EQ(all[0]["errors"][1]["remedy"], "did you mean \"seconds\"?");
    EXPECT_EQ(all[1]["scene"], spring);
    EXPECT_EQ(all[1]["ok"], true);
    EXPECT_TRUE(all[1]["warnings"].empty()) << outcome.out;
    // A wind above any storm is a warning of the world, which --quick does not build.
    const std::string windy = (folder / "windy.toml").string();
    test::writeText(windy, "schema = 1\nscene = \"spring.toml\"\n[wind.storm]\nvelocity = [200, 0, 0]\n");
    const std::vector<std::string> storm{"check", windy};
    const auto with = [&](const std::string& flag) {
        std::vector<std::string> words = storm;
        words.push_back(flag);
        return run(words);
    };
    EXPECT_EQ(run(storm).code, 0);
    EXPECT_TRUE(has(run(storm).err, "faster than any storm"));
    EXPECT_EQ(with("--strict").code, 3);
    EXPECT_TRUE(has(with("--strict").out, "windy.toml: wrong"));
    EXPECT_FALSE(has(with("--quick").err, "storm"));
}

TEST(Program, CheckForEditorsKeepsPlacesAndTextsApart) {
    const TemporaryFolder folder;
    const auto errorOf = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"check", "--json"});
        const Outcome outcome = run(words);
        const auto errors = nlohmann::json::parse(outcome.out).at(0).at("errors");
        EXPECT_EQ(errors.size(), 1U) << outcome.out;
        return errors.at(0);
    };
    // The name of the file reads like a message, and the text has the place of a face, which is found as the cloth is
    // built.
    const std::string odd = (folder / "odd:1:2: error: name.toml").string(), mesh = (folder / "double.obj").string();
    test::writeText(mesh, "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\nf 1 2 3\n");
    test::writeText(odd, "schema = 1\n[cloth.sheet]\nmesh = \"double.obj\"\nmaterial = \"fabric:tropical\"\n");
    EXPECT_EQ(errorOf({odd}), (nlohmann::json{{"file", odd},
                                              {"line", 2},
                                              {"column", 8},
                                              {"message", "cannot use this mesh: " + mesh +
                                                              ":5: error: this face is there twice: delete one"}}));
    const auto flag = errorOf({springScene(folder).string(), "--set", "run.second=2"});
    EXPECT_EQ(flag, (nlohmann::json{{"file", "--set run.second"},
                                    {"message", "[run] has no key \"second\""},
                                    {"remedy", "did you mean \"seconds\"?"}}));
    EXPECT_EQ(errorOf({(folder / "none.toml").string()}).count("file"), 0U);
}

TEST(Program, CheckDoesNotBuildMorePointsThanItHasTimeFor) {
    const TemporaryFolder folder;
    const std::string file = (folder / "large.toml").string();
    test::writeText(file,
                    "schema = 1\n[block.wall]\nsize = [100, 100, 1]\ncells = [1000, 1000, 1]\n"
                    "[wind.storm]\nvelocity = [200, 0, 0]\n");  // 2 000 000 points; the world would warn of the storm
    const Outcome outcome = run({"check", file});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(has(outcome.err, "too many points to simulate the start")) << outcome.err;
    EXPECT_FALSE(has(outcome.err, "storm")) << outcome.err;
}

TEST(Program, ANewSceneIsRightAndIsNotOverwritten) {
    const TemporaryFolder folder;
    const std::string file = (folder / "own/first.toml").string();
    const Outcome made = run({"new", (folder / "own/first").string(), "--with", "rope", "--with", "cloth", "--with",
                              "block", "--with", "net", "--with", "rope", "--with", "solid", "--with", "hinge"});
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_TRUE(has(made.out, "taut render " + file + " -o first.mp4\n")) << made.out;
    const Outcome checked = run({"check", file});
    EXPECT_EQ(checked.code, 0);
    EXPECT_FALSE(has(checked.err, "warning")) << checked.err;
    EXPECT_TRUE(has(test::contentOf(file), "[rope.first2]"));
    EXPECT_EQ(run({"new", file}).code, 6);
    EXPECT_TRUE(has(test::contentOf(file), "[rope.first2]"));
    EXPECT_EQ(run({"new", file, "-y"}).code, 0);
    EXPECT_FALSE(has(test::contentOf(file), "[rope.first2]"));
    EXPECT_EQ(run({"new", (folder / "a b").string()}).code, 2);
    EXPECT_EQ(run({"new", (folder / "c").string(), "--with", "string"}).code, 2);
}

TEST(Program, CheckRefusesWhatTheRunWouldRefuseLater) {
    const TemporaryFolder folder;
    const std::filesystem::path spring = springScene(folder);
    test::writeText(folder / "grab.toml",
                    "schema = 1\nscene = \"spring.toml\"\nat = [\n"
                    "  { t = 0.3, do = \"grab\", id = \"hand\", target = \"net.spring@nail\" },\n]\n");
    const Outcome grab = run({"check", (folder / "grab.toml").string()});
    EXPECT_EQ(grab.code, 3);
    EXPECT_TRUE(has(grab.err, "grab.toml:4:3: error: every point of \"net.spring@nail\" is held already; free them"))
        << grab.err;
    // ω = 10 /s, of which leap-frog stands 0.2 s; a tick has 1/60 s. With a thousand times the stiffness it diverges.
    EXPECT_EQ(run({"check", spring.string(), "--set", "solver.dt=0.1"}).code, 0);
    const std::string springs = "[ { a = \"nail\", b = \"bob\", stiffness_N_per_m = 1e6 } ]";
    const Outcome step =
        run({"check", spring.string(), "--set", "solver.dt=0.1", "--set", "net.spring.springs=" + springs});
    EXPECT_EQ(step.code, 3);
    EXPECT_TRUE(has(step.err, "it will diverge")) << step.err;
    EXPECT_FALSE(has(step.out, "ok")) << step.out;
}

TEST(Program, InfoRehearsesWhatTheSceneCosts) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    const auto json = nlohmann::json::parse(run({"info", scene, "--json"}).out);
    EXPECT_LE(json["processor_s_per_frame"][0].get<double>(), json["processor_s_per_frame"][1].get<double>());
    EXPECT_FALSE(json["contacts_may_come"].get<bool>());
    EXPECT_EQ(json["rehearsed_ticks"], (json["frames"].get<int>() - 1) * json["ticks_per_frame"].get<int>());
    EXPECT_GE(json["processor_s"].get<double>(), 0);
    const std::string whole = run({"info", scene}).out;
    EXPECT_TRUE(has(whole, "of processor time for the whole scene")) << whole;
    EXPECT_FALSE(has(whole, "rehearsed")) << whole;
    // It diverges on the way: ω h = 1000 / 60, of which leap-frog stands 2.
    const std::string springs = "[ { a = \"nail\", b = \"bob\", stiffness_N_per_m = 1e6, rest_length_m = 0.9 } ]";
    const std::string part =
        run({"info", scene, "--set", "solver.dt=0.1", "--set", "net.spring.springs=" + springs}).out;
    EXPECT_TRUE(has(part, " ticks simulated, the others as the last ")) << part;
}

TEST(Program, InfoTellsOfContactBetweenBodies) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    EXPECT_TRUE(nlohmann::json::parse(run({"info", scene, "--json"}).out)["contact"].is_null());
    test::writeText(folder / "two.toml",
                    "schema = 1\n[rope.a]\nends = [[0, 0, 0], [1, 0, 0]]\nsegments = 4\ntouch = \"all\"\n"
                    "[rope.b]\nends = [[0, 2, 0], [1, 2, 0]]\nsegments = 2\nthickness = 0.2\ntouch = \"others\"\n");
    const std::string two = (folder / "two.toml").string();
    const auto contact = nlohmann::json::parse(run({"info", two, "--json"}).out)["contact"];
    EXPECT_EQ(contact["points"], 5 + 3);
    EXPECT_EQ(contact["bodies"][0]["shortest_edge_m"], 0.25);
    EXPECT_GE(contact["most_detections"].get<double>(), contact["mean_detections"].get<double>());
    const std::string text = run({"info", two}).out;
    EXPECT_TRUE(has(text, "\ncontact of rope.a, rope.b\n  detections  ")) << text;
    EXPECT_TRUE(has(text, "layers of rope.b lie 0.4 m apart, its shortest edge is 0.5 m\n")) << text;
}

TEST(Program, InfoListsWhatJointsTie) {
    const TemporaryFolder folder;
    test::writeText(folder / "tied.toml",
                    "schema = 1\n[rope.a]\nends = [[0, 1, 0], [1, 1, 0]]\nhold = [\"start\"]\n"
                    "[rope.b]\nends = [[1, 1, 0], [2, 1, 0]]\n"
                    "[[joint]]\na = \"rope.a@end\"\nb = \"rope.b@start\"\n");
    const std::string scene = (folder / "tied.toml").string();
    EXPECT_TRUE(has(run({"info", scene}).out, "weld rope.a@end – rope.b@start: 1 point\n  rope.a – rope.b  1\n"));
    const auto json = nlohmann::json::parse(run({"info", scene, "--json"}).out);
    EXPECT_EQ(json["joints"][0]["pairs"][0]["b"], "rope.b");
    EXPECT_TRUE(has(run({"info", scene, "--set", "rope.b.ends=[[1.015, 1, 0], [2, 1, 0]]"}).out,
                    ": 1 point, moved together by up to 0.015 m\n"));
}

// A box of 0.2 m, 0.4 m and 0.6 m about [1, 2, 3]. Its points are 2 mm within, its thickness.
TEST(Program, InfoListsNamesAsJson) {
    const TemporaryFolder folder;
    test::writeText(folder / "box.toml",
                    "schema = 1\n[solid.box]\nshape = \"box\"\nsize = [0.2, 0.4, 0.6]\nposition = [1, 2, 3]\n");
    const auto all =
        nlohmann::json::parse(run({"info", (folder / "box.toml").string(), "--points", "solid.*", "--json"}).out);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0]["name"], "solid.box");
    const auto expectAt = [](const nlohmann::json& place, std::array<double, 3> x) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(place[k].get<double>(), x[k], 1e-12);
    };
    const auto corner = all[0]["points"]["front-top-left"];
    ASSERT_EQ(corner.size(), 1U);
    expectAt(all[0]["positions_m"][corner[0].get<std::size_t>()], {0.902, 2.198, 3.298});
    expectAt(all[0]["places_m"]["centre"], {1, 2, 3});
    expectAt(all[0]["places_m"]["top-middle"], {1, 2.2, 3});
}

TEST(Program, InfoTellsWhatTheSceneBuilds) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    EXPECT_TRUE(has(run({"info", scene}).out, "net.spring"));
    const auto json = nlohmann::json::parse(run({"info", scene, "--json"}).out);
    EXPECT_EQ(json["frames"], 10);
    EXPECT_EQ(json["islands"][0]["points"], 2);
    // ω = √(k/m) of 100 N/m and 1 kg; the bound may not lie below it.
    EXPECT_GE(json["islands"][0]["omega_B1_per_s"].get<double>(), 10.0 * (1.0 - 1e-12));
}

TEST(Program, HashesNeedNoPicturesAndRepeat) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    const Outcome first = run({"render", scene, "--no-pictures", "--hash", "--quiet"});
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(std::count(first.out.begin(), first.out.end(), '\n'), 10);
    EXPECT_TRUE(first.out.starts_with("0 "));
    EXPECT_TRUE(first.err.empty()) << first.err;
    const Outcome second = run({"render", "--threads", "1", "--quiet", "--hash", "--no-pictures", scene});
    EXPECT_EQ(first.out, second.out);
    // 20 frames a second have 3 ticks a frame; the last of 10 frames is tick 27.
    const Outcome ticks = run({"render", scene, "--no-pictures", "--hash-every", "tick", "--quiet"});
    EXPECT_EQ(std::count(ticks.out.begin(), ticks.out.end(), '\n'), 28);
}

TEST(Program, FlagsOverrideTheScene) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    const Outcome outcome =
        run({"render", scene, "--no-pictures", "--hash", "--quiet", "--fps", "10", "--seconds", "2"});
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 20) << outcome.err;
    EXPECT_EQ(run({"render", scene, "--no-pictures", "--frames", "5-10"}).code, 2);
    EXPECT_EQ(run({"render", scene, "--no-pictures", "--set", "run.fbs=3"}).code, 3);
}

TEST(Program, RendersFramesWithTheirRecordAndKeepsWhatExists) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    const std::string pattern = (folder / "out/f_###.png").string();
    const Outcome outcome = run({"render", scene, "-o", pattern, "--frames", "2-4", "--metrics"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* name : {"f_002.png", "f_004.png", "run_2-4.json", "metrics_2-4.csv"})
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/f_001.png"));
    const auto json = nlohmann::json::parse(test::contentOf(folder / "out/run_2-4.json"));
    EXPECT_EQ(json["state_hash"].size(), 5U);
    EXPECT_EQ(json["bits"], world::resultBits);
    EXPECT_EQ(json["gl"]["backend"], pipeline::nameOf(render::backends().front()));
    EXPECT_EQ(run({"sheet", (folder / "out").string()}).code, 0) << "the record tells the names of the frames";
    EXPECT_TRUE(std::filesystem::exists(folder / "out/sheet.png"));
    EXPECT_EQ(run({"render", scene, "-o", pattern, "--frames", "2-4", "-n"}).code, 6);
    EXPECT_EQ(run({"render", scene, "-o", pattern, "--frames", "2-4", "-y", "--quiet"}).code, 0);
}

TEST(Program, RendersAVideoWithItsRecord) {
    const TemporaryFolder folder;
    const Outcome outcome = run({"render", springScene(folder).string(), "-o", (folder / "a.mp4").string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_GT(std::filesystem::file_size(folder / "a.mp4"), 1000U);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.run.json"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mp4.part"));
}

TEST(Program, DivergenceIsExitCodeFourAndKeepsFramesAndDiagnosis) {
    const TemporaryFolder folder;
    const Outcome outcome = run(
        {"render", springScene(folder).string(), "-o", (folder / "out").string(), "--seconds", "20", "--set",
         "net.spring.springs=[{a='nail',b='bob',stiffness_N_per_m=1e6,rest_length_m=0.9}]", "--set", "solver.dt=0.02"});
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "out/frame_000000.png"));
    const auto json = nlohmann::json::parse(test::contentOf(folder / "out/run.json"));
    EXPECT_EQ(json["ended"], "diverged");
    EXPECT_EQ(json["divergence"]["body"], "net.spring");
}

TEST(Program, ADivergenceThatIsFrozenIsAWarningAndInTheRecord) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run({"render", springScene(folder).string(), "-o", (folder / "out").string(), "--seconds", "20", "--set",
             "net.spring.springs=[{a='nail',b='bob',stiffness_N_per_m=1e6,rest_length_m=0.9}]", "--set",
             "solver.dt=0.02", "--set", "solver.on_divergence=\"freeze\"", "--frames", "399"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "warning: net.spring diverged at t = ")) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "out/frame_000399.png"));
    const auto json = nlohmann::json::parse(test::contentOf(folder / "out/run_399-399.json"));
    EXPECT_EQ(json["ended"], "complete");
    ASSERT_EQ(json["frozen"].size(), 1U);
    EXPECT_EQ(json["frozen"][0]["name"], "net.spring");
    EXPECT_GT(json["frozen"][0]["divergence"]["time_s"], json["frozen"][0]["kept_time_s"]);
}

TEST(Program, AFontThatIsMissingIsSaidOnlyWhereTextIsDrawn) {
    const TemporaryFolder folder;
    const std::string scene = springScene(folder).string();
    const std::string start = "TAUT_FONT=/nowhere.ttf " TAUT_PROGRAM " render " + scene + " --frames 0 -o " +
                              (folder / "out").string() + " -y --quiet ";
    const std::string said = (folder / "said").string();
    EXPECT_EQ(WEXITSTATUS(std::system((start + "2>" + said).c_str())), 0) << test::contentOf(said);
    test::writeText(scene, test::contentOf(scene) + "[label.a]\ntext = \"x\"\nscreen = [0.5, 0.5]\nsize = 0.3\n");
    EXPECT_EQ(WEXITSTATUS(std::system((start + "2>" + said).c_str())), 6) << test::contentOf(said);
    EXPECT_TRUE(has(test::contentOf(said), "fonts-dejavu-core")) << test::contentOf(said);
}

TEST(Program, SchemaIsJson) {
    const auto json = nlohmann::json::parse(run({"schema"}).out);
    EXPECT_TRUE(json.contains("$schema"));
    EXPECT_TRUE(has(run({"schema", "--manual"}).out, "cloth"));
}

}  // namespace
}  // namespace taut::game
