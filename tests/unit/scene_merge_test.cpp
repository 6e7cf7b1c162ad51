// A scenario that builds on a scene: the merged keys, and which file a message names.
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

using glm::dvec3;

constexpr const char* mergedYard =
    "schema = 1\n"
    "title = \"a yard\"\n"
    "[run]\nfps = 30\nseconds = 2\n"
    "[rope.line]\nends = [[0, 1, 0], [1, 1, 0]]\nsegments = 8\nhold = [\"ends\"]\n"
    "finish = { weave = 0.5, roughness = 0.25 }\n"
    "[camera.main]\neye = [0, 1, 5]\n";

TEST(SceneMerge, TablesAreMergedDeeplyAndAllElseIsReplaced) {
    const AssetFolder folder;
    folder.write("yard.toml", mergedYard);
    const Loaded loaded = folder.load(
        "schema = 1\nscene = \"yard.toml\"\nrun = { seconds = 3 }\n"
        "[rope.line]\nhold = [\"start\"]\nfinish = { weave = 0.75 }\n"
        "[rope.other]\nends = [[0, 2, 0], [1, 2, 0]]\n");
    const world::SceneSpec& scene = loaded.spec;
    EXPECT_EQ(scene.title, "a yard");
    EXPECT_EQ(scene.run.fps, 30.0);
    EXPECT_EQ(scene.run.seconds, 3.0);
    ASSERT_EQ(scene.bodies.of<world::RopeSpec>().size(), 2U);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].segments, 8);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].hold, std::vector<std::string>{"start"});
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].finish.weave, 0.75);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].finish.roughness, 0.25);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[1].start, dvec3(0, 2, 0));
    EXPECT_EQ(scene.cameras[0].eye, dvec3(0, 1, 5));
    EXPECT_EQ(scene.file, (folder / "s.toml").string());
    EXPECT_EQ(scene.bases, std::vector<std::string>{(folder / "yard.toml").string()});
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].source.file, scene.bases.at(0));
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].source.line, 6);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[1].source.file, scene.file);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[1].source.line, 7);
}

TEST(SceneMerge, OverridesComeOnTop) {
    const AssetFolder folder;
    folder.write("yard.toml", mergedYard);
    LoadOptions options;
    options.overrides = {"rope.line.segments=16", "run.seconds=4"};
    const world::SceneSpec scene =
        folder.load("schema = 1\nscene = \"yard\"\n[rope.line]\nsegments = 12\n", options).spec;
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].segments, 16);
    EXPECT_EQ(scene.run.seconds, 4.0);
}

TEST(SceneMerge, AShippedSceneIsTakenThoughOneOfItsNameLiesBeside) {
    const AssetFolder folder, assets;
    std::filesystem::create_directory(assets / "scenes");
    assets.write("scenes/yard.toml", mergedYard);
    folder.write("yard.toml", "schema = 1\nrun = { fps = 10 }\n");
    LoadOptions options;
    options.assetFolders = {assets / ""};
    EXPECT_EQ(folder.load("schema = 1\nscene = \"yard\"\n", options).spec.run.fps, 10.0);
    EXPECT_EQ(folder.load("schema = 1\nscene = \"shipped:yard\"\n", options).spec.run.fps, 30.0);
}

TEST(SceneMerge, AShippedSceneIsFoundAlsoByAFileOfItsName) {
    const AssetFolder folder, assets;
    std::filesystem::create_directory(assets / "scenes");
    assets.write("scenes/s.toml", mergedYard);
    LoadOptions options;
    options.assetFolders = {assets / ""};
    for (const char* name : {"s", "s.toml"}) {
        folder.write("s.toml", "schema = 1\nscene = \"" + std::string(name) + "\"\n");
        const world::SceneSpec scene = loadScene(folder / "s.toml", options).spec;
        EXPECT_EQ(scene.bodies.of<world::RopeSpec>().at(0).segments, 8) << name;
        EXPECT_EQ(scene.bases.at(0), (assets / "" / "scenes/s.toml").string()) << name;
    }
}

