// Expressions without a comparison, as columns of a table.
#include "taut/check/figures.h"

#include <cmath>

#include "unit/check_support.h"

namespace taut::check {
namespace {

TEST(CheckFigures, ExpressionsAreColumnsInTheirOrder) {
    const world::World world(sceneOf(balls));
    Figures figures =
        Figures::parse("position(net.balls@b).x * 2, position(net.balls@a), distance(net.balls@a, [1, 2, 0])");
    EXPECT_EQ(figures.names(), (std::vector<std::string>{"position(net.balls@b).x * 2", "position(net.balls@a).x",
                                                         "position(net.balls@a).y", "position(net.balls@a).z",
                                                         "distance(net.balls@a, [1, 2, 0])"}));
    EXPECT_EQ(figures.of(world), (std::vector<double>{10.0, 1.0, 2.0, 3.0, 3.0}));
    EXPECT_EQ(figures.mentions().size(), 3U);
}

TEST(CheckFigures, MissingBodiesGiveNoNumber) {
    world::World world(sceneOf(balls + "[[at]]\nt = 0.1\ndo = \"spawn\"\ntarget = \"net.balls\"\n"));
    Figures figures = Figures::parse("position(net.balls@a).x");
    EXPECT_TRUE(std::isnan(figures.of(world)[0]));
    play(world, 10);
    EXPECT_NEAR(figures.of(world)[0], 1.0, 1e-9);
}

TEST(CheckFigures, AFaultNamesItsPlaceInTheText) {
    for (const auto& [text, at] : {std::pair("", 0U), {"time < 3", 5U}, {"time,", 5U}, {"sped(cloth.a)", 0U}}) {
        try {
            Figures::parse(text);
            ADD_FAILURE() << text;
        } catch (const ClaimError& fault) {
            EXPECT_EQ(fault.at, at) << text << ": " << fault.what();
        }
    }
}

}  // namespace
}  // namespace taut::check
