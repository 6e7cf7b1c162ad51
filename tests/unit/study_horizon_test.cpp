// How long a motion can be predicted depends on the question, and a resting scene has none.
#include "taut/study/horizon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/small_scenes.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/core/error.h"
#include "taut/study/scene_subject.h"

namespace taut::study {
namespace {

// A straight rope pushed together, which buckles to a side that its start alone decides.
world::SceneSpec bucklingRope() {
    world::SceneSpec scene;
    scene.world.gravity = {0, 0, 0};
    world::RopeSpec rope = support::rope("r", {0, 2, 0}, {0.1, 2, 0}, 8);
    rope.stretch = 500;
    rope.mass = 0.05;
    rope.velocity = {-5, 0, 0};
    rope.hold = {"start"};
    scene.bodies.add(rope);
    return scene;
}

std::string horizonRefusal(const world::SceneSpec& scene) {
    try {
        (void)makeSceneSubject(scene, "s");
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        return error.what();
    }
    return "";
}

TEST(StudyHorizon, OfASceneWithoutFreePointsThereIsNone) {
    world::SceneSpec scene;
    scene.file = "s.toml";
    EXPECT_NE(horizonRefusal(scene).find("s.toml: error: nothing in the scene can move"), std::string::npos);
    scene.bodies.add(support::cloth("c", 4));
    scene.bodies.of<world::ClothSpec>().back().hold = {"all"};
    EXPECT_NE(horizonRefusal(scene).find("nothing in the scene can move"), std::string::npos);
    scene.bodies.of<world::ClothSpec>().back().hold = {"top"};
    EXPECT_EQ(horizonRefusal(scene), "");
}

TEST(StudyHorizon, AShiftThatMovesNothingGrowsByOne) {
    const Horizon horizon = findHorizon(*makeSceneSubject(bucklingRope(), "s"), 0.2, 0.0);
    EXPECT_FALSE(horizon.isReached);
    EXPECT_EQ(horizon.growth, 1.0);
}

TEST(StudyHorizon, AShiftThatCannotGrowAThousandfoldWithinTheRopeIsNoChaos) {
    const auto subject = makeSceneSubject(bucklingRope(), "s");
    EXPECT_TRUE(findHorizon(*subject, 0.2, 1e-9).isReached);
    // A thousand times 1 mm are a metre; the rope, held at one end, is 0.1 m long.
    EXPECT_FALSE(findHorizon(*subject, 0.2, 1e-3).isReached);
}

}  // namespace
}  // namespace taut::study
