// Scene files on disk, and the files that they name.
#include "taut/bodies/rope.h"
#include "taut/scene/private/used_files.h"
#include "taut/spec/ticks.h"
#include "taut/world/world.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

constexpr const char* minimal = "schema = 1\n[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\n";

// The message and the exit code of loading a path.
std::pair<std::string, core::ErrorKind> failureOf(const AssetFolder& folder, const std::string& name) {
    try {
        loadScene(folder / name, {});
    } catch (const core::Error& error) {
        return {folder.withoutFolder(error.what()), error.kind()};
    }
    ADD_FAILURE() << name << " was read";
    return {};
}

TEST(SceneFiles, AMissingFileAFolderAndALoopOfLinksAreInputOutputErrors) {
    const AssetFolder folder;
    using core::ErrorKind;
    EXPECT_EQ(failureOf(folder, "no.toml"),
              std::pair(std::string("no.toml: error: there is no such file"), ErrorKind::inputOutput));
    EXPECT_EQ(failureOf(folder, "models"),
              std::pair(std::string("models: error: this is a folder, not a file"), ErrorKind::inputOutput));
    std::filesystem::create_symlink(folder / "loop.toml", folder / "loop.toml");
    EXPECT_EQ(failureOf(folder, "loop.toml").second, ErrorKind::inputOutput);
    EXPECT_EQ(failureOf(folder, "s.toml/x").second, ErrorKind::inputOutput);
}

TEST(SceneFiles, AFileThatCannotBeReadIsAnInputOutputError) {
    // Its first page is never mapped, so that reading fails for every user.
    try {
        loadScene("/proc/self/mem", {});
        ADD_FAILURE() << "was read";
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::inputOutput);
        EXPECT_STREQ(error.what(), "/proc/self/mem: cannot read: Input/output error");
    }
}

TEST(SceneFiles, AFileAboveTheLimitIsRefused) {
    const AssetFolder folder;
    folder.write("large.toml", std::string(minimal) + "#" + std::string(16U << 20U, 'x'));
    EXPECT_EQ(failureOf(folder, "large.toml"),
              std::pair(std::string("large.toml: the file is larger than 16 MiB"), core::ErrorKind::badContent));
}

TEST(SceneFiles, ByteOrderMarksAndWindowsLineEndsAreRead) {
    const AssetFolder folder;
    std::string text = "\xEF\xBB\xBF";
    for (const char c : std::string(minimal)) text += c == '\n' ? "\r\n" : std::string(1, c);
    folder.write("windows.toml", text);
    EXPECT_EQ(loadScene(folder / "windows.toml", {}).spec.bodies.of<world::RopeSpec>().size(), 1U);
    folder.write("bad.toml", text + "x = 1\r\n");
    EXPECT_TRUE(failureOf(folder, "bad.toml")
                    .first.starts_with("bad.toml:4:1: error: [rope.r] has no key \"x\"\n  x = 1\n  ^ it has ends, "));
}

TEST(SceneFiles, FilesWithoutTextAreReported) {
    const AssetFolder folder;
    EXPECT_EQ(folder.messageOf(std::string("schema = 1\n\0\0", 13)),
              "s.toml:2:1: error: this is not a text file: it holds a zero byte\n  ??\n  ^");
    EXPECT_EQ(folder.messageOf("\xFF\xFEs\1c\1"), "s.toml:1:1: error: this is UTF-16; a scene is UTF-8\n  ??s?c?\n  ^");
    EXPECT_EQ(folder.messageOf("title = \"\xC3(\"\n").substr(0, 16), "s.toml:1:9: erro");
    EXPECT_EQ(folder.messageOf("\x89PNG\r\n\x1A\n").substr(0, 15), "s.toml:1:1: err");
}

TEST(SceneFiles, AnEmptyFileLacksItsSchema) {
    const AssetFolder folder;
    EXPECT_EQ(folder.messageOf(""), "s.toml:1:1: error: the scene needs schema\n  \n  ^ write schema = 1");
    EXPECT_EQ(folder.messageOf("schema = 2\n"),
              "s.toml:1:10: error: schema must be 1, not 2\n  schema = 2\n           ^");
}

