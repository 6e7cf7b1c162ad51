// Every field of a timeline, a check and a golden lands in its member; a ramp reaches the field that its key names.
#include <numeric>

#include "taut/bodies/block.h"
#include "taut/bodies/net.h"
#include "taut/bodies/rope.h"
#include "taut/core/trig.h"
#include "taut/forces/anchor.h"
#include "taut/forces/wind.h"
#include "taut/spec/actions.h"
#include "unit/scene_full_text.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using namespace world;

world::SceneSpec readFullScene() {
    const AssetFolder folder;
    return folder.load(fullScene).spec;
}

TEST(SceneTimeline, ActionsComeByTimeAndLandInTheirMembers) {
    const Specs<ActionSpec> actions = readFullScene().actions;
    ASSERT_EQ(actions.size(), 10U);
    const auto& grab = dynamic_cast<const GrabAction&>(actions[0]);
    EXPECT_EQ(grab.t, 1.0);
    EXPECT_EQ(grab.id, "left");
    EXPECT_EQ(grab.target, "cloth.flag.0@bottom-right");
    EXPECT_EQ(grab.near, dvec3(1, 2, 3));
    EXPECT_EQ(grab.radius, 0.2);
    EXPECT_TRUE(grab.rigid);
    EXPECT_EQ(grab.maxForce, std::nullopt);
    EXPECT_EQ(grab.strength, 140.0);
    EXPECT_EQ(grab.dampingRatio, 0.2);
    EXPECT_GT(grab.source.line, 0);
    const auto& move = dynamic_cast<const MoveAction&>(actions[1]);
    EXPECT_EQ(move.to, dvec3(4, 5, 6));
    EXPECT_EQ(move.over, 0.5);
    EXPECT_EQ(move.ease, Ease::out);
    const auto& turn = dynamic_cast<const MoveAction&>(actions[2]);
    EXPECT_EQ(turn.target, "collider.ball");
    EXPECT_EQ(turn.to, std::nullopt);
    EXPECT_EQ(turn.rotation, dvec3(0, 90 * core::radians(1.0), 0));
    EXPECT_EQ(turn.ease, Ease::smooth);
    const auto& segment = dynamic_cast<const CutAction&>(actions[3]);
    EXPECT_EQ(segment.from, dvec2(0, 0.25));
    EXPECT_EQ(segment.upTo, dvec2(0.5, 0.75));
    const auto& plane = dynamic_cast<const CutAction&>(actions[4]);
    EXPECT_EQ(plane.planePoint, dvec3(1, 2, 3));
    EXPECT_EQ(plane.planeNormal, dvec3(0, 2, 0));
    EXPECT_EQ(dynamic_cast<const HoldAction&>(actions[5]).holdOn, "collider.ball");
    // Written before the cuts, but later.
    EXPECT_EQ(dynamic_cast<const PushAction&>(actions[6]).impulse, dvec3(0, 1, 2));
    EXPECT_EQ(dynamic_cast<const AddMassAction&>(actions[7]).mass, 0.5);
    const auto& ramp = dynamic_cast<const RampAction&>(actions[8]);
    EXPECT_EQ(ramp.key, "wind.breeze.velocity");
    EXPECT_EQ(ramp.value, (std::vector<double>{9, 8, 7}));
    EXPECT_EQ(dynamic_cast<const GrabAction&>(actions[9]).maxForce, 30.0);
}

