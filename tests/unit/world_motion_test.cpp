#include "taut/world/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "taut/core/trig.h"
#include "taut/world/rotation.h"

namespace taut::world {
namespace {

TEST(Motion, EasesBeginAndEndWhereTheyShould) {
    for (Ease ease : {Ease::linear, Ease::smooth, Ease::in, Ease::out}) {
        EXPECT_EQ(eased(ease, 0.0), 0.0);
        EXPECT_EQ(eased(ease, 1.0), 1.0);
    }
    EXPECT_EQ(eased(Ease::smooth, 0.5), 0.5);
    EXPECT_EQ(eased(Ease::in, 0.5), 0.25);
    EXPECT_EQ(eased(Ease::out, 0.5), 0.75);
    EXPECT_EQ(eased(Ease::hold, 0.99), 0.0);
}

TEST(Motion, KeyframesHoldBeforeTheFirstAndAfterTheLast) {
    ColliderSpec spec;
    spec.keys = {{1.0, {1, 0, 0}, {0, 0, 0}, Ease::linear}, {2.0, {3, 0, 0}, {0, 0, core::pi}, Ease::linear}};
    EXPECT_EQ(poseAt(spec, 0.0).position, dvec3(1, 0, 0));
    EXPECT_EQ(poseAt(spec, 1.25).position, dvec3(1.5, 0, 0));
    EXPECT_EQ(poseAt(spec, 5.0).position, dvec3(3, 0, 0));
    // Half way to half a turn about z takes x to y.
    const dvec3 x = rotated(poseAt(spec, 1.5).rotation, {1, 0, 0});
    EXPECT_NEAR(x.y, 1.0, 1e-15);
}

TEST(Motion, RotationsGoAboutXThenYThenZ) {
    const double quarter = 0.5 * core::pi;
    const dvec3 v = rotated(rotationOf({quarter, quarter, 0.0}), {0, 1, 0});  // y to z, then z to x
    EXPECT_NEAR(v.x, 1.0, 1e-15);
    EXPECT_NEAR(glm::dot(v, v), 1.0, 1e-15);
}

TEST(Motion, AnOrbitReturnsAfterItsPeriodAndKeepsItsDistance) {
    CameraSpec spec;
    spec.eye = {3, 2, 0};
    spec.target = {0, 1, 0};
    spec.orbitPeriod = 8.0;
    const view::Camera quarter = cameraAt(spec, 2.0), whole = cameraAt(spec, 8.0);
    EXPECT_NEAR(quarter.eye.x, 0.0F, 1e-6F);
    EXPECT_NEAR(std::abs(quarter.eye.z), 3.0F, 1e-6F);
    EXPECT_NEAR(whole.eye.x, 3.0F, 1e-6F);
    EXPECT_EQ(quarter.eye.y, 2.0F);
}

}  // namespace
}  // namespace taut::world
