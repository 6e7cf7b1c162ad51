// Keys from [defaults.SECTION] and from `like`.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

Loaded loaded(const std::string& text, const std::vector<std::string>& overrides = {}) {
    LoadOptions options;
    options.overrides = overrides;
    return AssetFolder().load("schema = 1\n" + text, options);
}

const world::RopeSpec& rope(const Loaded& scene, std::size_t i) {
    return scene.spec.bodies.of<world::RopeSpec>().at(i);
}

constexpr const char* straightEnds = "ends = [[0, 1, 0], [1, 1, 0]]\n";

TEST(SceneInheritance, OwnKeysStandOverThoseOfTheLikeAndTheseOverDefaults) {
    const Loaded scene = loaded(
        "[rope.a]\nlike = \"rope.b\"\nsegments = 3\n"
        "[rope.b]\nlike = \"c\"\nsegments = 4\nradius = 0.04\n"
        "[rope.c]\nsegments = 5\nradius = 0.05\nmass_kg = 5\n" +
        std::string(straightEnds) + "[defaults.rope]\nsegments = 6\nradius = 0.06\nmass_kg = 6\nstretch_N = 6\n");
    EXPECT_EQ(rope(scene, 0).segments, 3);
    EXPECT_EQ(rope(scene, 0).radius, 0.04);
    EXPECT_EQ(rope(scene, 0).mass, 5.0);
    EXPECT_EQ(rope(scene, 0).stretch, 6.0);
    EXPECT_EQ(rope(scene, 0).end, glm::dvec3(1, 1, 0));
}

TEST(SceneInheritance, TablesAreLaidOverEachOtherKeyByKey) {
    const Loaded scene =
        loaded("[defaults.rope]\nfinish = { weave = 0.5, roughness = 0.25 }\n[rope.a]\nfinish = { weave = 0.75 }\n" +
               std::string(straightEnds));
    EXPECT_EQ(rope(scene, 0).finish.weave, 0.75);
    EXPECT_EQ(rope(scene, 0).finish.roughness, 0.25);
}

// A cloth's own keys, then those of the cloth that it is like, then its material's, then the defaults. A warning names
// keys that no cloth takes.
TEST(SceneInheritance, AMaterialHasKeysForItsCloth) {
    const Loaded scene = loaded(
        "[defaults.cloth]\nthickness = 0.01\nfriction = 0.1\njitter_m = 0.001\n"
        "[material.a.cloth]\nthickness = 0.02\nfriction = 0.2\nfinish = { weave = 0.5, roughness = 0.25 }\n"
        "[material.b]\nlike = \"a\"\n"
        "[cloth.x]\nmaterial = \"b\"\nfinish = { weave = 0.75 }\n[cloth.y]\nlike = \"x\"\nfriction = 0.3\n");
    const world::ClothSpec& x = scene.spec.bodies.of<world::ClothSpec>().at(0);
    const world::ClothSpec& y = scene.spec.bodies.of<world::ClothSpec>().at(1);
    EXPECT_EQ(x.thickness, 0.02);
    EXPECT_EQ(x.friction, 0.2);
    EXPECT_EQ(x.jitter, 0.001);
    EXPECT_EQ(x.finish.weave, 0.75);
    EXPECT_EQ(x.finish.roughness, 0.25);
    EXPECT_EQ(y.thickness, 0.02);
    EXPECT_EQ(y.friction, 0.3);
    ASSERT_EQ(scene.warnings.size(), 3U);  // the last: nothing is made of a
    EXPECT_NE(scene.warnings[0].text.find("no cloth takes this thickness: that of its material, b, comes first"),
              std::string::npos)
        << scene.warnings[0].text;
    EXPECT_NE(scene.warnings[1].text.find("no cloth takes this friction"), std::string::npos) << scene.warnings[1].text;
}

TEST(SceneInheritance, KeysOfOtherFormsAreLeftOut) {
    const Loaded scene = loaded(
        "[defaults.collider]\nshape = \"sphere\"\nradius = 0.2\nfriction = 0.9\n"
        "[collider.ball]\n[collider.box]\nshape = \"box\"\nsize = [1, 2, 3]\n");
    ASSERT_EQ(scene.spec.colliders.size(), 2U);
    EXPECT_EQ(scene.spec.colliders[0].radius, 0.2);
    EXPECT_EQ(scene.spec.colliders[1].size, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.spec.colliders[1].friction, 0.9);
    // Nor goes a density with a mass of its own, or a thickness with a ball.
    EXPECT_TRUE(loaded("[defaults.solid]\ndensity_kg_per_m3 = 900\nthickness = 0.004\n"
                       "[solid.ball]\nshape = \"sphere\"\nmass_kg = 2\n")
                    .warnings.empty());
}

