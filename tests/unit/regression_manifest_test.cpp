#include "taut/regression/manifest.h"

#include <gtest/gtest.h>

#include "regression_support.h"

namespace taut::regression {
namespace {

using test::has;
using test::TemporaryFolder;

TEST(Manifest, IsEmptyWhereThereIsNone) {
    const TemporaryFolder folder;
    EXPECT_TRUE(readManifest({folder.path()}).scenarios.empty());
}

TEST(Manifest, ComesBackAsItWas) {
    const TemporaryFolder folder;
    Manifest manifest;
    manifest.tolerance = {3, 0.0002, 2, 0.5, 0.125};
    manifest.otherRenderer = {9, 0.002, 8, 0.75};
    manifest.scenarios["flag"].bits = 77;
    manifest.scenarios["flag"].state = {"Because.", "0123456789abcdef", 479, "taut 1", "g++", "avx2"};
    manifest.scenarios["flag"].pictures["000120"] = {"For \"beauty\", é", "00000000000000ff", "llvmpipe"};
    writeManifest(folder / "new/golden/manifest.json", manifest);
    const Manifest back = readManifest({folder / "new/golden"});
    ASSERT_EQ(back.scenarios.size(), 1U);
    const GoldenScenario& flag = back.scenarios.at("flag");
    EXPECT_EQ(flag.bits, 77);
    EXPECT_EQ(flag.state->why, "Because.");
    EXPECT_EQ(flag.state->ticks, 479);
    EXPECT_EQ(flag.state->lastHash, "0123456789abcdef");
    EXPECT_EQ(flag.pictures.at("000120").why, "For \"beauty\", é");
    EXPECT_EQ(flag.pictures.at("000120").stateHash, "00000000000000ff");
    EXPECT_EQ(back.tolerance, manifest.tolerance);
    EXPECT_EQ(back.otherRenderer, manifest.otherRenderer);
    writeManifest(folder / "again/manifest.json", back);
    EXPECT_EQ(test::contentOf(folder / "again/manifest.json"), test::contentOf(folder / "new/golden/manifest.json"));
}

TEST(Manifest, WithoutANumberItsScenariosAreOfBitsOne) {
    EXPECT_EQ(readManifestText(R"({"schema": 1, "scenarios": {"a": {}}})", "m.json").scenarios.at("a").bits, 1);
}

TEST(Manifest, KnowsARendererByItsNameWhateverItsVersion) {
    const std::string golden = "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6, osmesa";
    EXPECT_TRUE(isSameRenderer(golden, "llvmpipe (LLVM 19.1.7, 128 bits), 4.5 (Core Profile) Mesa 25.0.7, egl"));
    EXPECT_FALSE(isSameRenderer(golden, "softpipe, 3.3 (Core Profile) Mesa 22.3.6, osmesa"));
    EXPECT_FALSE(isSameRenderer("NVIDIA GeForce RTX 3060/PCIe/SSE2, 4.6.0 NVIDIA 550.1, egl",
                                "NVIDIA GeForce RTX 4060/PCIe/SSE2, 4.6.0 NVIDIA 550.1, egl"));
}

struct BadManifest {
    const char* text;
    const char* said;
};

TEST(Manifest, SaysWhatIsWrongInIt) {
    const std::vector<BadManifest> cases = {
        {"{\n\"schema\": 1,\n}", "manifest.json:3: error: this is no JSON"},
        {"", "error: this is no JSON"},
        {R"({"schema": 1e999})", "manifest.json: error: it has a number beyond all bounds"},
        {"[]", "the content is no object"},
        {"{}", "schema is missing"},
        {R"({"schema": 2})", "schema is 2, and this taut reads 1"},
        {R"({"schema": "1"})", "schema is no whole number"},
        {R"({"schema": 1, "scenarios": 3})", "scenarios is no object"},
        {R"({"schema": 1, "scenarios": {"../x": {}}})", "scenarios has the name '../x'"},
        {R"({"schema": 1, "scenarios": {"a": {"bits": 0}}})",
         "scenarios.a.bits is no whole number from 1 to 999999999"},
        {R"({"schema": 1, "scenarios": {"a": {"bits": 1000000000}}})", "scenarios.a.bits is no whole number"},
        {R"({"schema": 1, "scenarios": {"a": {"bits": 18446744073709551615}}})", "scenarios.a.bits is no whole number"},
        {R"({"schema": 1, "scenarios": {"a": {"bits": 1.5}}})", "scenarios.a.bits is no whole number"},
        {R"({"schema": 1, "scenarios": {"a": {"state": {}}}})", "scenarios.a.state.why is missing"},
        {R"({"schema": 1, "scenarios": {"a": {"state": {"why": " "}}}})", "scenarios.a.state.why is empty"},
        {R"({"schema": 1, "scenarios": {"a": {"state": {"why": "x", "last_hash": "12"}}}})",
         "scenarios.a.state.last_hash is no hash"},
        {R"({"schema": 1, "scenarios": {"a": {"pictures": {"000001": {"why": 3}}}}})",
         "scenarios.a.pictures.000001.why is no text"},
        {R"({"schema": 1, "scenarios": {"a": {"pictures": {"x/y": {"why": "z"}}}}})", "pictures has the name 'x/y'"},
        {R"({"schema": 1, "tolerance": {"channel": 2, "share": -1, "tile_channel": 1, "tile_share": 0}})",
         "tolerance.share is no number of at least 0"},
        {R"({"schema": 1, "tolerance_of_another_renderer": {"channel": 2.5}})",
         "tolerance_of_another_renderer.channel is no whole number"},
    };
    const TemporaryFolder folder;
    for (const BadManifest& row : cases) {
        SCOPED_TRACE(row.text);
        test::writeText(folder / "manifest.json", row.text);
        const std::string said = test::messageOf(core::ErrorKind::badContent, [&] { readManifest({folder.path()}); });
        EXPECT_TRUE(has(said, row.said)) << said;
        EXPECT_TRUE(has(said, "manifest.json")) << said;
    }
}

TEST(Manifest, ThatCannotBeReadIsAnErrorOfTheDisk) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "manifest.json");
    test::messageOf(core::ErrorKind::inputOutput, [&] { readManifest({folder.path()}); });
}

}  // namespace
}  // namespace taut::regression