TEST(SceneTimeline, HandChecksAndGoldensLandInTheirMembers) {
    const world::SceneSpec scene = readFullScene();
    EXPECT_TRUE(scene.hand.anywhere);
    EXPECT_EQ(scene.hand.strength, 150.0);
    EXPECT_EQ(scene.hand.dampingRatio, 0.4);
    ASSERT_EQ(scene.checks.size(), 2U);
    EXPECT_EQ(scene.checks[0].that, "height(cloth.flag.*) > 0");
    EXPECT_EQ(scene.checks[0].at, 2.0);
    EXPECT_EQ(scene.checks[0].from, std::nullopt);
    EXPECT_EQ(scene.checks[1].from, 1.0);
    EXPECT_EQ(scene.checks[1].upTo, 3.0);
    ASSERT_EQ(scene.goldens.size(), 1U);
    EXPECT_EQ(scene.goldens[0].frames, (std::vector<int>{10, 20}));
    EXPECT_TRUE(scene.goldens[0].restart);
    EXPECT_TRUE(scene.goldens[0].debug);
    EXPECT_EQ(scene.goldens[0].camera, "turning");
    EXPECT_EQ(scene.goldens[0].size, ivec2(320, 180));
}

TEST(SceneTimeline, StrainsOfYieldAndBreakLandInTheirMembers) {
    const world::SceneSpec scene = readFullScene();
    EXPECT_EQ(scene.materials.at("silk").plasticity.yieldStrain, 0.05);
    EXPECT_EQ(scene.materials.at("silk").plasticity.breakStrain, 0.5);
    EXPECT_EQ(scene.materials.at("silk").plasticity.breakCell, 0.05);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].plasticity.yieldStrain, 0.06);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].plasticity.breakStrain, 0.6);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].plasticity.breakCell, 0.06);
    EXPECT_EQ(scene.bodies.of<world::BlockSpec>()[0].plasticity.yieldStrain, 0.07);
    EXPECT_EQ(scene.bodies.of<world::BlockSpec>()[0].plasticity.breakStrain, 0.7);
    EXPECT_EQ(scene.bodies.of<world::BlockSpec>()[0].plasticity.breakCell, 0.07);
    EXPECT_EQ(scene.bodies.of<world::NetSpec>()[0].plasticity.yieldStrain, 0.08);
    EXPECT_EQ(scene.bodies.of<world::NetSpec>()[0].plasticity.breakStrain, 0.8);
    EXPECT_EQ(scene.bodies.of<world::NetSpec>()[0].plasticity.breakCell, 0.08);
}

// A scene in which one ramp acts.
world::SceneSpec withRamp(const std::string& key, const std::string& to) {
    const AssetFolder folder;
    return folder
        .load("schema = 1\nat = [{ t = 1, do = \"ramp\", key = \"" + key + "\", to = " + to +
              " }]\n[material.m]\n[cloth.c]\nmaterial = \"m\"\n[wind.w]\nvelocity = [1, 2, 3]\n"
              "gust = { amplitude = 4 }\n[camera.c]\nfov_deg = 30\n[anchor.a]\ntarget = \"cloth.c@left\"\n"
              "at = [1, 2, 3]\n")
        .spec;
}

struct RampCase {
    const char *key, *to, *owner;
    fields::Affects affects;
    std::vector<double> before, after;  // in the units of the file
    double (*member)(const world::SceneSpec&);
    double expected;  // of the member, in the units of the spec
};

