#include "taut/live/mouse_hand.h"

#include <gtest/gtest.h>

namespace taut::live {
namespace {

using Kinds = std::vector<std::string_view>;

Kinds kindsOf(const world::Specs<world::ActionSpec>& deeds) {
    Kinds all;
    for (const world::ActionSpec& deed : deeds) all.push_back(deed.kind());
    return all;
}

TEST(MouseHand, MovesAtMostEveryThirdTickAndOnlyWhenLedElsewhere) {
    MouseHand hand("mouse", 60.0);
    hand.grab("cloth.a@#3", 0.1, 200.0, 0.3, {0.0, 1.0, 0.0});
    std::vector<std::int64_t> moves;
    for (std::int64_t tick = 10; tick < 40; ++tick) {
        if (tick < 30) hand.leadTo({0.01 * static_cast<double>(tick), 1.0, 0.0});
        const auto deeds = hand.deedsAt(tick);
        for (const world::MoveAction& move : deeds.of<world::MoveAction>()) {
            moves.push_back(tick);
            EXPECT_DOUBLE_EQ(move.over, 0.05);
            EXPECT_EQ(move.ease, world::Ease::linear);
        }
    }
    ASSERT_EQ(moves.size(), 8U);  // ticks 10, 13, … 28 and the rest of the way at 31
    for (std::size_t i = 1; i < moves.size(); ++i) EXPECT_EQ(moves[i] - moves[i - 1], MouseHand::moveTicks);
}

TEST(MouseHand, ItsActionsAreRoundedAsInAFile) {
    MouseHand hand("mouse", 72.0);
    hand.grab("cloth.a@#3", 0.123456, 200.0, 0.3, {0.0, 0.0, 0.0});
    hand.leadTo({0.12345678, -0.0001, 1.0 / 9.0});
    const auto deeds = hand.deedsAt(7);
    ASSERT_EQ(deeds.size(), 2U);
    EXPECT_EQ(deeds[0].t, 0.097222);  // 7/72
    EXPECT_EQ(deeds.of<world::GrabAction>()[0].radius, 0.123);
    const world::MoveAction& move = deeds.of<world::MoveAction>()[0];
    EXPECT_EQ(*move.to, glm::dvec3(0.123, 0.0, 0.111));
    EXPECT_EQ(move.over, 0.041667);  // 3/72
}

TEST(MouseHand, IsNoFasterThanAnArm) {
    MouseHand hand("mouse", 60.0);
    hand.grab("cloth.a@#3", 0.1, 200.0, 0.3, {0.0, 0.0, 0.0});
    hand.leadTo({1.0, 0.0, 0.0});
    std::vector<double> places;
    for (std::int64_t tick = 0; tick < 30; ++tick) {
        const auto deeds = hand.deedsAt(tick);
        for (const world::MoveAction& move : deeds.of<world::MoveAction>()) places.push_back(move.to->x);
    }
    EXPECT_EQ(places, (std::vector{0.25, 0.5, 0.75, 1.0}));  // 5 m/s for three ticks each
}

TEST(MouseHand, LetsGoBeforeItTakesAgain) {
    MouseHand hand("mouse", 60.0);
    hand.grab("cloth.a@#3", 0.1, 200.0, 0.3, {0.0, 1.0, 0.0});
    EXPECT_EQ(kindsOf(hand.deedsAt(0)), (Kinds{"grab"}));
    hand.release();
    hand.grab("cloth.a@#9", 0.1, 200.0, 0.3, {0.0, 1.0, 0.0});
    EXPECT_EQ(kindsOf(hand.deedsAt(1)), (Kinds{"release", "grab"}));
    hand.release();
    EXPECT_EQ(kindsOf(hand.deedsAt(2)), (Kinds{"release"}));
    EXPECT_TRUE(hand.deedsAt(3).empty());
}

TEST(MouseHand, AClickBetweenTwoTicksIsNothing) {
    MouseHand hand("mouse", 60.0);
    hand.grab("cloth.a@#3", 0.1, 200.0, 0.3, {0.0, 1.0, 0.0});
    hand.release();
    EXPECT_TRUE(hand.deedsAt(0).empty());
    EXPECT_FALSE(hand.isHolding());
}

}  // namespace
}  // namespace taut::live
