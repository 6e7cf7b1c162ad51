// Freezing: an island that diverges is kept as it last was, and nothing else is changed by that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/small_scenes.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

// A calm rope, and a cloth whose step is several times the limit unless it is left out.
SceneSpec calmAndWild(bool wild = true) {
    SceneSpec scene;
    scene.bodies.add(support::rope("calm", {5, 3, 0}, {6, 3, 0}, 8));
    scene.bodies.of<RopeSpec>()[0].hold = {"start"};
    ClothSpec cloth = support::cloth("wild", 10);
    cloth.hold = {"left"};
    cloth.jitter = 1e-3;
    cloth.solver.dt = 1.0 / 240.0;
    if (wild) scene.bodies.add(cloth);
    scene.solver.onDivergence = OnDivergence::freeze;
    return scene;
}

std::vector<dvec3> placesOfKind(World& world, const std::string& kind) {
    std::vector<dvec3> positions;
    world.registry().each<Identity, BodyPart>([&](ecs::Entity entity, const Identity& identity, const BodyPart&) {
        if (identity.kind == kind) positions = world.positions(entity);
    });
    return positions;
}

// Advances until something is frozen; the number of ticks, or -1 if nothing was in ten seconds.
int untilFrozen(World& world) {
    for (int tick = 1; tick <= 600; ++tick) {
        EXPECT_FALSE(world.advance());
        if (!world.frozen().empty()) return tick;
    }
    return -1;
}

TEST(Freeze, ADivergedBodyStaysBitForBitWhereItWas) {
    World world(calmAndWild());
    ASSERT_GT(untilFrozen(world), 0);
    const std::vector<dvec3> kept = placesOfKind(world, "cloth");
    for (int i = 0; i < 60; ++i) ASSERT_FALSE(world.advance());
    EXPECT_EQ(placesOfKind(world, "cloth"), kept);
    EXPECT_EQ(world.frozen().size(), 1U);
}

TEST(Freeze, TheOthersGoOnAsIfTheyWereAlone) {
    World with(calmAndWild()), without(calmAndWild(false));
    ASSERT_GT(untilFrozen(with), 0);
    for (int i = 0; i < 60; ++i) ASSERT_FALSE(with.advance());
    while (without.tick() < with.tick()) ASSERT_FALSE(without.advance());
    EXPECT_EQ(placesOfKind(with, "rope"), placesOfKind(without, "rope"));
}

// The rest state is 1/10 m a cell: the kept state is still a cloth, torn but not scattered.
TEST(Freeze, KeptPlacesAreWithinTheStrainThatWasSet) {
    for (const double strain : {0.3, 1.0, 2.0}) {
        SceneSpec scene = calmAndWild();
        scene.solver.freezeStrain = strain;
        World world(scene);
        ASSERT_GT(untilFrozen(world), 0);
        const std::vector<dvec3> x = placesOfKind(world, "cloth");
        double largest = 0;
        for (std::size_t row = 0; row < 11; ++row)
            for (std::size_t i = 0; i < 10; ++i)
                largest = std::max(largest, glm::length(x[11 * row + i + 1] - x[11 * row + i]) / 0.1 - 1.0);
        EXPECT_LE(largest, strain * (1 + 1e-5)) << strain;  // rounding of single precision
        EXPECT_GT(largest, 0.01) << strain;                 // and it was on its way: at rest it is below 0.001
        EXPECT_GT(world.frozen()[0].divergence.time, world.frozen()[0].time);
    }
}

TEST(Freeze, ALaxerStrainFreezesLater) {
    double before = 0;
    for (const double strain : {0.2, 1.0, 50.0}) {
        SceneSpec scene = calmAndWild();
        scene.solver.freezeStrain = strain;
        World world(scene);
        ASSERT_GT(untilFrozen(world), 0);
        EXPECT_GE(world.frozen()[0].divergence.time, before);
        before = world.frozen()[0].divergence.time;
    }
}

TEST(Freeze, ABodyThatDoesNotDivergeIsTheSameAsWithoutFreezing) {
    SceneSpec scene = calmAndWild(false);
    World freezing(scene);
    scene.solver.onDivergence = OnDivergence::stop;
    World stopping(scene);
    for (int i = 0; i < 60; ++i) {
        ASSERT_FALSE(freezing.advance());
        ASSERT_FALSE(stopping.advance());
    }
    EXPECT_EQ(freezing.stateHash(), stopping.stateHash());
}

TEST(Freeze, TheHashIsTheSameForAnyNumberOfThreads) {
    World one(calmAndWild(), {.threads = 1}), five(calmAndWild(), {.threads = 5});
    for (int i = 0; i < 120; ++i) {
        ASSERT_FALSE(one.advance());
        ASSERT_FALSE(five.advance());
        ASSERT_EQ(one.stateHash(), five.stateHash()) << i;
    }
    EXPECT_EQ(one.frozen().size(), 1U);
}

