// Warnings before the first tick of a timeline that its run will refuse, and of steps that will diverge.
#include "taut/advice/rehearsal.h"

#include <gtest/gtest.h>

#include "support/timelines.h"
#include "taut/advice/bending_cells.h"
#include "taut/bodies/net.h"
#include "taut/bodies/solid.h"

namespace taut::world {
namespace {

using support::action;

// A rope along x at a height of 3 m, held where it starts.
SceneSpec heldRope() {
    SceneSpec scene;
    scene.run.seconds = 1;
    scene.bodies.add(support::rope("line", {0, 3, 0}, {1, 3, 0}, 4));
    scene.bodies[0].hold = {"start"};
    return scene;
}

std::string onlyFault(const SceneSpec& scene) {
    const Rehearsal rehearsal = rehearse(scene);
    EXPECT_TRUE(rehearsal.warnings.empty()) << rehearsal.warnings.front().text;
    EXPECT_LE(rehearsal.faults.size(), 1U);
    return rehearsal.faults.empty() ? "" : printed(rehearsal.faults.front());
}

TEST(Rehearsal, HasNothingToSayOfASceneInWhichEverythingHappens) {
    const Rehearsal rehearsal = rehearse(support::everythingHappens());
    EXPECT_TRUE(rehearsal.faults.empty()) << rehearsal.faults.front().text;
    EXPECT_TRUE(rehearsal.warnings.empty()) << rehearsal.warnings.front().text;
}

TEST(Rehearsal, FindsAGrabOfPointsThatAreHeldOnceAndNotWhatFollowsFromIt) {
    SceneSpec scene = heldRope();
    scene.actions = {support::grab(0.5, "rope.line@start"), support::moveHand(0.6, {0, 4, 0}, 0.1),
                     support::release(0.8)};
    EXPECT_EQ(onlyFault(scene),
              "timeline.toml:7:3: error: every point of \"rope.line@start\" is held already; free them first");
    scene.actions = {action<FreeAction>(0.4, "rope.line@start"), support::grab(0.5, "rope.line@start")};
    EXPECT_EQ(onlyFault(scene), "");
    scene.actions = {action<HoldAction>(0.4, "rope.line"), support::push(0.5, "rope.line@end", {1, 0, 0})};
    EXPECT_EQ(onlyFault(scene), "timeline.toml:7:3: error: every point of \"rope.line@end\" is held; free them first");
}

TEST(Rehearsal, FindsAnActionOnABodyThatIsNotThereYet) {
    SceneSpec scene = heldRope();
    scene.actions = {support::push(0.2, "rope.line@end", {1, 0, 0}), action<SpawnAction>(0.5, "rope.line")};
    EXPECT_EQ(onlyFault(scene), "timeline.toml:7:3: error: target = \"rope.line@end\" names no point");
}

TEST(Rehearsal, WarnsOfACutThatMeetsNothing) {
    const std::string warning =
        "timeline.toml:7:3: warning: there is nothing whole of \"rope.line\" where this cuts; put it where the body is";
    SceneSpec scene = heldRope();
    scene.actions = {support::cutPlane(0.0, "rope.line", {2, 0, 0}, {1, 0, 0})};
    EXPECT_EQ(printed(rehearse(scene).warnings), std::vector{warning});
    EXPECT_TRUE(rehearse(scene).faults.empty());
    // Nor half a second later, which only playing it tells.
    scene.actions = {support::cutPlane(0.5, "rope.line", {2, 0, 0}, {1, 0, 0})};
    EXPECT_EQ(printed(rehearse(scene).warnings), std::vector{warning});
    World world(scene);
    while (world.time() < 0.6) ASSERT_FALSE(world.advance());
    EXPECT_EQ(printed(world.warnings()), std::vector{warning});
    // The rope has fallen onto this plane by then: g t²/2 = 1.2 m.
    scene.actions = {support::cutPlane(0.5, "rope.line", {0, 2.5, 0}, {0, 1, 0})};
    EXPECT_TRUE(rehearse(scene).warnings.empty());
}

TEST(Rehearsal, WarnsOfACutWhosePlayingWouldBeDear) {
    SceneSpec scene = heldRope();
    scene.run.seconds = 1e5;
    scene.actions = {support::cutPlane(9e4, "rope.line", {0, 2.5, 0}, {0, 1, 0})};
    const Rehearsal rehearsal = rehearse(scene);
    EXPECT_TRUE(rehearsal.faults.empty());
    ASSERT_EQ(rehearsal.warnings.size(), 1U);
    EXPECT_TRUE(printed(rehearsal.warnings[0])
                    .starts_with("timeline.toml:7:3: warning: there is nothing whole of \"rope.line\""))
        << rehearsal.warnings[0].text;
}

TEST(Rehearsal, WarnsOfAFewBodiesThatComeIntoEachOthersWay) {
    SceneSpec scene;
    scene.run.seconds = 1;
    for (int i = 0; i < 5; ++i)
        scene.bodies.add(support::rope("r" + std::to_string(i), {0, 3, -0.1}, {1, 3, 0.1 * i}, 4));
    const Rehearsal rehearsal = rehearse(scene);
    EXPECT_TRUE(rehearsal.faults.empty());
    ASSERT_EQ(rehearsal.warnings.size(), 9U);
    EXPECT_EQ(printed(rehearsal.warnings[0]),
              "rope.r0 and rope.r1 come into each other's way and pass through each other: give both touch = "
              "\"others\", keep them apart, or tie them by a joint");
    EXPECT_EQ(printed(rehearsal.warnings[8]), "2 more pairs of bodies come into each other's way");  // of ten
}

// Cells of a quarter of a metre and a bending length of 2 cm: taut info says so.
TEST(Rehearsal, HasNothingToSayOfCoarseCells) {
    SceneSpec scene;
    scene.run.seconds = 1;
    scene.materials["linen"].rigidity.warp = 2e-5;
    scene.bodies.add(support::cloth("sheet", 4));
    scene.bodies.of<ClothSpec>()[0].material = "linen";
    EXPECT_EQ(coarseCells(scene).size(), 1U);
    EXPECT_TRUE(rehearse(scene).advice.empty());
}

// A rope that strikes itself at some 40 m/s for a second, in steps near the limit of its springs. Where nothing is lost
// in a bounce, the errors of the steps add up; else it only loses energy.
TEST(Rehearsal, WarnsOfEnergyThatComesFromNowhere) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.contact.friction = 0.0;
    scene.run.seconds = 2;
    RopeSpec rope;
    rope.name = "line";
    rope.end = {0.6, 0.0, 0.0};
    rope.segments = 8;
    rope.radius = 0.02;
    rope.mass = 0.5;
    rope.dampingTime = rope.drag = 0.0;
    rope.touch = Touch::all;
    scene.bodies.add(rope);
    for (const auto& [at, impulse] :
         {std::pair{"start", dvec3(2.0, 1.2, 0.4)}, {"end", dvec3(-2.0, 0.4, -0.6)}, {"50%", dvec3(0.2, -1.6, 0.4)}}) {
        PushAction push;
        push.target = std::string("rope.line@") + at;
        push.impulse = impulse;
        scene.actions.add(push);
    }
    for (const double restitution : {0.0, 1.0}) {
        scene.contact.restitution = restitution;
        const std::vector<std::string> all = printed(rehearse(scene).warnings);
        EXPECT_EQ(std::count_if(
                      all.begin(), all.end(),
                      [](const std::string& text) { return text.starts_with("the energy of the bodies grows by "); }),
                  restitution > 0 ? 1 : 0);
    }
}

// A cube half in the ground rises by 0.25 m.
TEST(Rehearsal, HasNothingToSayOfTheEnergyOfABodyThatIsPushedOutOfTheGround) {
    SceneSpec scene;
    scene.run.seconds = 1;
    scene.colliders = {support::ground()};
    SolidSpec cube;
    cube.name = "cube";
    cube.touch = Touch::others;
    scene.bodies.add(cube);
    const std::vector<std::string> all = printed(rehearse(scene).warnings);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_TRUE(all[0].starts_with("solid.cube starts 0.25 m deep in collider.ground")) << all[0];
}

// It falls by 4.9 m, and the picture is 2 m high where it is.
TEST(Rehearsal, WarnsOfABodyThatLeavesThePictureInTheFirstSecond) {
    SceneSpec scene = heldRope();
    CameraSpec camera;
    camera.eye = {0.5, 3, 3};
    camera.target = {0.5, 3, 0};
    scene.cameras = {camera};
    scene.run.seconds = 2;
    EXPECT_EQ(printed(rehearse(scene).warnings), std::vector<std::string>());
    scene.bodies[0].hold.clear();
    EXPECT_EQ(printed(rehearse(scene).warnings),
              std::vector<std::string>{"rope.line leaves the picture in the first second: move the camera, or "
                                       "hold it in place"});
}

TEST(Rehearsal, WarnsOfAFastBodyInAShortRunWithoutCameras) {
    SceneSpec scene;
    scene.run.seconds = 0.5;
    scene.world.gravity = dvec3(0.0);
    scene.bodies.add(support::rope("line", {0, 1, 0}, {1, 1, 0}, 4));
    EXPECT_EQ(printed(rehearse(scene).warnings), std::vector<std::string>());
    scene.bodies[0].velocity = {40, 0, 0};
    EXPECT_EQ(printed(rehearse(scene).warnings),
              std::vector<std::string>{"rope.line leaves the picture in the first second: move the camera, or "
                                       "hold it in place"});
}

// A mass of 1 kg that hangs by a spring of 1e6 N/m: ω = 1000 /s, of which leap-frog stands steps of 2 ms.
SceneSpec stiffPair() {
    SceneSpec scene;
    scene.solver.dt = 1.0 / 60;
    NetSpec net;
    net.name = "pair";
    net.source = {"net.toml", 4, 2};
    net.drag = 0;
    net.points = {{"nail", {0, 0, 0}, 1.0, true, {}}, {"bob", {0, -1, 0}, 1.0, false, {}}};
    net.springs = {{"nail", "bob", 1e6, std::nullopt, std::nullopt, {}}};
    scene.bodies.add(net);
    return scene;
}

TEST(Rehearsal, RefusesAStepThatIsBoundToDiverge) {
    SceneSpec scene = stiffPair();
    const std::string fault = onlyFault(scene);
    EXPECT_TRUE(
        fault.starts_with("net.toml:4:2: error: net.pair: the step of 0.0167 s is over the stability limit of "
                          "leap-frog, 0.002 s as the scene starts: it will diverge"))
        << fault;
    EXPECT_NE(fault.find("; give dt = \"auto\", or 0.002 s or less"), std::string::npos) << fault;
    World world(scene);
    bool diverges = false;
    for (int i = 0; i < 60 && !diverges; ++i) diverges = world.advance().has_value();
    EXPECT_TRUE(diverges);
    // Where a diverging island is frozen the run goes on.
    scene.solver.onDivergence = OnDivergence::freeze;
    const Rehearsal kept = rehearse(scene);
    EXPECT_TRUE(kept.faults.empty());
    ASSERT_EQ(kept.warnings.size(), 1U);
    EXPECT_NE(kept.warnings[0].text.find("it will diverge"), std::string::npos);
}

}  // namespace
}  // namespace taut::world
