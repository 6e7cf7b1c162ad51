#include <gtest/gtest.h>

#include "mechanics_lattice_facts.h"
#include "taut/mechanics/builders.h"

namespace taut::mechanics {
namespace {

TEST(NetBuilder, IsThePointsAndSpringsAsGiven) {
    const std::vector<NetPoint> points = {{"hook", {0, 2, -0.0}, {}, 1.0, 0.0, true},
                                          {"bob", {0, 1.25, 0}, {0.5, 0, 0}, 0.3, 0.1, false}};
    const std::vector<NetSpring> springs = {{"hook", "bob", 40.0, std::nullopt, 0.01}, {"bob", "hook", 7.0, 0.5, 0.0}};
    const Model model = buildNet(points, springs);
    EXPECT_EQ(test::brokenRule(model), "");
    EXPECT_TRUE(model.held[0]);
    EXPECT_FALSE(model.held[1]);
    EXPECT_EQ(model.masses[1], 0.3);
    EXPECT_EQ(model.dragRates[1], 0.1);
    EXPECT_EQ(model.velocities[1], glm::dvec3(0.5, 0, 0));
    ASSERT_EQ(model.springs.size(), 2U);
    EXPECT_EQ(model.springs[0].a, 0);
    EXPECT_EQ(model.springs[0].b, 1);
    EXPECT_EQ(model.springs[0].restLength, 0.75);
    EXPECT_EQ(model.springs[0].dampingTime, 0.01);
    EXPECT_EQ(model.springs[1].a, 1);
    EXPECT_EQ(model.springs[1].restLength, 0.5);
    EXPECT_EQ(model.groups.at("bob"), std::vector<int>{1});
    EXPECT_EQ(model.groups.at("all"), (std::vector<int>{0, 1}));
}

TEST(NetBuilderDeathTest, ExpectsNamesThatExist) {
    const std::vector<NetPoint> points = {{"a"}, {"b"}};
    const std::vector<NetSpring> springs = {{"a", "c", 1.0, 1.0, 0.0}};
    EXPECT_DEATH(buildNet(points, springs), "indexOf");
}

}  // namespace
}  // namespace taut::mechanics
