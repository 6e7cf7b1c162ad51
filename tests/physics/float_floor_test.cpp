// Where shorter steps stop helping: rounding in single precision.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/network.h"
#include "taut/mechanics/builders.h"

namespace taut::test::float_floor {
namespace {

constexpr double duration = 0.25;  // [s]
const dvec3 gravity(0, -9.81, 0);

// A cloth of 1 m held by its upper edge and let swing.
mechanics::Model swinging() {
    mechanics::Model model = mechanics::buildCloth(
        {.down = {0, -0.8, 0.6}, .cells = {16, 16}, .material = {0.2, 200.0, 100.0, 1.0, 0.0, 0.5, {}}});
    hold(model, "top");
    return model;
}

template <class Real>
std::vector<dvec3> endOf(const char* method, int steps) {
    NetworkOf<Real> network(swinging(), method, duration / steps, gravity);
    network.step(steps);
    return network.positions();
}

double rms(const std::vector<dvec3>& x, const std::vector<dvec3>& ought) {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += glm::dot(x[i] - ought[i], x[i] - ought[i]);
    return std::sqrt(sum / static_cast<double>(x.size()));
}

// A step adds h v to x and h a to v. Single precision keeps 24 bits, so each sum is rounded by up to 3e-8 of x (1 m)
// and of v (2 m/s), and the shorter the step, the more sums there are: T/h of them leave 3e-8 √(T/h) when they fall out
// at random, which is 1e-6 m at 2.5e-4 s, and more where a slow v or a resting x is rounded the same way at every step.
// The method's own error falls with h². The sum of the two is least near h = 2.5e-4 s, at about 1e-6 m; a
// step that short serves no picture. Double precision rounds 5e8 times finer: there the method's own
// error goes on falling.
TEST(FloatFloor, SinglePrecisionIsBestNearAQuarterMillisecondWhileDoubleGoesOn) {
    const std::vector<dvec3> ought = endOf<double>("rk4", 4000);  // ω h = 0.2 at most, in fourth order: 1e-12 m
    constexpr int first = 250, count = 7;                         // h = 1 ms, halved six times
    double single[count], twice[count];
    int best = 0;
    for (int i = 0; i < count; ++i) {
        single[i] = rms(endOf<float>("leapfrog", first << i), ought);
        twice[i] = rms(endOf<double>("leapfrog", first << i), ought);
        if (single[i] < single[best]) best = i;
    }
    EXPECT_NEAR(best, 2, 1);  // 2.5e-4 s, give or take a halving
    EXPECT_GT(single[best], 1e-7);
    EXPECT_LT(single[best], 2e-6);
    // Up to there both are the same, within the rounding so far; at the shortest step single precision is worse
    // again by several times (measured: 9), and far from double.
    EXPECT_NEAR(single[0] / twice[0], 1.0, 0.05);
    EXPECT_GT(single[count - 1], 3.0 * single[best]);
    EXPECT_GT(single[count - 1], 300.0 * twice[count - 1]);
    // ω h = 1.2 at 1 ms: the next term is felt at first.
    for (int i = 1; i < count; ++i) EXPECT_NEAR(std::log2(twice[i - 1] / twice[i]), 2.0, 0.1) << "step " << i;
}

}  // namespace
}  // namespace taut::test::float_floor