TEST(SceneMerge, FilesOfTheSceneAreFoundBesideIt) {
    const AssetFolder folder;
    std::filesystem::create_directory(folder / "below");
    folder.write("below/sail.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    folder.write("below/sail.toml", "schema = 1\n[material.m]\n[cloth.c]\nmaterial = \"m\"\nmesh = \"sail.obj\"\n");
    const world::SceneSpec scene = folder.load("schema = 1\nscene = \"below/sail.toml\"\n").spec;
    ASSERT_NE(scene.bodies.of<world::ClothSpec>().at(0).meshData, nullptr);
    EXPECT_EQ(scene.bodies.of<world::ClothSpec>()[0].meshData->positions.size(), 3U);
}

// The message that a scene over another leads to.
std::string messageOver(const std::string& base, const std::string& text, const LoadOptions& options = {}) {
    const AssetFolder folder;
    folder.write("yard.toml", base);
    return folder.messageOf("schema = 1\nscene = \"yard.toml\"\n" + text, options);
}

TEST(SceneMerge, AMessageNamesTheFileThatIsWrong) {
    // One mistake in each file and one on the command line.
    LoadOptions options;
    options.overrides = {"run.fps=fast"};
    EXPECT_EQ(messageOver("schema = 1\n[rope.line]\nends = [[0, 1, 0], [1, 1, 0]]\nsegmets = 8\n",
                          "[run]\nseconds = -1\n", options),
              "s.toml:4:11: error: seconds must be between 0.001 and 1e+06 s, not -1\n"
              "  seconds = -1\n"
              "            ^\n"
              "yard.toml:4:1: error: [rope.line] has no key \"segmets\"\n"
              "  segmets = 8\n"
              "  ^ did you mean \"segments\"?\n"
              "--set run.fps: error: fps must be a number [1/s], not \"fast\"");
}

TEST(SceneMerge, ASceneThatIsNotTomlIsReportedWhereItIsNot) {
    EXPECT_EQ(messageOver("schema = 1\n[run\n", ""),
              "yard.toml:2:5: error: table header: expected ']', saw '\\n'\n"
              "  [run\n"
              "      ^");
}

TEST(SceneMerge, ASceneBuildsOnOneThatBuildsOnAnother) {
    const AssetFolder folder;
    std::filesystem::create_directory(folder / "below");
    folder.write("below/ground.toml", mergedYard);
    folder.write("below/sail.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    folder.write("below/yard.toml",
                 "schema = 1\nscene = \"ground\"\nrun = { fps = 20, seconds = 8 }\n"
                 "[material.m]\n[cloth.c]\nmaterial = \"m\"\nmesh = \"sail.obj\"\n");
    const world::SceneSpec scene = folder.load("schema = 1\nscene = \"below/yard\"\nrun.seconds = 3\n").spec;
    EXPECT_EQ(scene.run.seconds, 3.0);
    EXPECT_EQ(scene.run.fps, 20.0);
    EXPECT_EQ(scene.title, "a yard");
    EXPECT_NE(scene.bodies.of<world::ClothSpec>().at(0).meshData, nullptr);
    EXPECT_EQ(scene.bases, (std::vector<std::string>{(folder / "below/yard.toml").string(),
                                                     (folder / "below/ground.toml").string()}));
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].source.file, scene.bases[1]);
}

TEST(SceneMerge, AMessageNamesTheFileOfAChainThatIsWrong) {
    const AssetFolder folder;
    folder.write("ground.toml", "schema = 1\n[run]\nfps = \"fast\"\n");
    folder.write("yard.toml",
                 "schema = 1\nscene = \"ground\"\n[rope.line]\nsegmets = 8\n"
                 "ends = [[0, 1, 0], [1, 1, 0]]\n");
    EXPECT_EQ(folder.messageOf("schema = 1\nscene = \"yard\"\n[run]\nseconds = -1\n"),
              "s.toml:4:11: error: seconds must be between 0.001 and 1e+06 s, not -1\n"
              "  seconds = -1\n"
              "            ^\n"
              "yard.toml:4:1: error: [rope.line] has no key \"segmets\"\n"
              "  segmets = 8\n"
              "  ^ did you mean \"segments\"?\n"
              "ground.toml:3:7: error: fps must be a number [1/s], not \"fast\"\n"
              "  fps = \"fast\"\n"
              "        ^");
}

