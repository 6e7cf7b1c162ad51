// Warnings before the first tick about probably unintended settings.
#include "taut/advice/private/start_doubts.h"

#include <gtest/gtest.h>

#include "support/timelines.h"
#include "taut/advice/figures.h"
#include "taut/bodies/solid.h"
#include "taut/joints/joints.h"

namespace taut::world {
namespace {

using Doubts = std::vector<std::string>;

Doubts doubtsOf(const SceneSpec& scene) {
    World world(scene);
    return printed(startDoubts(world));
}

SceneSpec ropeScene(RopeSpec rope) {
    SceneSpec scene;
    scene.bodies.add(std::move(rope));
    return scene;
}

TEST(StartDoubts, AreOfBodiesInOnePlaceThatTouch) {
    SceneSpec scene;
    for (const char* name : {"a", "b"}) {
        ClothSpec cloth = support::cloth(name, 4);
        cloth.touch = Touch::others;
        scene.bodies.add(cloth);
    }
    EXPECT_EQ(doubtsOf(scene),
              (Doubts{"cloth.a and cloth.b start in the same place, by 50 points: their sides are undetermined, and "
                      "separation takes long; start them 0.01 m apart"}));
    scene.bodies.of<ClothSpec>()[1].origin.z += 0.001;  // a tenth of their distance
    EXPECT_EQ(doubtsOf(scene), Doubts());
    scene.bodies.of<ClothSpec>()[1].origin = {0.7, 2, 0};  // in one plane, a part of each in the other
    EXPECT_EQ(doubtsOf(scene).size(), 1U);
    SceneSpec ropes = ropeScene(support::rope("a", {0, 2, 0}, {1, 2, 0}, 4));
    ropes.bodies.add(support::rope("b", {0, 2, 0}, {1, 2, 0}, 7));
    for (BodySpec& body : ropes.bodies) body.touch = Touch::others;
    EXPECT_EQ(doubtsOf(ropes).size(), 1U);
}

TEST(StartDoubts, AreOfWindsFasterThanAnyStorm) {
    SceneSpec scene = ropeScene(support::rope("line", {0, 2, 0}, {1, 2, 0}));
    WindSpec wind;
    wind.name = "breeze";
    wind.velocity = {100, 0, 0};
    scene.forces.add(wind);
    EXPECT_EQ(doubtsOf(scene), Doubts());
    scene.forces.of<WindSpec>()[0].gustAmplitude = 30;
    EXPECT_EQ(doubtsOf(scene), (Doubts{"wind.breeze blows at up to 130 m/s, faster than any storm; a gale has "
                                       "20 to 30"}));
}

TEST(StartDoubts, AreOfABlockInPiecesThatDoNotTouch) {
    SceneSpec scene = ropeScene(support::rope("line", {0, 2, 0}, {1, 2, 0}));
    scene.bodies[0].touch = Touch::others;
    BlockSpec block;
    block.name = "jelly";
    block.touch = Touch::others;
    scene.bodies.add(block);
    CutAction cut;
    cut.target = "block.jelly";
    cut.planePoint = cut.planeNormal = glm::dvec3(0, 1, 0);
    scene.actions.add(cut);
    EXPECT_EQ(doubtsOf(scene), (Doubts{"block.jelly touches others only: its pieces will go through each "
                                       "other; give it touch = \"all\""}));
    scene.bodies.of<BlockSpec>()[0].touch = Touch::all;
    EXPECT_EQ(doubtsOf(scene), Doubts());
}

TEST(StartDoubts, AreOfACameraInsideACollider) {
    SceneSpec scene = ropeScene(support::rope("line", {0, 2, 0}, {1, 2, 0}));
    scene.run.seconds = 2;
    ColliderSpec box;
    box.name = "box";
    box.shape = "box";
    box.size = {1, 1, 1};
    scene.colliders = {support::ground(), box};
    scene.colliders[0].position.y = -3;
    CameraSpec camera;
    camera.name = "main";
    camera.eye = {0, 0.51, 0};
    scene.cameras = {camera};
    EXPECT_EQ(doubtsOf(scene), Doubts());
    scene.cameras[0].eye.y = 0.49;
    EXPECT_EQ(doubtsOf(scene), (Doubts{"camera.main is inside collider.box at 0 s, and sees little else; move "
                                       "one of them"}));
    scene.cameras[0].eye.y = 0.51;
    scene.colliders[1].keys = {{.t = 0}, {.t = 2, .position = {0, 0.1, 0}}};  // smoothly: 0.01 m, a tenth, after 0.39 s
    const Doubts later = doubtsOf(scene);
    ASSERT_EQ(later.size(), 1U);
    EXPECT_NE(later[0].find("at 0.4 s"), std::string::npos) << later[0];
}

TEST(StartDoubts, AreOfARopeOfHalfTheSpan) {
    RopeSpec rope = support::rope("line", {0, 2, 0}, {1, 2, 0}, 10);
    rope.length = 0.5;
    EXPECT_EQ(doubtsOf(ropeScene(rope)),
              (Doubts{"rope.line starts with a strain of 1: a spring of it is 0.1 m long, and 0.05 m at rest; "
                      "bring its ends together, or make it longer"}));
    rope.length = 0.7;  // a strain of 0.43
    EXPECT_EQ(doubtsOf(ropeScene(rope)), Doubts());
    rope.length = 2;  // slack
    EXPECT_EQ(doubtsOf(ropeScene(rope)), Doubts());
}

// A cube of half a metre that touches others.
SolidSpec crate(const char* name, dvec3 place) {
    SolidSpec solid;
    solid.name = name;
    solid.position = place;
    solid.touch = Touch::others;
    return solid;
}

TEST(StartDoubts, AreOfASolidInTheGround) {
    SceneSpec scene;
    scene.bodies.add(crate("a", {0, 0, 0}));
    scene.colliders = {support::ground()};
    EXPECT_EQ(doubtsOf(scene), (Doubts{"solid.a starts 0.25 m deep in collider.ground, and is pushed out of "
                                       "it: move the body or the collider"}));
    scene.bodies.of<SolidSpec>()[0].position.y = 0.25;
    EXPECT_EQ(doubtsOf(scene), Doubts());
}

// The points that have a solid's mass may lie outside of it: those of a cone lie below its base.
TEST(StartDoubts, AreNotOfSolidsThatStandOnTheGround) {
    for (const char* shape : {"box", "sphere", "capsule", "cylinder", "cone"}) {
        SceneSpec scene;
        scene.bodies.add(crate("a", {0, 0, 0}));
        SolidSpec& solid = scene.bodies.of<SolidSpec>()[0];
        solid.shape = shape;
        const collision::ShapeKind& kind = *collision::builtInShapes().find(shape);
        solid.position.y = -kind.convex(sizesOf(solid, kind), 0.0)->bounds()->low.y;
        if (kind.isRound) solid.thickness = solid.radius;
        scene.colliders = {support::ground()};
        EXPECT_EQ(doubtsOf(scene), Doubts()) << shape;
        EXPECT_NEAR(World(scene).metrics().penetration, 0.0, 1e-7) << shape;  // rounding of 1 m in float
        solid.position.y -= 0.05;
        EXPECT_EQ(doubtsOf(scene), (Doubts{"solid.a starts 0.05 m deep in collider.ground, and is pushed out of it: "
                                           "move the body or the collider"}))
            << shape;
    }
}

TEST(StartDoubts, SayHowFarSolidsReachIntoEachOther) {
    SceneSpec scene;
    scene.bodies.add(crate("a", {0, 1, 0}));
    scene.bodies.add(crate("b", {0.1, 1.05, 0}));
    const Doubts doubts = doubtsOf(scene);  // 0.4 m sideways, 0.45 m upwards
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_NE(doubts[0].find("start them 0.4 m further off"), std::string::npos) << doubts[0];
    scene.bodies.of<SolidSpec>()[1].position = {0.1, 1.51, 0};
    EXPECT_EQ(doubtsOf(scene), Doubts());
}

// 0.5 m to either side of the box, and 0.1 m of the ball.
TEST(StartDoubts, AreOfASolidInsideAnother) {
    SceneSpec scene;
    scene.bodies.add(crate("box", {0, 1, 0}));
    scene.bodies.of<SolidSpec>()[0].size = {1, 1, 1};
    scene.bodies.add(crate("ball", {0, 1, 0}));
    scene.bodies.of<SolidSpec>()[1].shape = "sphere";
    scene.bodies.of<SolidSpec>()[1].radius = 0.1;
    const Doubts doubts = doubtsOf(scene);
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_NE(doubts[0].find("solid.ball and solid.box start in each other: they will be pushed apart, start them 0.6 "
                             "m further off"),
              std::string::npos)
        << doubts[0];
}

TEST(StartDoubts, AreOfABodyInMillimetres) {
    SceneSpec scene;
    for (const char* name : {"a", "b", "c"}) scene.bodies.add(crate(name, {name[0] - 'a', 60, 0}));
    EXPECT_EQ(doubtsOf(scene), Doubts());
    SolidSpec& ball = scene.bodies.of<SolidSpec>()[2];
    ball.shape = "sphere";
    ball.radius = 40;
    ball.position.x = 100;
    const Doubts doubts = doubtsOf(scene);  // 4/3 π 40³ m³ of 500 kg/m³, and 62.5 kg
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_EQ(doubts[0],
              "solid.c weighs 1.3e+08 kg, 2.1e+06 times the median of the bodies: lengths are in "
              "metres; give its size in metres, or less density");
}

TEST(StartDoubts, AreOfASeamLongerThanItsBodies) {
    SceneSpec scene;
    for (const char* name : {"a", "b"}) {
        ClothSpec cloth = support::cloth(name, 4);
        cloth.size = {1, 1};
        cloth.origin.x = name[0] == 'a' ? 0 : 1.5;
        scene.bodies.add(cloth);
    }
    SeamJoint seam;
    seam.b = "cloth.b@left";
    seam.over = 1;
    seam.a = "cloth.a@left";
    scene.joints = {seam};
    EXPECT_EQ(printed(World(scene).warnings()),
              (Doubts{"the seam \"cloth.a@left\" – \"cloth.b@left\" draws points together over 1.5 m, further "
                      "than its bodies are large (1.41 m): move the bodies together, or name other edges"}));
    seam.a = "cloth.a@right";
    scene.joints = {seam};
    EXPECT_EQ(printed(World(scene).warnings()), Doubts());
}

TEST(StartDoubts, AreOfAFigureThatNothingMoves) {
    SceneSpec scene;
    ColliderSpec stone;
    stone.name = "stone";
    stone.shape = "figure";
    stone.mesh = "models/stone.glb";
    auto data = std::make_shared<MeshData>();
    auto figure = std::make_shared<figure::Figure>();
    data->figure = figure;
    stone.meshData = data;
    scene.colliders = {stone};
    EXPECT_EQ(printed(figureDoubts(scene)), (Doubts{"collider.stone: stone.glb has neither a skin nor an animation: it "
                                                    "never moves, and shape = \"mesh\" costs less"}));
    figure->animations.emplace_back();
    EXPECT_EQ(printed(figureDoubts(scene)), Doubts());
}

// ω of a chain of masses m and springs k is at most 2 sqrt(k / m): here k = 1e9 N / 0.1 m, m = 0.1 kg.
TEST(StartDoubts, AreOfStepsWithoutNumber) {
    RopeSpec rope = support::rope("wire", {0, 2, 0}, {1, 2, 0}, 10);
    rope.dampingTime = 0;
    EXPECT_EQ(doubtsOf(ropeScene(rope)), Doubts());
    rope.stretch = 1e9;
    const Doubts doubts = doubtsOf(ropeScene(rope));
    ASSERT_EQ(doubts.size(), 1U);
    const double steps = 2 * std::sqrt(1e10 / 0.1) / 2 / 60;  // of leap-frog, which stands ω h < 2
    const double said = std::stod(doubts[0].substr(doubts[0].find("needs ") + 6));
    EXPECT_GE(said, steps) << doubts[0];
    EXPECT_LE(said, 1.5 * steps) << doubts[0];  // ends are lighter, and a tenth is for safety
}

TEST(StartDoubts, BlameTheBodyWhoseSpringSetsTheStep) {
    RopeSpec wire = support::rope("wire", {0, 2, 0}, {1, 2, 0}, 10);
    wire.source = {"s.toml", 7, 2};
    wire.dampingTime = 0;
    wire.stretch = 1e9;
    SceneSpec scene = ropeScene(wire);
    ClothSpec cloth = support::cloth("sheet", 4);
    cloth.origin = {1, 2, 0};
    scene.bodies.add(cloth);
    scene.joints = {support::weld("rope.wire@end", "cloth.sheet@top-left", 0.01)};
    const Doubts doubts = doubtsOf(scene);
    ASSERT_EQ(doubts.size(), 1U);
    EXPECT_TRUE(doubts[0].starts_with("s.toml:7:2: warning: cloth.sheet needs ")) << doubts[0];
    EXPECT_NE(doubts[0].find(" of rope.wire: take less stiffness or damping there"), std::string::npos) << doubts[0];
}

TEST(StartDoubts, AreOfAWeldThatJerksPointsTogether) {
    SceneSpec scene = ropeScene(support::rope("a", {0, 2, 0}, {1, 2, 0}, 10));
    scene.bodies.add(support::rope("b", {1.15, 2, 0}, {2.15, 2, 0}, 10));
    scene.joints = {support::weld("rope.a@end", "rope.b@start", 0.3)};
    World world(scene);
    EXPECT_NEAR(world.joints()[0].jump, 0.15, 1e-12);
    EXPECT_EQ(printed(world.warnings()),
              (Doubts{"the weld \"rope.a@end\" – \"rope.b@start\" jerks points together by 0.15 m, more than a "
                      "cell (0.1 m): move the bodies together, lower reach_m, or use kind = \"spring\""}));
    EXPECT_TRUE(startDoubts(world).size() == 1 &&
                startDoubts(world)[0].text.find("a strain of 1.5") != std::string::npos);
    scene.bodies.of<RopeSpec>()[1].start.x = 1.02;
    EXPECT_TRUE(World(scene).warnings().empty());
}

}  // namespace
}  // namespace taut::world
