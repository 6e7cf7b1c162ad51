// The names of points that scenes are checked against before anything is built are the names that the builders give.
#include <gtest/gtest.h>

#include <algorithm>

#include "taut/mechanics/builders.h"

namespace taut::mechanics::groups_test {
namespace {

void expectGroups(const Model& model, std::vector<std::string> names) {
    names.push_back("all");
    std::sort(names.begin(), names.end());
    std::vector<std::string> given;
    for (const auto& [name, points] : model.groups) given.push_back(name);
    EXPECT_EQ(given, names);
}

TEST(BuilderGroups, AreThoseThatTheirListsName) {
    expectGroups(buildRope({}), ropeGroups());
    expectGroups(buildBlock({}), blockGroups());
    expectGroups(buildCloth({}), clothGroups());
    ClothShape round;
    round.isRound = true;
    expectGroups(buildCloth(round), clothGroups(true));
    MeshClothShape square;
    square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    expectGroups(buildMeshCloth(square), meshClothGroups());
}

}  // namespace
}  // namespace taut::mechanics::groups_test
