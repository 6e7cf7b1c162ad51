// The report of bodies that touch: contacts, crossings, and since when.
#include <gtest/gtest.h>

#include "support/timelines.h"
#include "taut/advice/contact_doubts.h"
#include "taut/advice/rehearsal.h"
#include "taut/bodies/net.h"
#include "taut/world/private/body_surfaces.h"

namespace taut::world {
namespace {

using support::action;

// Two triangles of a square metre in the plane y = 0, which nothing moves.
ClothSpec floor(Touch touch) {
    ClothSpec cloth;
    cloth.name = "floor";
    cloth.cells = {1, 1};
    cloth.down = {0, 0, 1};
    cloth.hold = {"all"};
    cloth.touch = touch;
    cloth.thickness = 0.05;
    return cloth;
}

// A ball 0.1 m above the floor, and a line of one edge, held, which may go through it.
SceneSpec scene(bool goesThrough) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.bodies.add(floor(Touch::others));
    NetSpec ball;
    ball.name = "ball";
    ball.points.resize(1);
    ball.points[0].position = {0.7, 0.1, 0.3};
    ball.touch = Touch::others;
    ball.thickness = 0.05;
    scene.bodies.add(ball);
    RopeSpec line = support::rope("line", {0.2, goesThrough ? -0.2 : 0.2, 0.5}, {0.2, 0.5, 0.5}, 1);
    line.hold = {"all"};
    line.touch = Touch::others;
    scene.bodies.add(line);
    return scene;
}

TEST(ContactReport, ContactsAndCrossingsCountForBothBodies) {
    World world(scene(true));
    EXPECT_EQ(world.metrics().crossings, 1);
    EXPECT_FALSE(world.hasTouched());
    support::run(world, 10);
    EXPECT_EQ(world.metrics().bodyContacts, 1);
    EXPECT_EQ(world.metrics().crossings, 1);
    for (const auto& [name, contacts, crossings] :
         {std::tuple{"net.ball", 1, 0}, {"cloth.floor", 1, 1}, {"rope.line", 0, 1}}) {
        EXPECT_EQ(world.metrics(name).bodyContacts, contacts) << name;
        EXPECT_EQ(world.metrics(name).crossings, crossings) << name;
    }
    EXPECT_TRUE(world.hasTouched());
}

TEST(ContactReport, SaysOnceSinceWhenBodiesCross) {
    SceneSpec late = scene(true);
    late.actions = {action<SpawnAction>(0.1, "rope.line")};
    World world(late);
    support::run(world, 6);
    EXPECT_TRUE(world.warnings().empty());
    support::run(world, 6);
    EXPECT_EQ(printed(world.warnings()),
              (std::vector<std::string>{"cloth.floor and rope.line have crossed each other since "
                                        "0.10 s (1 edge); they are being drawn apart"}));
}

// Nothing holds the line: it is drawn out of the floor, at 0.3 m/s.
TEST(ContactReport, SaysUntilWhenAndHowOftenBodiesCrossed) {
    SceneSpec through = scene(true);
    through.bodies.of<RopeSpec>()[0].hold.clear();
    World world(through);
    support::run(world, 1);
    EXPECT_EQ(printed(world.warnings()),
              (std::vector<std::string>{"cloth.floor and rope.line have crossed each other since "
                                        "0.00 s (1 edge); they are being drawn apart"}));
    for (int i = 0; i < 90 && world.metrics().crossings > 0; ++i) support::run(world, 1);
    ASSERT_EQ(world.metrics().crossings, 0);
    char until[40];
    std::snprintf(until, sizeof until, "%.2f s", world.time());
    support::run(world, 2);
    const std::string expected = std::string("cloth.floor and rope.line crossed each other from 0.00 s to ") + until +
                                 " (1 edge); they have come apart";
    EXPECT_EQ(printed(world.warnings()), std::vector<std::string>{expected});
    World restored(through);
    restored.restore(world.save());
    EXPECT_EQ(printed(restored.warnings()), std::vector<std::string>{expected});
}

// Two triangles with a corner in common, an edge of one through the other.
TEST(ContactReport, KnowsWhatCrossesItself) {
    SceneSpec scene;
    ClothSpec cloth = floor(Touch::all);
    auto mesh = std::make_shared<MeshData>();
    mesh->positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0.2, 0.5, 0.2}, {0.2, -0.4, 0.2}};
    mesh->triangles = {{0, 1, 2}, {1, 3, 4}};
    cloth.meshData = mesh;
    scene.bodies.add(cloth);
    World world(scene);
    const std::string doubt = printed(touchDoubts(world).at(0));
    EXPECT_EQ(doubt.find("cloth.floor goes through itself as it starts: 1 edge, the deepest by 0.4 m at [0.2, 0, 0.2]"),
              0U)
        << doubt;
    support::run(world, 1);
    EXPECT_EQ(printed(world.warnings()),
              (std::vector<std::string>{"cloth.floor has crossed itself since 0.00 s (1 edge); it is "
                                        "being drawn apart"}));
}

