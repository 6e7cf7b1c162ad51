// The meaning of comparisons, and the side that a failure shows. Malformed claims: scene_refusals_test.
#include "unit/check_support.h"

namespace taut::check {
namespace {

// A world whose time is 0.5 s.
const world::World& halfSecond() {
    static const world::World world = [] {
        world::World made(sceneOf("[rope.r]\nends = [[0, 2, 0], [1, 2, 0]]\nhold = [\"all\"]\n"));
        play(made, 30);
        return made;
    }();
    return world;
}

TEST(CheckLanguage, ComparisonsHoldAsInArithmetic) {
    const std::pair<const char*, bool> cases[] = {
        {"time < 0.5", false},          {"time <= 0.5", true},
        {"time > 0.5", false},          {"time >= 0.5", true},
        {"time == 0.5", true},          {"time != 0.5", false},
        {"0.4 < time < 0.6", true},     {"0.4 < time < 0.5", false},
        {"0.5 < time < 0.6", false},    {"1 > time >= 0.5", true},
        {"0 <= time <= 0.5 < 1", true}, {"time/0 > 1", true},
        {"(time-time)/0 != 1", false},  {"(time-time)/0 == (time-time)/0", false},
    };
    for (const auto& [text, expected] : cases)
        EXPECT_EQ(Check::parse(text).evaluate(halfSecond()).holds, expected) << text;
}

TEST(CheckLanguage, TheMeasuredSideIsTheValue) {
    const Outcome left = Check::parse("time * 2 < 0.25").evaluate(halfSecond());
    EXPECT_EQ(left.value, 1.0);
    EXPECT_EQ(left.relation, "<");
    EXPECT_EQ(left.bound, 0.25);
    EXPECT_EQ(left.margin, -0.75);
    EXPECT_EQ(left.subject, "time * 2");
    EXPECT_EQ(left.unit, "s");
    const Outcome right = Check::parse("0.25 >= height(rope.r)").evaluate(halfSecond());
    EXPECT_EQ(right.value, 2.0);
    EXPECT_EQ(right.relation, "<=");
    EXPECT_EQ(right.bound, 0.25);
    EXPECT_EQ(right.margin, -1.75);
    EXPECT_EQ(right.subject, "height(rope.r)");
    EXPECT_EQ(right.unit, "m");
}

TEST(CheckLanguage, OfAChainTheComparisonThatFailsIsShown) {
    const Outcome outcome = Check::parse("0 < time < 0.2 < 0.3").evaluate(halfSecond());
    EXPECT_FALSE(outcome.holds);
    EXPECT_EQ(outcome.value, 0.5);
    EXPECT_EQ(outcome.bound, 0.2);
    const Outcome nearest = Check::parse("0 < time < 0.6").evaluate(halfSecond());
    EXPECT_TRUE(nearest.holds);
    EXPECT_EQ(nearest.bound, 0.6);  // nearer than 0
}

TEST(CheckLanguage, TargetsKeepTheirBracketsAndSayWhereTheyStand) {
    const std::vector<Mention> mentions =
        Check::parse("distance( cloth.flag@(0.5, 1) ,rope.r@25%) < max_strain(net.*)").mentions();
    ASSERT_EQ(mentions.size(), 3U);
    EXPECT_EQ(mentions[0].target, "cloth.flag@(0.5, 1)");
    EXPECT_EQ(mentions[0].at, 10U);
    EXPECT_TRUE(mentions[0].hasPoints);
    EXPECT_EQ(mentions[1].target, "rope.r@25%");
    EXPECT_EQ(mentions[2].target, "net.*");
    EXPECT_FALSE(mentions[2].hasPoints);
}

// Where a message breaks off there, nothing may be left of it.
TEST(CheckLanguage, ControlCharactersAreRefusedWhereTheyStand) {
    for (const std::string& unseen : {std::string(1, '\0'), std::string("\n"), std::string("\x7F")}) {
        try {
            Check::parse("height(" + unseen + "a.b) > 1");
            ADD_FAILURE();
        } catch (const ClaimError& fault) {
            EXPECT_EQ(fault.at, 7U);
            EXPECT_STREQ(fault.what(), "there is a control character here");
        }
    }
}

TEST(CheckLanguage, DeepAndLongTextsAreRefused) {
    EXPECT_THROW(Check::parse(std::string(500, '(') + "time"), ClaimError);
    EXPECT_THROW(Check::parse(std::string(500, '-') + "time < 1"), ClaimError);
    EXPECT_THROW(Check::parse("time < 1" + std::string(5000, ' ')), ClaimError);
}

}  // namespace
}  // namespace taut::check
