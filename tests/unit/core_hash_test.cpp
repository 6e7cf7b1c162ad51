#include "taut/core/private/hash.h"

#include <gtest/gtest.h>

#include <set>

namespace taut::core {
namespace {

std::uint64_t hashOf(auto... values) {
    Hash hash;
    (hash.add(values), ...);
    return hash.value();
}

// FNV-1a's published offset basis, and its published value for "a" followed by the zero that ends a text here.
TEST(Hash, StartsFromThePublishedBasis) {
    EXPECT_EQ(Hash().value(), 0xcbf29ce484222325ULL);
    Hash a;
    a.addByte('a');
    EXPECT_EQ(a.value(), 0xaf63dc4c8601ec8cULL);
}

TEST(Hash, NegativeZeroCountsAsZero) {
    EXPECT_EQ(hashOf(0.0), hashOf(-0.0));
    EXPECT_EQ(hashOf(0.0F), hashOf(-0.0F));
}

TEST(Hash, SeesEveryBitOfANumber) {
    std::set<std::uint64_t> seen;
    for (int bit = 0; bit < 64; ++bit)
        seen.insert(hashOf(std::bit_cast<double>(0x3ff0000000000000ULL ^ (1ULL << bit))));
    EXPECT_EQ(seen.size(), 64U);
}

TEST(Hash, SeesTheOrder) {
    EXPECT_NE(hashOf(1.0, 2.0), hashOf(2.0, 1.0));
}

TEST(Hash, TellsWhereATextEnds) {
    EXPECT_NE(hashOf(std::string_view("ab"), std::string_view("c")),
              hashOf(std::string_view("a"), std::string_view("bc")));
}

}  // namespace
}  // namespace taut::core