TEST(SceneInheritance, EverySectionWithNamesHasIt) {
    const Loaded scene = loaded(
        "[defaults.material]\ndensity_kg_per_m2 = 0.7\n[material.a]\n[material.b]\nlike = \"a\"\n"
        "[defaults.camera]\nfov_deg = 20\n[camera.a]\neye = [0, 1, 5]\n[camera.b]\nlike = \"a\"\n");
    EXPECT_EQ(scene.spec.materials.at("b").density, 0.7);
    EXPECT_EQ(scene.spec.cameras.at(1).eye, glm::dvec3(0, 1, 5));
    EXPECT_EQ(scene.spec.cameras.at(1).fieldOfView, scene.spec.cameras.at(0).fieldOfView);
}

TEST(SceneInheritance, AStateHasTheKeyThatItHasWithAllWrittenOut) {
    const std::string own =
        "[rope.a]\nradius = 0.01\n" + std::string(straightEnds) + "[rope.b]\nradius = 0.01\n" + straightEnds;
    const std::string taken =
        "[defaults.rope]\nradius = 0.01\n[rope.a]\n" + std::string(straightEnds) + "[rope.b]\nlike = \"a\"\n";
    EXPECT_EQ(loaded(own).keys.stateAt(9), loaded(taken).keys.stateAt(9));
}

TEST(SceneInheritance, OverridesChangeDefaultsAndWhatIsLikeFollows) {
    const std::string text = "[defaults.rope]\nradius = 0.01\n[rope.a]\nmass_kg = 2\n" + std::string(straightEnds) +
                             "[rope.b]\nlike = \"a\"\n[collider.p]\nshape = \"compound\"\n"
                             "parts = [{ shape = \"sphere\", radius = 1 }]\n[collider.q]\nlike = \"p\"\n";
    const Loaded scene = loaded(text, {"defaults.rope.radius=0.03", "rope.a.mass_kg=3", "collider.q.parts.0.radius=2"});
    EXPECT_EQ(rope(scene, 1).radius, 0.03);
    EXPECT_EQ(rope(scene, 1).mass, 3.0);
    EXPECT_EQ(scene.spec.colliders[0].parts.at(0).radius, 1.0);
    EXPECT_EQ(scene.spec.colliders[1].parts.at(0).radius, 2.0);  // of the list that it has from p
}

TEST(SceneInheritance, DefaultsOfASceneHoldForWhatBuildsOnIt) {
    const AssetFolder folder;
    folder.write("yard.toml", "schema = 1\n[defaults.rope]\nradius = 0.03\nsegments = 7\n");
    const Loaded scene = folder.load("schema = 1\nscene = \"yard\"\n[defaults.rope]\nsegments = 8\n[rope.a]\n" +
                                     std::string(straightEnds));
    EXPECT_EQ(rope(scene, 0).radius, 0.03);
    EXPECT_EQ(rope(scene, 0).segments, 8);
}