TEST(SceneTimeline, RampsReadAndWriteTheFieldThatTheyName) {
    const std::vector<RampCase> cases = {
        {"wind.w.velocity",
         "[9, 8, 7]",
         "wind.w",
         fields::Affects::forces,
         {1, 2, 3},
         {9, 8, 7},
         [](const world::SceneSpec& s) { return s.forces.of<world::WindSpec>()[0].velocity.z; },
         7.0},
        {"wind.w.gust.amplitude",
         "5",
         "wind.w",
         fields::Affects::forces,
         {4},
         {5},
         [](const world::SceneSpec& s) { return s.forces.of<world::WindSpec>()[0].gustAmplitude; },
         5.0},
        {"world.gravity",
         "[0, -1.6, 0]",
         "world",
         fields::Affects::forces,
         {0, -9.81, 0},
         {0, -1.6, 0},
         [](const world::SceneSpec& s) { return s.world.gravity.y; },
         -1.6},
        {"material.m.stretch_N_per_m",
         "100",
         "material.m",
         fields::Affects::springs,
         {900},
         {100},
         [](const world::SceneSpec& s) { return s.materials.at("m").stretch; },
         100.0},
        {"camera.c.fov_deg",
         "60",
         "camera.c",
         fields::Affects::picture,
         {30},
         {60},
         [](const world::SceneSpec& s) { return s.cameras[0].fieldOfView; },
         60 * core::radians(1.0)},
        {"light.colour",
         "\"#ff0000\"",
         "light",
         fields::Affects::picture,
         {1, 0.96, 0.9},
         {1, 0, 0},
         [](const world::SceneSpec& s) { return s.light.colour.y; },
         0.0},
        {"anchor.a.at",
         "[4, 5, 6]",
         "anchor.a",
         fields::Affects::forces,
         {1, 2, 3},
         {4, 5, 6},
         [](const world::SceneSpec& s) { return s.forces.of<world::AnchorSpec>()[0].at.x; },
         4.0},
    };
    for (const RampCase& row : cases) {
        SCOPED_TRACE(row.key);
        world::SceneSpec scene = withRamp(row.key, row.to);
        const auto ramp = dynamic_cast<const RampAction&>(scene.actions[0]);
        EXPECT_EQ(ramp.field->owner, row.owner);
        EXPECT_EQ(ramp.field->affects, row.affects);
        EXPECT_EQ(ramp.value, row.after);
        const std::vector<double> before = ramp.field->read(scene);
        ASSERT_EQ(before.size(), row.before.size());
        for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(before[i], row.before[i], 1e-13);  // a rounding
        ramp.field->write(scene, ramp.value);
        EXPECT_EQ(row.member(scene), row.expected);
    }
}

TEST(SceneTimeline, MomentsOffTheTicksAreWarnedOf) {
    const AssetFolder folder;
    const std::string rope = "[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\n";
    const auto warningsOf = [&](const std::string& t) {
        return printed(folder
                           .load("schema = 1\nat = [{ t = " + t + ", do = \"hold\", target = \"rope.r\" }]\n" + rope +
                                 "[[check]]\nthat = \"time >= 0\"\nat = " + t + "\n")
                           .warnings);
    };
    EXPECT_EQ(warningsOf("0.51666"), std::vector<std::string>());   // 31 ticks but for 0.04 % of one
    EXPECT_EQ(warningsOf("0.515"), std::vector<std::string>());     // 30.9 ticks
    const std::vector<std::string> warnings = warningsOf("0.525");  // 31.5 ticks, each a frame
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("0.525 s is midway between frames of 1/60 s: 0.533333333 s is taken; so is 1 more"),
              std::string::npos)
        << warnings[0];
}

// A tick is then a third of a frame, and no moment further than half of that from one.
TEST(SceneTimeline, MomentsBetweenTicksOfFilmAndTelevisionDoNotWarn) {
    const AssetFolder folder;
    for (const char* fps : {"24", "25", "30"}) {
        const Loaded loaded = folder.load("schema = 1\nrun = { fps = " + std::string(fps) +
                                          " }\nat = [{ t = 0.7, do = \"hold\", target = \"rope.r\" },\n"
                                          "{ t = 1.31, do = \"free\", target = \"rope.r\" }]\n"
                                          "[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\n");
        EXPECT_EQ(printed(loaded.warnings), std::vector<std::string>()) << fps;
    }
}

TEST(SceneTimeline, TheManualNamesWhatARampMayChange) {
    const std::string text = manual();
    EXPECT_NE(text.find("  wind.NAME      velocity, gust.amplitude, drag, lift\n"), std::string::npos);
    EXPECT_NE(text.find("  world          gravity, air_density_kg_per_m3, air_pressure_Pa\n"), std::string::npos);
}

}  // namespace
}  // namespace taut::scene
