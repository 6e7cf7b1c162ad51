// Actions from outside the engine, made of the engine's own: one that shakes points for a while, one that drops them.
#include <gtest/gtest.h>

#include "support/timelines.h"
#include "taut/bodies/net.h"
#include "taut/live/recording.h"
#include "taut/spec/kinds.h"
#include "unit/scene_support.h"

namespace taut::world::own_action {
namespace {

// At every tick for a while an impulse, to and fro.
struct ShakeAction final : SpecOf<ShakeAction, PointsAction> {
    static constexpr std::string_view kindName = "shake";
    dvec3 impulse{0.0};  // [N s]
    double over = 1.0;   // [s]

    double lasts() const override { return over; }
    void perform(World& world) const override {
        PushAction push;
        push.source = source;
        push.target = target;
        push.impulse = world.tick() % 2 == 0 ? impulse : -impulse;
        world.apply(push);
    }
};

// Frees points after all: steps have to allow for it from the start.
struct DropAction final : SpecOf<DropAction, PointsAction> {
    static constexpr std::string_view kindName = "drop";

    FreeAction freeing() const {
        FreeAction free;
        free.target = target;
        return free;
    }
    void perform(World& world) const override { world.apply(freeing()); }
    void foresee(const Visit& visit) const override { visit(freeing()); }
};

std::shared_ptr<const Kinds> withShake() {
    Kinds kinds = builtIn();
    kinds.actions.add(actionKind<ShakeAction>(
        fields::FieldList<ShakeAction>()
            .text("target", &ShakeAction::target, fields::Role::none, "The points, as of a push.")
            .vector("impulse_Ns", &ShakeAction::impulse, "N s", placeRange, "Of each push, to and fro.")
            .required()
            .number("over_s", &ShakeAction::over, "s", momentRange, "How long it goes on.")));
    return std::make_shared<const Kinds>(std::move(kinds));
}

const std::string ball = R"(schema = 1
[world]
gravity = [0, 0, 0]
[solver]
precision = "double"
[run]
seconds = 1
[net.ball]
points = [{ name = "m", position = [0, 0, 0], mass_kg = 2 }, { name = "wall", position = [0, 0, 5], hold = true }]
springs = [{ a = "m", b = "wall", stiffness_N_per_m = 1e-9 }]
drag_per_s = 0
)";
const std::string shaken =
    "at = [\n  { t = 0.1, do = \"shake\", target = \"net.ball@m\", impulse_Ns = [0, 0.6, 0], "
    "over_s = 0.25 },\n]\n";

// The ball, and its actions.
SceneSpec sceneOf(const std::string& at) {
    std::string text = ball;
    return scene::loadSceneText(text.insert(text.find("[world]"), at), "s.toml", {.kinds = withShake()}).spec;
}

TEST(OwnAction, IsReadFromASceneAndPerformedAtEveryTickThatItLasts) {
    World world(sceneOf(shaken));
    support::run(world, 6);
    EXPECT_EQ(world.points("net.ball@m").v[0], dvec3(0.0));
    support::run(world, 1);
    EXPECT_NEAR(world.points("net.ball@m").v[0].y, 0.6 / 2, 1e-12);  // J/m, to rounding
    support::run(world, 30);
    // Ticks 6 … 21: sixteen pushes, eight times a way of J/m · 1/60 s; the spring's force is below 1e-8 N.
    EXPECT_NEAR(world.points("net.ball@m").x[0].y, 8 * 0.3 / 60, 1e-9);
    EXPECT_NEAR(world.points("net.ball@m").v[0].y, 0.0, 1e-9);
}

TEST(OwnAction, GoesOnAfterSavingAndRestoring) {
    const SceneSpec scene = sceneOf(shaken);
    World through(scene);
    support::run(through, 12);
    World restored(scene);
    restored.restore(through.save());
    support::run(through, 20);
    support::run(restored, 20);
    EXPECT_EQ(through.save(), restored.save());
}

TEST(OwnAction, AStateNamesItToAWorldThatHasItNot) {
    World world(sceneOf(shaken));
    const std::vector<std::byte> before = world.save();
    support::run(world, 12);
    SceneSpec without = sceneOf("");
    try {
        World(without).restore(world.save());
        ADD_FAILURE() << "was taken";
    } catch (const core::Error& error) {
        EXPECT_NE(std::string(error.what()).find("they need the action shake"), std::string::npos) << error.what();
    }
    World(without).restore(before);  // nothing of it has happened yet
}

TEST(OwnAction, IsRecordedAsTextAndReadBack) {
    const scene::AssetFolder folder;
    folder.write("ball.toml", ball);
    live::Recording recording;
    recording.scene = "ball.toml";
    recording.endTick = 30;
    const SceneSpec scene = sceneOf(shaken);
    recording.timeline = scene.actions;
    EXPECT_THROW(live::scenarioText(recording), core::Error);
    recording.actionKinds = scene.actionKinds;
    const std::string text = live::scenarioText(recording);
    EXPECT_NE(text.find(shaken), std::string::npos) << text;
    EXPECT_NE(scene::manual(*withShake()).find("ramp, spawn, shake; required"), std::string::npos);
    const SceneSpec again = folder.load(text, {.kinds = withShake()}).spec;
    EXPECT_EQ(dynamic_cast<const ShakeAction&>(again.actions[0]).impulse, dvec3(0, 0.6, 0));
    EXPECT_NE(folder.messageOf(text).find("do must be one of grab, move, release, push, hold, free, cut, add-mass, "
                                          "ramp, spawn, not \"shake\""),
              std::string::npos);
    EXPECT_NE(folder.messageOf("schema = 1\nat = [{ t = 0, do = \"push\", over_s = 1 }]\n", {.kinds = withShake()})
                  .find("it belongs to move, ramp, shake"),
              std::string::npos);
}

TEST(OwnAction, StepsAllowForWhatItForesees) {
    SceneSpec scene;
    NetSpec& net = scene.bodies.add(NetSpec{});
    net.name = "pair";
    net.points = {{"light", {0, 0, 0}, 0.01, true, {}}, {"heavy", {1, 0, 0}, 3.0, false, {}}};
    net.springs = {{"light", "heavy", 100.0, std::nullopt, std::nullopt, {}}};
    const double held = World(scene).islands()[0].stepLimit;
    scene.actions = {support::action<FreeAction>(0.1, "net.pair@light")};
    World freed(scene);
    scene.actions = {support::action<DropAction>(0.1, "net.pair@light")};
    World dropped(scene);
    EXPECT_LT(dropped.islands()[0].stepLimit, held / 10);  // √(3/0.01) = 17 times as stiff for its mass
    EXPECT_EQ(dropped.islands()[0].stepLimit, freed.islands()[0].stepLimit);
    support::run(freed, 30);
    support::run(dropped, 30);
    EXPECT_EQ(dropped.stateHash(), freed.stateHash());
}

}  // namespace
}  // namespace taut::world::own_action