TEST(SceneFiles, EndlessNestingEndsInAMessage) {
    const AssetFolder folder;
    const std::string lists = "a = " + std::string(100000, '[');
    EXPECT_NE(folder.messageOf(lists).find("exceeded maximum nested value depth"), std::string::npos);
    std::string tables = "a = ";
    std::string keys = "a";
    for (int i = 0; i < 100000; ++i) {
        tables += "{a=";
        keys += ".a";
    }
    EXPECT_NE(folder.messageOf(tables).find("exceeded maximum nested value depth"), std::string::npos);
    EXPECT_NE(folder.messageOf(keys + " = 1").find("this key has too many parts"), std::string::npos);
    EXPECT_NE(folder.messageOf("[" + keys + "]").find("this key has too many parts"), std::string::npos);
}

TEST(SceneFiles, ALongLineIsShownAroundItsFault) {
    const AssetFolder folder;
    const std::string message =
        folder.messageOf("schema = 1\ntitle = \"" + std::string(5000, 'x') + "\"; # and more\n");
    EXPECT_LT(message.size(), 400U);
    EXPECT_TRUE(message.starts_with("s.toml:2:5011: error: ")) << message;
}

TEST(SceneFiles, AllFaultsAreReportedInTheOrderOfTheFile) {
    const AssetFolder folder;
    EXPECT_EQ(folder.messageOf("schema = 1\n"
                               "[wind.w]\n"
                               "on = [\"cloth.none\"]\n"
                               "[run]\n"
                               "fps = 0\n"
                               "[cloth.c]\n"
                               "material = \"none\"\n"
                               "cells = [1, -1]\n"),
              "s.toml:3:7: error: there is no cloth.none\n"
              "  on = [\"cloth.none\"]\n"
              "        ^\n"
              "s.toml:5:7: error: fps must be between 0.1 and 1000 1/s, not 0\n"
              "  fps = 0\n"
              "        ^\n"
              "s.toml:7:12: error: there is no material \"none\"\n"
              "  material = \"none\"\n"
              "             ^ add a table [material.none], or take a fabric: taut materials lists them\n"
              "s.toml:8:13: error: cells[1] must be between 1 and 1e+09, not -1\n"
              "  cells = [1, -1]\n"
              "              ^");
}

