#include "core/aligned_array.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace taut::core {
namespace {

TEST(AlignedArray, StartsOnACacheLineAndHoldsZeros) {
    for (std::size_t size : {1U, 7U, 16U, 1000U}) {
        const AlignedArray<float> array(size);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % cacheLine, 0U);
        EXPECT_EQ(array.size(), size);
        for (float x : array) EXPECT_EQ(x, 0.0F);
    }
}

TEST(AlignedArray, CopiesAreApartAndMovesLeaveNothing) {
    AlignedArray<double> a(3);
    a[1] = 2.0;
    AlignedArray<double> b = a;
    b[1] = 5.0;
    EXPECT_EQ(a[1], 2.0);
    const AlignedArray<double> c = std::move(b);
    EXPECT_EQ(c[1], 5.0);
    EXPECT_TRUE(b.empty());  // NOLINT: that is the promise
}

TEST(AlignedArray, EmptyOnesCanBeCopiedAndSwapped) {
    AlignedArray<int> a, b(2);
    a = b;
    EXPECT_EQ(a.size(), 2U);
    a = AlignedArray<int>();
    EXPECT_TRUE(a.empty());
}

}  // namespace
}  // namespace taut::core
