#include "taut/core/glob.h"

#include <gtest/gtest.h>

#include <string>

namespace taut::core {
namespace {

TEST(Glob, StarsStandForAnyCharacters) {
    EXPECT_TRUE(matches("*", "flag"));
    EXPECT_TRUE(matches("fl*g", "flag"));
    EXPECT_TRUE(matches("row.*", "row.12"));
    EXPECT_TRUE(matches("*a*a*", "banana"));
    EXPECT_FALSE(matches("fl*g", "flags"));
    EXPECT_FALSE(matches("flag", "fla"));
    EXPECT_FALSE(matches("", "flag"));
    EXPECT_TRUE(matches("flag**", "flag"));
}

// Whoever tries every length for every star needs more than 10^12 steps here.
TEST(Glob, ManyStarsTakeNoLonger) {
    std::string pattern;
    for (int i = 0; i < 16; ++i) pattern += "*a";
    EXPECT_FALSE(matches(pattern + "b", std::string(64, 'a')));
}

}  // namespace
}  // namespace taut::core