// Springs of the line and the floor, besides the marks of the contacts between them.
TEST(ContactReport, TheDebugViewMarksContactsAndCrossings) {
    World through(scene(true)), beside(scene(false));
    support::run(beside, 1);
    const view::Marks apart = beside.view(true).marks;
    support::run(through, 10);
    const view::Marks marks = through.view(true).marks;
    ASSERT_EQ(marks.dots.size(), apart.dots.size() + 1);
    ASSERT_EQ(marks.lines.size(), apart.lines.size());
    EXPECT_EQ(marks.dots[marks.dots.size() - 2].at.y, 0.05F);  // a contact: midway between the ball and the floor
    EXPECT_EQ(marks.lines.back().from.y, 0.0F);
    EXPECT_EQ(marks.lines.back().to.y, 0.1F);
    EXPECT_EQ(marks.dots.back().at, glm::vec3(0.2F, 0.0F, 0.5F));  // where the line goes through
}

TEST(ContactReport, GoesOnInARestoredWorld) {
    World through(scene(true));
    support::run(through, 10);
    const std::vector<std::byte> saved = through.save();
    World restored(scene(true));
    restored.restore(saved);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(restored.warnings(), through.warnings());
        EXPECT_EQ(restored.metrics().bodyContacts, through.metrics().bodyContacts);
        EXPECT_EQ(restored.metrics().crossings, through.metrics().crossings);
        EXPECT_EQ(restored.view(true).marks.lines.size(), through.view(true).marks.lines.size());
        EXPECT_EQ(restored.stateHash(), through.stateHash());
        support::run(through, 1);
        support::run(restored, 1);
    }
}

// A cloth falls onto the floor in one of two runs that somebody looks at after each tick.
TEST(ContactReport, LookingChangesNothing) {
    SceneSpec falling = scene(true);
    ClothSpec cloth = support::cloth("sheet", 4);
    cloth.origin = {0.1, 0.15, 0.1};
    cloth.down = {0, 0, 1};
    cloth.touch = Touch::all;
    cloth.thickness = 0.05;
    falling.bodies.add(cloth);
    World looked(falling), alone(falling);
    for (int i = 0; i < 30; ++i) {
        (void)looked.metrics();
        (void)looked.view(true);
        support::run(looked, 1);
        support::run(alone, 1);
    }
    EXPECT_EQ(looked.stateHash(), alone.stateHash());
    EXPECT_GT(looked.metrics("cloth.sheet").bodyContacts, 0);
}

TEST(TouchDoubts, AreOfWhatGoesThroughAnotherOfThickLayersAndOfTouchAlone) {
    SceneSpec through = scene(true);
    World world(through);
    EXPECT_EQ(printed(touchDoubts(world)),
              (std::vector<std::string>{"cloth.floor and rope.line go through each other as they start: 1 edge, the "
                                        "deepest by 0.2 m at [0.2, 0, 0.5]; they will be drawn apart, start them "
                                        "further off"}));
    SceneSpec thick;
    thick.bodies.add(floor(Touch::all));
    thick.bodies.of<ClothSpec>()[0].thickness = 0.501;
    World layers(thick);
    EXPECT_EQ(printed(touchDoubts(layers)),
              (std::vector<std::string>{"cloth.floor: layers of it lie further apart (1 m, twice its thickness) than "
                                        "its cells are wide (1 m); give thickness <= 0.5"}));
    SceneSpec lone = scene(false);
    for (BodySpec& body : lone.bodies)
        if (body.name != "floor") body.touch = Touch::nothing;
    World one(lone);
    EXPECT_EQ(printed(touchDoubts(one)),
              (std::vector<std::string>{"cloth.floor has touch = \"others\", but there is no other that touches: "
                                        "nothing will come of it; give another body touch too, or this one touch = "
                                        "\"all\""}));
    EXPECT_EQ(rehearse(lone).warnings.size(), 2U);  // the ball falls through it, too
    lone.colliders = {support::ground()};           // points meet a plane as faces do
    World onPlane(lone);
    EXPECT_EQ(touchDoubts(onPlane).size(), 1U);
    lone.colliders = {support::ball("post", {0, -1, 0}, 0.1)};
    World overPost(lone);
    EXPECT_TRUE(touchDoubts(overPost).empty());
    lone.colliders.clear();
    lone.bodies.of<NetSpec>()[0].touch = Touch::others;
    EXPECT_TRUE(rehearse(lone).warnings.empty());
}

}  // namespace
}  // namespace taut::world
