#include "taut/spec/targets.h"

#include <gtest/gtest.h>

#include "taut/mechanics/builders.h"

namespace taut::world {
namespace {

TEST(Targets, SplitIntoKindNameAndSelector) {
    const Target target = parseTarget("cloth.row.2@top-left");
    EXPECT_EQ(target.kind, "cloth");
    EXPECT_EQ(target.name, "row.2");
    EXPECT_EQ(target.selector, "top-left");
    EXPECT_EQ(parseTarget("rope.rail").selector, "");
}

class Selectors : public testing::Test {
  protected:
    // 4 by 2 cells: five points a row, three rows.
    mechanics::Model grid = [] {
        mechanics::ClothShape shape;
        shape.cells = {4, 2};
        return mechanics::buildCloth(shape);
    }();
    mechanics::Model line = mechanics::buildRope({});  // 20 segments
};

TEST_F(Selectors, NameGroups) {
    EXPECT_EQ(selectPoints(grid, "left"), (std::vector<int>{0, 5, 10}));
    EXPECT_EQ(selectPoints(grid, "@bottom-right"), (std::vector<int>{14}));
    EXPECT_EQ(selectPoints(grid, "").size(), 15U);
    EXPECT_EQ(selectPoints(line, "ends"), (std::vector<int>{0, 20}));
}

TEST_F(Selectors, NameSinglePoints) {
    EXPECT_EQ(selectPoints(grid, "#7"), (std::vector<int>{7}));
    EXPECT_EQ(selectPoints(grid, "(0.5, 1)"), (std::vector<int>{12}));
    EXPECT_EQ(selectPoints(grid, "(0.9,0)"), (std::vector<int>{4}));
    EXPECT_EQ(selectPoints(line, "50%"), (std::vector<int>{10}));
    EXPECT_EQ(selectPoints(line, "100%"), (std::vector<int>{20}));
}

// Cells of 0.25 by 0.5 m.
TEST_F(Selectors, NameWhatIsWithinARadiusOfAPlace) {
    EXPECT_EQ(selectPoints(grid, "(0.5,0.5,0.3)"), (std::vector<int>{6, 7, 8}));
    EXPECT_EQ(selectPoints(grid, "(0,0,0.5)"), (std::vector<int>{0, 1, 2, 5}));
    EXPECT_EQ(selectPoints(grid, "(0.4,0.6,0)"), (std::vector<int>{7}));  // the nearest, none is nearer than 0.1
}

TEST_F(Selectors, NameNothingWhereThereIsNothing) {
    for (const char* selector :
         {"#15", "#-1", "#1.5", "#", "(1.1,0)", "(0.5)", "(0.5,0.5,r)", "(,)", "101%", "-1%", "%", "middle"})
        EXPECT_TRUE(selectPoints(grid, selector).empty()) << selector;
    EXPECT_TRUE(selectPoints(line, "(0.5,0.5)").empty());  // a rope has no grid
}

}  // namespace
}  // namespace taut::world
