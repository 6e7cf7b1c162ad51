// Materials from the library of fabrics: "fabric:denim".
#include <filesystem>
#include <fstream>
#include <sstream>

#include "taut/bodies/cloth.h"
#include "taut/scene/fabrics.h"
#include "taut/scene/private/used_files.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

constexpr const char* serge =
    "title = \"Serge\"\n[material.serge]\ndensity_kg_per_m2 = 0.3\n"
    "[material.serge.cloth]\nfriction = 1.5\nfinish = { weave = 0.5 }\n";

// A folder with a fabric "serge".
class Library : public AssetFolder {
  public:
    Library() {
        std::filesystem::create_directory(*this / "fabrics");
        write("fabrics/serge.toml", serge);
    }
    Loaded withFabrics(const std::string& text) const { return load("schema = 1\n" + text, options()); }
    LoadOptions options() const {
        LoadOptions options;
        options.assetFolders = {*this / ""};
        return options;
    }
};

TEST(SceneFabrics, ABodyTakesOneAndAMaterialIsLikeOne) {
    const Library folder;
    const Loaded scene = folder.withFabrics(
        "[material.heavy]\nlike = \"fabric:serge\"\ndensity_kg_per_m2 = 0.5\n"
        "[cloth.a]\nmaterial = \"fabric:serge\"\n[cloth.b]\nmaterial = \"heavy\"\nfriction = 0.7\n");
    EXPECT_EQ(scene.spec.materials.at("fabric:serge").density, 0.3);
    EXPECT_EQ(scene.spec.materials.at("heavy").density, 0.5);
    const auto& cloths = scene.spec.bodies.of<world::ClothSpec>();
    EXPECT_EQ(cloths.at(0).friction, 1.5);
    EXPECT_EQ(cloths.at(1).friction, 0.7);
    EXPECT_EQ(cloths.at(1).finish.weave, 0.5);
    const std::vector<UsedFile> files = usedFiles(scene.spec);
    EXPECT_EQ(std::filesystem::path(files.at(1).path).filename(), "serge.toml");
}

TEST(SceneFabrics, AMaterialOfTheSceneIsNotTheLibrarys) {
    const Loaded scene = Library().withFabrics(
        "[material.serge]\ndensity_kg_per_m2 = 9\n[cloth.a]\nmaterial = \"serge\"\n"
        "[cloth.b]\nmaterial = \"fabric:serge\"\n");
    EXPECT_EQ(scene.spec.materials.at("serge").density, 9.0);
    EXPECT_EQ(scene.spec.materials.at("fabric:serge").density, 0.3);
}

// The back of a fabric goes with its own front: with another colour it is paler than that.
TEST(SceneFabrics, AColourOfOnesOwnTakesTheBackOut) {
    const Library folder;
    folder.write("fabrics/lined.toml",
                 "[material.lined]\n[material.lined.cloth]\nfinish = { colour = \"#000000\", back_colour = "
                 "\"#ffffff\" }\n");
    const auto back = [&](const std::string& finish) {
        const Loaded scene = folder.withFabrics("[cloth.a]\nmaterial = \"fabric:lined\"\n" + finish);
        return scene.spec.bodies.of<world::ClothSpec>().at(0).finish.backColour;
    };
    EXPECT_TRUE(back("").has_value());
    EXPECT_TRUE(back("finish = { weave = 0.5 }\n").has_value());
    EXPECT_FALSE(back("finish = { colour = \"#a02050\" }\n").has_value());
    EXPECT_TRUE(back("finish = { colour = \"#a02050\", back_colour = \"#a02050\" }\n").has_value());
}

TEST(SceneFabrics, ARampChangesOne) {
    const Loaded scene = Library().withFabrics(
        "[cloth.a]\nmaterial = \"fabric:serge\"\n"
        "[[at]]\nt = 0\ndo = \"ramp\"\nkey = \"material.fabric:serge.stretch_N_per_m\"\nto = 9\nover_s = 1\n");
    EXPECT_EQ(scene.spec.actions.size(), 1U);
}

TEST(SceneFabrics, FaultsNameTheFabricOrItsFile) {
    const Library folder;
    folder.write("fabrics/torn.toml", "[material.other]\n");
    folder.write("fabrics/odd.toml", "[material.odd]\ndensity_kg_per_m2 = -1\n");
    const auto message = [&](const std::string& name) {
        return folder.messageOf("schema = 1\n[cloth.a]\nmaterial = \"fabric:" + name + "\"\n", folder.options());
    };
    const std::string typo = message("surge");
    EXPECT_NE(typo.find("s.toml:3:12: error: there is no fabric \"surge\""), std::string::npos) << typo;
    EXPECT_NE(typo.find("did you mean \"serge\"?"), std::string::npos) << typo;
    EXPECT_NE(message("torn").find("torn.toml has no [material.torn]"), std::string::npos) << message("torn");
    EXPECT_NE(message("odd").find("odd.toml:2:21: error: "), std::string::npos) << message("odd");
}

// Every number of the shipped library says where it is from, and each fabric is one that a world can be made of.
TEST(SceneFabrics, TheShippedOnesSayTheirSources) {
    const std::vector<std::filesystem::path> files = fabricFiles({TAUT_SOURCE_DIR "/assets"});
    ASSERT_EQ(files.size(), 24U);
    LoadOptions options;
    options.assetFolders = {TAUT_SOURCE_DIR "/assets"};
    for (const std::filesystem::path& file : files) {
        std::ifstream in(file);
        for (std::string line; std::getline(in, line);) {
            if (line.find(" = ") == std::string::npos || line.starts_with("#") || line.starts_with("schema") ||
                line.starts_with("title"))
                continue;
            const bool hasSource = line.find("# measured: ") != std::string::npos ||
                                   line.find("# derived: ") != std::string::npos ||
                                   line.find("# chosen") != std::string::npos;
            EXPECT_TRUE(hasSource) << file << ": " << line;
        }
        const std::string name = "fabric:" + file.stem().string();
        const Loaded scene = loadSceneText("schema = 1\n[cloth.a]\nmaterial = \"" + name + "\"\n", "/s.toml", options);
        EXPECT_TRUE(scene.spec.materials.at(name).rigidity.warp.has_value()) << name;
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front().text;
        EXPECT_FALSE(scene.spec.bodies.of<world::ClothSpec>()[0].build(scene.spec).springs.empty());
    }
}

}  // namespace
}  // namespace taut::scene
