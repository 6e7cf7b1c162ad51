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
    EXPECT_EQ(session.bodies(true)[0].points.size(), 121U);  // to be named, not taken
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

TEST(Session, GoesOnWhereAnotherOfTheSceneIs) {
    Session whole(scene(), 1);
    advance(whole, 5);
    const BodyPoints body = whole.bodies()[0];
    const glm::dvec3 place = body.positions.back();
    whole.hand().grab(body.name + "@#120", 0.12, 150.0, 0.3, place);
    whole.hand().leadTo(place + glm::dvec3(0.0, 0.0, 0.3));
    advance(whole, 2);  // in the middle of a way
    Session next(scene(), 1, whole);
    EXPECT_EQ(next.tick(), whole.tick());
    for (Session* session : {&whole, &next}) {
        session->hand().leadTo(place + glm::dvec3(0.3, 0.0, 0.3));
        advance(*session, 6);
    }
    EXPECT_EQ(next.world().stateHash(), whole.world().stateHash());
    EXPECT_EQ(next.deeds().size(), whole.deeds().size());
    EXPECT_EQ(next.record().hash, whole.record().hash);
}

// A mass of 2 kg on a spring of 1 m, led 5 m down: the spring has its weight and twice that to hold.
TEST(Session, TheHandSlipsFromWhatItCannotMove) {
    const std::string text = R"(schema = 1
[net.bell]
drag_per_s = 8.0
points = [ { name = "nail", position = [0, 2, 0], hold = true }, { name = "bob", position = [0, 1, 0], mass_kg = 2.0 } ]
springs = [ { a = "nail", b = "bob", stiffness_N_per_m = 1000.0, rest_length_m = 1.0 } ]
[camera.main]
)";
    Session session(scene::loadSceneText(text, "bell.toml", {}).spec, 1);
    const double force = session.handForce("net.bell");
    EXPECT_NEAR(force, 2 * 2.0 * 9.81, 1e-9);
    session.hand().grab("net.bell@bob", 0.0, 200.0, 0.3, {0, 1, 0}, force);
    session.hand().leadTo({0, -4, 0});
    advance(session, 150);  // 5 s, and e^-4 in each of them
    EXPECT_NEAR(session.metrics().maxStrain, 3 * 2.0 * 9.81 / 1000.0, 1e-4);
    const Recording recording = session.record();
    EXPECT_NE(scenarioText(recording).find("max_force_N = 39.24"), std::string::npos);
}

// The purpose of this folder: the file repeats the hand's actions.
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