TEST(Freeze, SaysWhichBodyWhyAndWhen) {
    World world(calmAndWild());
    const int tick = untilFrozen(world);
    ASSERT_GT(tick, 0);
    const FrozenIsland frozen = world.frozen()[0];
    EXPECT_EQ(frozen.name, "cloth.wild");
    EXPECT_EQ(frozen.bodies, std::vector<std::string>{"cloth.wild"});
    EXPECT_EQ(frozen.divergence.tick, tick - 1);
    EXPECT_EQ(frozen.divergence.body, "cloth.wild");
    EXPECT_GE(frozen.divergence.point, 0);
    EXPECT_NE(frozen.divergence.message.find("has a spring with a strain of"), std::string::npos)
        << frozen.divergence.message;
    const std::vector<std::string> warnings = printed(world.warnings());
    EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                            [](const std::string& w) {
                                return w.starts_with("cloth.wild diverged at t = ") &&
                                       w.ends_with("the rest continues");
                            }),
              1);
}

TEST(Freeze, MetricsLeaveOutWhatIsFrozen) {
    World with(calmAndWild()), without(calmAndWild(false));
    ASSERT_GT(untilFrozen(with), 0);
    while (without.tick() < with.tick()) ASSERT_FALSE(without.advance());
    EXPECT_EQ(with.metrics().kinetic, without.metrics().kinetic);
    EXPECT_EQ(with.metrics().elastic, without.metrics().elastic);
}

TEST(Freeze, PicturesMarkTheBodyAndItsLabelSaysWhen) {
    SceneSpec scene = calmAndWild();
    LabelSpec label;
    label.name = "method";
    label.of = "cloth.*";
    scene.labels = {label};
    World world(scene);
    const auto dulledIn = [&](const view::FrameView& view) {
        std::vector<std::string> names;
        for (const view::Surface& surface : view.surfaces)
            if (surface.dulled > 0) names.push_back(surface.name);
        return names;
    };
    EXPECT_TRUE(dulledIn(world.view(false)).empty());
    ASSERT_GT(untilFrozen(world), 0);
    const view::FrameView view = world.view(false);
    EXPECT_EQ(dulledIn(view), std::vector<std::string>{"cloth.wild"});
    const auto says = [&](const std::string& text) {
        return std::any_of(view.labels.begin(), view.labels.end(),
                           [&](const view::Label& l) { return l.text.starts_with(text); });
    };
    char when[40];
    std::snprintf(when, sizeof when, "diverged at %.2f s", world.frozen()[0].divergence.time);
    EXPECT_TRUE(says(when));
}

TEST(Labels, StandWhereTheyAreToldAndHangAboveHeldPoints) {
    SceneSpec scene = calmAndWild();
    LabelSpec onScreen, inWorld, ofCloth, ofRope;
    onScreen.text = "a";
    onScreen.screen = dvec2(0.25, 0.75);
    onScreen.align = Align::left;
    inWorld.text = "b";
    inWorld.at = dvec3(1, 2, 3);
    ofCloth.of = "cloth.wild";
    ofRope.of = "rope.calm";
    ofRope.text = "c";
    scene.labels = {onScreen, inWorld, ofCloth, ofRope};
    const std::vector<view::Label> labels = World(scene).view(false).labels;
    ASSERT_EQ(labels.size(), 4U);
    EXPECT_EQ(labels[0].screen, glm::vec2(0.25F, 0.75F));
    EXPECT_EQ(labels[0].align, view::Align::left);
    EXPECT_FALSE(labels[0].at);
    EXPECT_EQ(labels[1].at, glm::vec3(1, 2, 3));
    EXPECT_EQ(labels[2].text, "leap-frog");
    // The left edge is held: x = 0, from y = 2 downwards. The rope is held at its start.
    EXPECT_NEAR(labels[2].at->x, 0.0F, 1e-6F);
    EXPECT_NEAR(labels[2].at->y, 2.0F, 1e-6F);
    EXPECT_EQ(labels[3].text, "c");
    EXPECT_EQ(labels[3].at, glm::vec3(5, 3, 0));
}

TEST(Labels, ACaptionIsShownFromItsFirstTimeToJustBeforeItsLast) {
    LabelSpec caption;
    caption.text = "a";
    caption.screen = dvec2(0.5, 0.9);
    EXPECT_TRUE(caption.isShown(0.0));
    caption.from = 1.0;
    caption.to = 2.0;
    EXPECT_FALSE(caption.isShown(0.99));
    EXPECT_TRUE(caption.isShown(1.0));
    EXPECT_FALSE(caption.isShown(2.0));
    SceneSpec scene = calmAndWild();
    scene.labels = {caption};
    EXPECT_TRUE(World(scene).view(false).labels.empty());  // at the start
}

}  // namespace
}  // namespace taut::world
