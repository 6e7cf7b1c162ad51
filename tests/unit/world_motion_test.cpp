#include "taut/spec/private/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "taut/core/trig.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/private/rotation.h"

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

// Wherever in a tick it is asked for, and a step before and after it.
TEST(Motion, TheWayOfWhatIsCarriedIsThatOfItsCollider) {
    const collision::Pose from{{1, 2, 3}, rotationOf({0.3, -1, 2})}, to{{1.5, 2, 2}, rotationOf({1, 0.5, 2.5})};
    const mechanics::PosePath path = pathOf(from, to, 0.7, 60);
    const dvec3 offset(0.2, -0.4, 0.1);
    const auto placeAt = [&](double t) {
        const auto frame = path.at(t);
        return frame.place + frame.arm(offset);
    };
    for (const double u : {-0.5, 0.0, 0.25, 0.5, 0.9, 1.0, 1.5}) {
        const double t = 0.7 + u / 60, d = 1e-6;
        if (u >= 0 && u <= 1) {
            const collision::Pose pose = between(from, to, u);
            EXPECT_NEAR(glm::length(placeAt(t) - (pose.position + pose.rotation * offset)), 0, 5e-14) << u;  // of t
        }
        const auto frame = path.at(t);
        const dvec3 difference = (placeAt(t + d) - placeAt(t - d)) / (2 * d);  // to d² times the third derivative
        EXPECT_NEAR(glm::length(frame.velocityOf(frame.arm(offset)) - difference), 0, 1e-6) << u;
    }
}

}  // namespace
}  // namespace taut::world