TEST(SceneFiles, AssetsAreLookedForBesideTheSceneFirst) {
    const AssetFolder scenes, assets;
    assets.write("models/shirt.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
    assets.write("square.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n");
    LoadOptions options;
    options.assetFolders = {(assets / "x").parent_path()};
    const std::string head = "schema = 1\n[collider.c]\nshape = \"mesh\"\nmesh = ";
    EXPECT_EQ(scenes.load(head + "\"shirt.obj\"\n", options).spec.colliders[0].mesh,
              (assets / "models/shirt.obj").string());
    EXPECT_EQ(scenes.load(head + "\"square.obj\"\n", options).spec.colliders[0].mesh, (scenes / "square.obj").string());
    const std::string absolute = (assets / "square.obj").string();
    EXPECT_EQ(scenes.load(head + "\"" + absolute + "\"\n").spec.colliders[0].mesh, absolute);
    EXPECT_EQ(assets.withoutFolder(scenes.messageOf(head + "\"none.obj\"\n", options)),
              "s.toml:4:8: error: there is no file \"none.obj\"\n"
              "  mesh = \"none.obj\"\n"
              "         ^ looked for none.obj, none.obj, models/none.obj, textures/none.obj");
}

TEST(SceneFiles, KeysOfPicturesChangeWithWhatIsInThem) {
    const AssetFolder folder;
    const std::string text =
        "schema = 1\nenvironment = { image = \"square.png\" }\n[rope.r]\n"
        "ends = [[0, 0, 0], [1, 0, 0]]\nfinish = { pattern = \"image\", texture = \"square.png\" }\n";
    const world::SceneSpec scene = folder.load(text).spec;
    const std::vector<UsedFile> before = pictureFiles(scene);
    ASSERT_EQ(before.size(), 1U);
    folder.write("square.png", "another");
    EXPECT_NE(pictureFiles(scene)[0].content, before[0].content);
}

// At 1 s, or 60 ticks of 60 frames and 120 of 30.
TEST(SceneFiles, AKeptStateIsReadWhereARunStarts) {
    const AssetFolder folder;
    LoadOptions options;
    options.stateIn = [&](const std::filesystem::path& file) {
        EXPECT_EQ(file, folder / "kept.state");
        return world::StartState{61, {std::byte{7}}};
    };
    const std::string text = "schema = 1\n[run]\nstart = \"kept.state\"\n";
    const Loaded loaded = folder.load(text, options);
    const world::RunSpec& run = loaded.spec.run;
    EXPECT_EQ(run.start, (folder / "kept.state").string());
    EXPECT_EQ(world::Ticks(run).firstFrame, 61);
    std::vector<std::string> files;
    for (const UsedFile& file : usedFiles(loaded.spec)) files.push_back(file.path);
    EXPECT_EQ(files, (std::vector<std::string>{(folder / "s.toml").string(), run.start}));
    // Its content is part of all states of the scene, its name is not.
    folder.write("other.state", "");
    const std::string other = "schema = 1\n[run]\nstart = \"other.state\"\n";
    options.stateIn = [](const auto&) { return world::StartState{61, {std::byte{7}}}; };
    EXPECT_EQ(folder.load(other, options).keys.stateAt(61), loaded.keys.stateAt(61));
    options.stateIn = [](const auto&) { return world::StartState{61, {std::byte{8}}}; };
    EXPECT_NE(folder.load(text, options).keys.stateAt(61), loaded.keys.stateAt(61));

    EXPECT_EQ(folder.messageOf(text + "fps = 30\n", options),
              "s.toml:3:9: error: this state was kept at 1.01667 s, between two frames\n"
              "  start = \"kept.state\"\n"
              "          ^ keep it at a frame");
    EXPECT_EQ(folder.messageOf(text + "seconds = 1\n", options),
              "s.toml:3:9: error: this state was kept at 1.01667 s, when the run is over: seconds is 1\n"
              "  start = \"kept.state\"\n"
              "          ^ the run continues from the time of the state: make seconds larger");
    EXPECT_EQ(folder.messageOf(text + "[[golden]]\nframes = [3]\n", options),
              "s.toml:5:11: error: frame 3 is before the start: the first is 61, from kept.state\n"
              "  frames = [3]\n"
              "            ^");
    options.stateIn = [](const auto&) -> world::StartState {
        throw core::Error(core::ErrorKind::badContent, "these bytes are no state");
    };
    EXPECT_EQ(folder.messageOf(text, options),
              "s.toml:3:9: error: cannot start from kept.state: these bytes are no state\n"
              "  start = \"kept.state\"\n"
              "          ^");
}

TEST(SceneFiles, SuspiciousButLegalContentWarns) {
    const AssetFolder folder;
    const Loaded loaded = folder.load(
        "schema = 1\n"
        "[run]\n"
        "seconds = 0.525\n"
        "[material.m]\n"
        "[collider.c]\n"
        "shape = \"sphere\"\n"
        "keys = [{ t = 0.5 }, { t = 1.00001 }, { t = 1.008 }]\n");
    ASSERT_EQ(loaded.warnings.size(), 3U);
    EXPECT_EQ(folder.withoutFolder(printed(loaded.warnings[1])),
              "s.toml:3:11: warning: 0.525 s is midway between frames of 1/60 s: 0.533333333 s is taken\n"
              "  seconds = 0.525\n"
              "            ^");
    EXPECT_TRUE(
        folder.withoutFolder(printed(loaded.warnings[0])).starts_with("s.toml:1:1: warning: there is nothing to move"));
    EXPECT_TRUE(
        folder.withoutFolder(printed(loaded.warnings[2])).starts_with("s.toml:4:11: warning: no cloth is made of m"));
}

TEST(SceneFiles, BodiesAreSortedByNameAndTiesKeepTheirOrder) {
    const AssetFolder folder;
    const world::SceneSpec scene = folder
                                       .load(
                                           "schema = 1\n"
                                           "[rope.b]\nends = [[0, 0, 0], [1, 0, 0]]\n"
                                           "[rope.a]\nends = [[0, 0, 0], [1, 0, 0]]\n"
                                           "[[mass]]\ntarget = \"rope.b@end\"\nmass_kg = 1\n"
                                           "[[mass]]\ntarget = \"rope.a@end\"\nmass_kg = 1\n")
                                       .spec;
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].name, "a");
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[1].name, "b");
    EXPECT_EQ(scene.masses[0].target, "rope.b@end");
    EXPECT_EQ(scene.masses[1].target, "rope.a@end");
}

