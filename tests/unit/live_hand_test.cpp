#include "taut/live/hand.h"

#include <gtest/gtest.h>

namespace taut::live {
namespace {

using world::Do;

std::vector<Do> whatOf(const std::vector<world::ActionSpec>& deeds) {
    std::vector<Do> all;
    for (const world::ActionSpec& deed : deeds) all.push_back(deed.what);
    return all;
}

TEST(Hand, MovesAtMostEveryThirdTickAndOnlyWhenLedElsewhere) {
    Hand hand("mouse", 60.0);
    hand.grab("cloth.a@#3", 0.1, 200.0, 0.3, {0.0, 1.0, 0.0});
    std::vector<std::int64_t> moves;
    for (std::int64_t tick = 10; tick < 40; ++tick) {
        if (tick < 30) hand.leadTo({0.01 * static_cast<double>(tick), 1.0, 0.0});
        for (const world::ActionSpec& deed : hand.deedsAt(tick))
            if (deed.what == Do::move) {
                moves.push_back(tick);
                EXPECT_DOUBLE_EQ(deed.over, 0.05);
                EXPECT_EQ(deed.ease, world::Ease::linear);
            }
    }
    ASSERT_EQ(moves.size(), 8U);  // ticks 10, 13, … 28 and the rest of the way at 31
    for (std::size_t i = 1; i < moves.size(); ++i) EXPECT_EQ(moves[i] - moves[i - 1], Hand::moveTicks);
}

TEST(Hand, WhatItDoesIsRoundedAsAFileHasIt) {
    Hand hand("mouse", 72.0);
    hand.grab("cloth.a@#3", 0.123456, 200.0, 0.3, {0.0, 0.0, 0.0});
    hand.leadTo({0.12345678, -0.0001, 1.0 / 9.0});
    const auto deeds = hand.deedsAt(7);
    ASSERT_EQ(deeds.size(), 2U);
    EXPECT_EQ(deeds[0].radius, 0.123);
    EXPECT_EQ(deeds[0].t, 0.097222);  // 7/72
    EXPECT_EQ(*deeds[1].to, glm::dvec3(0.123, 0.0, 0.111));
    EXPECT_EQ(deeds[1].over, 0.041667);  // 3/72
}

TEST(Hand, IsNoFasterThanAnArm) {
    Hand hand("mouse", 60.0);
    hand.grab("cloth.a@#3", 0.1, 200.0, 0.3, {0.0, 0.0, 0.0});
    hand.leadTo({1.0, 0.0, 0.0});
    std::vector<double> places;
    for (std::int64_t tick = 0; tick < 30; ++tick)
        for (const world::ActionSpec& deed : hand.deedsAt(tick))
            if (deed.to) {
                places.push_back(deed.to->x);
            }
    EXPECT_EQ(places, (std::vector{0.25, 0.5, 0.75, 1.0}));  // 5 m/s for three ticks each
}

TEST(Hand, LetsGoBeforeItTakesAgain) {
    Hand hand("mouse", 60.0);
    hand.grab("cloth.a@#3", 0.1, 200.0, 0.3, {0.0, 1.0, 0.0});
    EXPECT_EQ(whatOf(hand.deedsAt(0)), (std::vector{Do::grab}));
    hand.release();
    hand.grab("cloth.a@#9", 0.1, 200.0, 0.3, {0.0, 1.0, 0.0});
    EXPECT_EQ(whatOf(hand.deedsAt(1)), (std::vector{Do::release, Do::grab}));
    hand.release();
    EXPECT_EQ(whatOf(hand.deedsAt(2)), (std::vector{Do::release}));
    EXPECT_TRUE(hand.deedsAt(3).empty());
}

TEST(Hand, AClickBetweenTwoTicksIsNothing) {
    Hand hand("mouse", 60.0);
    hand.grab("cloth.a@#3", 0.1, 200.0, 0.3, {0.0, 1.0, 0.0});
    hand.release();
    EXPECT_TRUE(hand.deedsAt(0).empty());
    EXPECT_FALSE(hand.isHolding());
}

}  // namespace
}  // namespace taut::live