TEST(SceneMerge, AChainThatComesBackToItselfIsNamed) {
    const AssetFolder folder;
    const std::string text = "schema = 1\nscene = \"a\"\n";
    folder.write("s.toml", text);
    folder.write("a.toml", "schema = 1\nscene = \"b\"\n");
    folder.write("b.toml", "schema = 1\nscene = \"a\"\n");
    EXPECT_EQ(folder.messageOf(text),
              "b.toml:2:9: error: these scenes build on each other: s.toml -> a.toml -> b.toml -> a.toml\n"
              "  scene = \"a\"\n"
              "          ^");
}

TEST(SceneMerge, AChainHasEightFilesBelowTheFirst) {
    const AssetFolder folder;
    folder.write("a8.toml", mergedYard);
    for (int i = 0; i < 8; ++i)
        folder.write("a" + std::to_string(i) + ".toml", "schema = 1\nscene = \"a" + std::to_string(i + 1) + "\"\n");
    EXPECT_EQ(folder.load("schema = 1\nscene = \"a1\"\n").spec.bases.size(), 8U);
    EXPECT_TRUE(folder.messageOf("schema = 1\nscene = \"a0\"\n")
                    .starts_with("a7.toml:2:9: error: a scene builds on 8 others at most, one upon another: "
                                 "s.toml -> a0.toml -> "));
}

TEST(SceneMerge, AShippedScenarioIsNamedByItsFolder) {
    const AssetFolder folder, assets;
    std::filesystem::create_directories(assets / "scenarios");
    assets.write("scenarios/yard.toml", mergedYard);
    LoadOptions options;
    options.assetFolders = {assets / ""};
    EXPECT_EQ(folder.load("schema = 1\nscene = \"shipped:scenarios/yard\"\n", options).spec.run.fps, 30.0);
}

TEST(SceneMerge, ANameThatFindsNoOtherSceneIsReported) {
    const AssetFolder folder;
    folder.write("yard.toml", mergedYard);
    const auto messageOf = [&](const std::string& name) {
        folder.write("s.toml", "schema = 1\nscene = " + name + "\n");
        try {
            loadScene(folder / "s.toml", {});
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
            return folder.withoutFolder(error.what());
        }
        return std::string();
    };
    const std::string start = "s.toml:2:9: error: ";
    EXPECT_EQ(messageOf("\"yart\""),
              start + "there is no scene \"yart\"\n  scene = \"yart\"\n          ^ did you mean \"yard\"?");
    EXPECT_EQ(messageOf("\"wood.toml\""),
              start + "there is no scene \"wood.toml\"\n  scene = \"wood.toml\"\n          ^ looked for wood.toml");
    EXPECT_EQ(messageOf("\"s\""), start + "this scene names itself\n  scene = \"s\"\n          ^");
    EXPECT_EQ(messageOf("\"\""), start + "scene must be the name of a scene or of a file\n  scene = \"\"\n          ^");
    EXPECT_EQ(messageOf("7"), start + "scene must be a text, not 7\n  scene = 7\n          ^");
}

TEST(SceneMerge, TheSceneCannotBeSet) {
    LoadOptions options;
    options.overrides = {"scene=yard"};
    EXPECT_EQ(messageOver(mergedYard, "", options),
              "--set scene: error: the scene that a file builds on cannot be set");
}

// A scenario can be looked at for a second: times past an end set by hand are left out, not wrong.
TEST(Merge, AnOverriddenLengthMakesNothingLate) {
    const std::string text = R"(schema = 1
run = { seconds = 4.0 }
at = [ { t = 3.0, do = "push", target = "rope.line@end", impulse_Ns = [0, 0, 1] } ]
[rope.line]
ends = [[0, 1, 0], [1, 1, 0]]
[[check]]
that = "speed(rope.line) < 100"
at = 3.5
[[golden]]
frames = [200]
)";
    LoadOptions options;
    options.overrides = {"run.seconds=1"};
    EXPECT_EQ(loadSceneText(text, "s.toml", options).spec.actions.size(), 1U);
    std::string shorter = text;
    shorter.replace(shorter.find("4.0"), 3, "1.0");
    EXPECT_THROW(loadSceneText(shorter, "s.toml", {}), core::Error);
}

}  // namespace
}  // namespace taut::scene