// Also by a link that lies where it may: the place of the file counts.
TEST(SceneFiles, AConfinedSceneReadsNothingElsewhere) {
    const AssetFolder folder, elsewhere;
    elsewhere.write("secret.toml", "the secret of somebody else\n");
    elsewhere.write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("own.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::filesystem::create_symlink(elsewhere / "box.obj", folder / "link.obj");
    const auto hull = [](const std::string& file) {
        return std::string(minimal) + "[collider.a]\nshape = \"mesh\"\nmesh = \"" + file + "\"\n";
    };
    LoadOptions options;
    folder.load(hull("link.obj"), options);
    options.isConfined = true;
    folder.load(hull("own.obj"), options);
    elsewhere.write("whole.toml", minimal);
    std::filesystem::create_symlink(elsewhere / "whole.toml", folder / "whole.toml");
    EXPECT_THROW(loadScene(folder / "whole.toml", options), core::Error);
    for (const std::string& text : {hull("link.obj"), hull((elsewhere / "box.obj").string()),
                                    "schema = 1\nscene = \"" + (elsewhere / "secret.toml").string() + "\"\n"}) {
        const std::string message = folder.messageOf(text, options);
        EXPECT_NE(message.find("lies outside the scene's folder"), std::string::npos) << message;
        EXPECT_EQ(message.find("somebody"), std::string::npos) << message;
    }
}

TEST(SceneFiles, AllThatASceneMakesCountsAgainstTheLimit) {
    const AssetFolder folder;
    LoadOptions options;
    options.memoryLimit = 150e6;
    std::string colliders;
    for (int i = 0; i < 2000; ++i) colliders += "[collider.c" + std::to_string(i) + "]\nshape = \"sphere\"\n";
    const std::string many = folder.messageOf(std::string(minimal) + colliders, options);
    EXPECT_NE(many.find("0.18 GB for colliders"), std::string::npos) << many;
    EXPECT_NE(many.find("visible = false"), std::string::npos) << many;
    const std::string large =
        folder.messageOf(std::string(minimal) + "[picture]\nsize = [4000, 4000]\nsamples = 1\n", options);
    EXPECT_NE(large.find("GB for pictures of 4000 x 4000 pixels"), std::string::npos) << large;
    EXPECT_NE(large.find("smaller size"), std::string::npos) << large;
}

TEST(SceneFiles, TheShippedScenesAndScenariosLoad) {
    const std::filesystem::path assets = std::filesystem::path(TAUT_SOURCE_DIR) / "assets";
    LoadOptions options;
    options.assetFolders = {assets};
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"scenes", "scenarios"})
        for (const auto& entry : std::filesystem::directory_iterator(assets / folder)) files.push_back(entry.path());
    for (const std::filesystem::path& file : files) {
        if (file.extension() != ".toml") continue;
        SCOPED_TRACE(file.string());
        Loaded loaded;
        ASSERT_NO_THROW(loaded = loadScene(file, options));
        EXPECT_EQ(printed(loaded.warnings), std::vector<std::string>());
        EXPECT_FALSE(loaded.spec.title.empty());
    }
}

// A part has its own finish, in pictures and exported geometry, which are made of the same surfaces.
TEST(SceneFiles, APartOfACompoundMayHaveAFinishOfItsOwn) {
    const AssetFolder folder;
    const world::SceneSpec scene =
        folder
            .load(
                "schema = 1\n[collider.post]\nshape = \"compound\"\nfinish = { roughness = 0.25 }\nparts = [\n"
                "{ shape = \"sphere\", radius = 1 },\n"
                "{ shape = \"sphere\", radius = 2, finish = { roughness = 0.5, texture = \"square.png\", "
                "pattern = \"image\" } } ]\n")
            .spec;
    const auto surfaces = world::World(scene).view(false).surfaces;
    ASSERT_EQ(surfaces.size(), 2U);
    EXPECT_EQ(surfaces[0].finish->roughness, 0.25F);
    EXPECT_EQ(surfaces[1].finish->roughness, 0.5F);
    EXPECT_EQ(scene.colliders[0].parts[1].ownFinish->texture, (folder / "square.png").string());
}

}  // namespace
}  // namespace taut::scene
