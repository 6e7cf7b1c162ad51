#include "taut/live/session.h"

#include <gtest/gtest.h>

#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::live {
namespace {

constexpr const char* sceneText = R"(schema = 1
[run]
fps = 30
seconds = 2.0
[material.nylon]
[cloth.flag]
cells = [10, 10]
origin = [0.0, 2.0, 0.0]
material = "nylon"
hold = ["top"]
[camera.main]
)";

world::SceneSpec scene() {
    return scene::loadSceneText(sceneText, "flag.toml", {}).spec;
}

// Ticks in lots of different sizes, as a machine of changing speed has them.
void advance(Session& session, int lots) {
    for (int i = 0; i < lots; ++i) {
        session.begin(1 + i % 3, 10.0);
        session.wait();
    }
}

void pull(Session& session) {
    const std::vector<BodyPoints> bodies = session.bodies();
    ASSERT_EQ(bodies.size(), 1U);
    const glm::dvec3 place = bodies[0].positions.back();
    session.hand().grab(bodies[0].name + "@#" + std::to_string(bodies[0].points.back()), 0.12, 150.0, 0.3, place);
    for (int i = 1; i <= 6; ++i) {
        session.hand().leadTo(place + glm::dvec3(0.0, 0.02 * i, 0.06 * i));
        advance(session, 2);
    }
    session.hand().release();
    advance(session, 4);
}

TEST(Session, HeldPointsAreNotOffered) {
    Session session(scene(), 1);
    ASSERT_EQ(session.bodies().size(), 1U);
    EXPECT_EQ(session.bodies()[0].points.size(), 110U);  // 11 · 11 without the upper edge
    EXPECT_EQ(session.bodies()[0].points.front(), 11);
}

TEST(Session, ShowsTheLastTwoTicks) {
    Session session(scene(), 1);
    EXPECT_EQ(session.before().time, session.now().time);
    session.begin(5, 10.0);
    session.wait();
    EXPECT_EQ(session.tick(), 5);
    EXPECT_NEAR(session.now().time, 5 / 60.0, 1e-12);
    EXPECT_NEAR(session.before().time, 4 / 60.0, 1e-12);
}

TEST(Session, WithoutTimeItStillGoesOnByATick) {
    Session session(scene(), 1);
    session.begin(100, 0.0);
    session.wait();
    EXPECT_EQ(session.tick(), 1);
}

TEST(Session, AHandThatFindsNothingIsSaidAndNotRecorded) {
    Session session(scene(), 1);
    session.hand().grab("cloth.nothing@#1", 0.1, 150.0, 0.3, {0.0, 0.0, 0.0});
    advance(session, 1);
    EXPECT_EQ(session.takeFaults().size(), 1U);
    EXPECT_TRUE(session.takeFaults().empty());
    EXPECT_TRUE(session.deeds().empty());
}

// What the whole of this folder is for: the file does what the hand did.
TEST(Session, TheRecordingPlaysToTheSameState) {
    Session session(scene(), 1);
    advance(session, 5);
    pull(session);
    Recording recording = session.record();
    EXPECT_GT(recording.deeds.size(), 5U);
    EXPECT_EQ(recording.endTick % recording.ticksPerFrame, 0);
    recording.scene = "flag.toml";

    // The same merged by hand: the recording over the scene.
    std::string text = scenarioText(recording);
    text.replace(text.find("schema = 1\nscene = \"flag.toml\"\n"), 30, "");
    std::string base = sceneText;
    base.replace(base.find("[run]\nfps = 30\nseconds = 2.0\n"), 29, "");
    base.replace(base.find("schema = 1\n"), 11, "schema = 1\n" + text);
    world::World replay(scene::loadSceneText(base, "replay.toml", {}).spec, {.threads = 1});
    while (replay.tick() < recording.endTick) ASSERT_FALSE(replay.advance());
    EXPECT_EQ(replay.stateHash(), recording.hash);

    // The hand did matter.
    Session untouched(scene(), 1);
    untouched.begin(static_cast<int>(recording.endTick), 100.0);
    untouched.wait();
    EXPECT_NE(untouched.world().stateHash(), recording.hash);
}

}  // namespace
}  // namespace taut::live
