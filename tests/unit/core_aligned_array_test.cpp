#include "taut/core/aligned_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

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

// From 2 MiB on the memory comes in large pages; also just below and above.
TEST(AlignedArray, LargeOnesStartOnALargePageAndBehaveAlike) {
    constexpr std::size_t largePage = std::size_t{1} << 21;  // [bytes]
    for (const std::size_t size : {largePage / 8 - 1, largePage / 8, largePage / 8 + 1, largePage}) {
        AlignedArray<double> array(size);
        if (size * sizeof(double) >= largePage)
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % largePage, 0U) << size;
        EXPECT_EQ(std::count(array.begin(), array.end(), 0.0), static_cast<std::ptrdiff_t>(size));
        array[0] = 1.0;
        array[size - 1] = 2.0;
        AlignedArray<double> copy = array;
        copy[0] = 3.0;
        array = std::move(copy);
        EXPECT_EQ(array[0], 3.0);
        EXPECT_EQ(array[size - 1], 2.0);
    }
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
