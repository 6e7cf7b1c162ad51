// Which springs are beyond their lengths, against a plain loop.
#include "taut/mechanics/private/spring_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics_random_net.h"

namespace taut::mechanics::test {
namespace {

// Of a net in runs and single springs, several chunks long; none, some and most of it beyond.
TEST(SpringWatch, FindsWhatAPlainLoopFindsWithEveryInstructionSet) {
    constexpr int points = 40000;
    const RandomNet net = randomNet(points, 100000, 3000, 1);
    const std::vector<PointRange> bodies{{0, 0}, {7, 0}, {5000, 33}, {20000, 0}};
    const SpringNetwork<double> network(points, bodies, net.springs);
    ASSERT_GT(network.chunks.size(), 1U);
    std::vector<double> x(3 * points);
    for (int i = 0; i < points; ++i)
        for (int p = 0; p < 3; ++p) x[p * points + i] = net.positions[i][p];
    const InstructionSetGuard guard;
    for (const double most : {9.0, 1.9, 0.5}) {
        std::vector<LengthLimits> limits(net.springs.size());
        std::vector<int> expected;
        for (std::size_t s = 0; s < limits.size(); ++s) {
            if (s % 4 == 0) continue;  // without
            limits[s].most = most;
            if (s % 2 == 1) limits[s].least = 0.2 / most;
            const glm::dvec3 d = net.positions[net.springs[s].b] - net.positions[net.springs[s].a];
            const double l = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
            if (l > limits[s].most || l < limits[s].least) expected.push_back(static_cast<int>(s));
        }
        for (const core::InstructionSet set : supportedSets()) {
            core::useInstructionSet(set);
            SpringWatch<double> watch;
            watch.set(network, limits);
            std::vector<int> found;
            watch.find(network, points, x.data(), found);
            EXPECT_EQ(found, expected) << core::nameOf(set);
            if (expected.empty()) continue;
            watch.change(network, expected[0], {0.0, 10.0});
            found.clear();
            watch.find(network, points, x.data(), found);
            EXPECT_EQ(found.size() + 1, expected.size());
        }
    }
}

}  // namespace
}  // namespace taut::mechanics::test