TEST(SceneInheritance, FaultsAreSaidOnceAndWhereTheyStand) {
    expectMessages({
        {"a value that two have",
         "[defaults.rope]\nradius = -1\n[rope.a]\nends = [[0,0,0],[1,0,0]]\n[rope.b]\n"
         "like = \"a\"\n",
         "s.toml:3:10: error: radius must be between 1e-06 and 1e+06 m, not -1\n"
         "  radius = -1\n"
         "           ^"},
        {"a key that nobody has", "[defaults.rope]\nradus = 1\n",
         "s.toml:3:1: error: [defaults.rope] has no key \"radus\"\n"
         "  radus = 1\n"
         "  ^ did you mean \"radius\"?"},
        {"a selector that no copy has",
         "[defaults.rope]\nhold = [\"strat\"]\n[rope.a]\nends = [[0,0,0],[1,0,0]]\n[rope.b]\nlike = \"a\"\n",
         "s.toml:3:9: error: rope.a has no points \"strat\"\n"
         "  hold = [\"strat\"]\n"
         "          ^ did you mean \"start\"?"},
        {"a section that is not there", "[defaults.ropes]\nradius = 1\n",
         "s.toml:2:11: error: [defaults] has no key \"ropes\"\n"
         "  [defaults.ropes]\n"
         "            ^ did you mean \"rope\"?"},
        {"defaults mistyped", "[default.rope]\nradius = 1\n",
         "s.toml:2:2: error: a scene has no \"default\"\n"
         "  [default.rope]\n"
         "   ^ did you mean \"defaults\"?"},
        {"a like of nothing", "[rope.flag]\nends = [[0,0,0],[1,0,0]]\n[rope.b]\nlike = \"flog\"\n",
         "s.toml:4:7: error: [rope.b] needs ends\n"
         "  [rope.b]\n"
         "        ^ ends is a list of two points, each a list of 3 numbers [m]: The two ends\n"
         "s.toml:5:8: error: there is no rope \"flog\"\n"
         "  like = \"flog\"\n"
         "         ^ did you mean \"flag\"?"},
        {"a like of another section", "[camera.a]\n[lamp.b]\nlike = \"camera.a\"\n",
         "s.toml:4:8: error: a lamp cannot be like camera.a\n"
         "  like = \"camera.a\"\n"
         "         ^ name a lamp of this scene"},
        {"a circle", "[camera.a]\nlike = \"b\"\n[camera.b]\nlike = \"a\"\n[camera.c]\nlike = \"a\"\n",
         "s.toml:3:8: error: camera.a is like itself: camera.a -> camera.b -> camera.a\n"
         "  like = \"b\"\n"
         "         ^\n"
         "s.toml:5:8: error: camera.b is like itself: camera.b -> camera.a -> camera.b\n"
         "  like = \"a\"\n"
         "         ^"},
        {"a like that is no text", "[camera.a]\nlike = 7\n",
         "s.toml:3:8: error: like must be a text, not 7\n"
         "  like = 7\n"
         "         ^"},
        {"defaults that are no table", "defaults = 7\n[camera.a]\n",
         "s.toml:2:1: error: defaults must be a table, not 7\n"
         "  defaults = 7\n"
         "  ^ write [defaults]"},
    });
}

// A megabyte that ten thousand elements take over would fill the memory.
TEST(SceneInheritance, InheritanceHasALimit) {
    std::string text = "schema = 1\n[defaults.rope]\nhold = [";
    for (int i = 0; i < 20'000; ++i) text += "\"a\",";
    text += "]\n";
    for (int i = 0; i < 100; ++i) text += "[rope.r" + std::to_string(i) + "]\n";
    EXPECT_NE(AssetFolder().messageOf(text).find("takes too many values over by defaults and like"), std::string::npos);
}

// Each mistyped name is compared with all others, so that the time grows with their square.
TEST(SceneInheritance, ALongChainAndTheErrorsOfATextHaveALimit) {
    const AssetFolder folder;
    const auto chain = [](int length) {
        std::string text = "schema = 1\n";
        for (int i = 1; i < length; ++i) text += fmt::format("[camera.c{}]\nlike = \"c{}\"\n", i, i + 1);
        return text + fmt::format("[camera.c{}]\n", length);
    };
    EXPECT_EQ(folder.messageOf(chain(16)), "");
    EXPECT_EQ(folder.messageOf(chain(17)),
              "s.toml:3:8: error: camera.c1 is the first of more than 16 that are like one another\n"
              "  like = \"c2\"\n"
              "         ^ name one nearer to the end of the chain");
    std::string mistyped = "schema = 1\n";
    for (int i = 0; i < 20'000; ++i) mistyped += fmt::format("[camera.c{}]\nlike = \"cc\"\n", i);
    const std::string chained = folder.messageOf(chain(20'000)), many = folder.messageOf(mistyped);
    EXPECT_EQ(std::count(chained.begin(), chained.end(), '^'), 1) << chained;
    EXPECT_EQ(std::count(many.begin(), many.end(), '^'), 200);
    EXPECT_TRUE(many.ends_with("\n… and more errors"));
}

TEST(SceneInheritance, TheSchemaHasDefaultsInWhichNothingIsRequired) {
    const nlohmann::json root = nlohmann::json::parse(jsonSchema());
    const nlohmann::json& own = root.at("properties").at("defaults").at("properties").at("rope");
    EXPECT_TRUE(own.at("properties").contains("radius"));
    EXPECT_FALSE(own.contains("required"));
    EXPECT_FALSE(own.at("properties").contains("like"));
}

}  // namespace
}  // namespace taut::scene
