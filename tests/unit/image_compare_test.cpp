#include "taut/image/private/compare.h"

#include <gtest/gtest.h>

#include <array>

#include "image_support.h"
#include "taut/image/private/resize.h"

namespace taut::image {
namespace {

Image grey(int width, int height, int value = 100) {
    const auto size = static_cast<std::size_t>(width * height * 3);
    return {width, height, std::vector<std::uint8_t>(size, static_cast<std::uint8_t>(value))};
}

void shift(Image& image, int x, int y, int channel, int by) {
    auto& value = image.rgb[(y * image.width + x) * 3 + channel];
    value = static_cast<std::uint8_t>(value + by);
}

TEST(Compare, EqualPicturesDifferByNothing) {
    const Comparison c = compare(test::testPicture(50, 40), test::testPicture(50, 40));
    EXPECT_TRUE(c.within);
    EXPECT_EQ(c.share, 0.0);
    EXPECT_EQ(c.worstTileShare, 0.0);
    EXPECT_EQ(c.largest, 0);
}

TEST(Compare, DifferentSizesNeverAgree) {
    const Comparison c = compare(grey(16, 16), grey(16, 17));
    EXPECT_FALSE(c.sameSize);
    EXPECT_FALSE(c.within);
}

// 200 × 100 pixels: 0.11 % are 22 pixels, however far they are off; no tile has two of them.
TEST(Compare, ThatManyPixelsMayFlipAndOneMoreMayNot) {
    const Image a = grey(200, 100);
    Image b = a;
    for (int i = 0; i < 22; ++i) shift(b, 16 * (i % 11), 16 * (i / 11), i % 3, i % 2 == 0 ? 3 : -100);
    EXPECT_TRUE(compare(a, b).within);
    EXPECT_DOUBLE_EQ(compare(a, b).share, 22.0 / 20000.0);
    shift(b, 190, 90, 2, 3);
    EXPECT_FALSE(compare(a, b).within);
    EXPECT_EQ(compare(a, b).largest, 100);
}

// A difference of 2 is not counted by the first rule, so that the second one decides: 22 % of 256 pixels are 56.
TEST(Compare, WeakChangeOfATileIsFoundByItsShare) {
    const Image a = grey(64, 64);
    Image b = a;
    for (int i = 0; i < 56; ++i) shift(b, 32 + i % 16, 16 + i / 16, i % 3, 2);
    EXPECT_TRUE(compare(a, b).within);
    EXPECT_DOUBLE_EQ(compare(a, b).worstTileShare, 56.0 / 256.0);
    EXPECT_EQ(compare(a, b).worstTileX, 32);
    EXPECT_EQ(compare(a, b).worstTileY, 16);
    shift(b, 32, 31, 1, 2);
    EXPECT_FALSE(compare(a, b).within);
    EXPECT_EQ(compare(a, b).share, 0.0);
}

// Approximate reciprocals differ between processors: pixels of a gradient are off by 1, some up and some down.
TEST(Compare, ADifferenceOfOneSaysNothingUnlessMostHaveIt) {
    const Image a = grey(200, 100);
    Image b = a;
    for (int i = 0; i < 20'000; ++i) shift(b, i % 200, i / 200, 1, i < 10'250 ? 1 : -1);
    const Comparison c = compare(a, b);
    EXPECT_TRUE(c.within);
    EXPECT_EQ(c.worstTileShare, 0.0);
    EXPECT_DOUBLE_EQ(c.mean, 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(c.offset, 0.025);  // 500 of 20 000
    shift(b, 199, 99, 1, 1);
    EXPECT_FALSE(compare(a, b).within);
    EXPECT_DOUBLE_EQ(compare(b, a).offset, -501.0 / 20'000.0);
    EXPECT_FALSE(compare(grey(64, 64, 100), grey(64, 64, 102)).within);
}

TEST(Compare, TileAtTheEdgeIsJudgedByItsOwnPixels) {
    const Image a = grey(20, 17);
    Image b = a;
    shift(b, 16, 16, 0, 2);  // one of the four of its tile
    EXPECT_DOUBLE_EQ(compare(a, b).worstTileShare, 0.25);
    EXPECT_EQ(compare(a, b).worstTileX, 16);
}

TEST(Compare, DifferencePictureIsSixteenTimesTheDifference) {
    const Image a = grey(4, 4);
    Image b = a;
    shift(b, 1, 2, 0, 3);
    shift(b, 3, 3, 2, -50);
    const Image d = differencePicture(a, b);
    EXPECT_EQ(d.rgb[(2 * 4 + 1) * 3], 48);
    EXPECT_EQ(d.rgb[(3 * 4 + 3) * 3 + 2], 255);
    EXPECT_EQ(d.rgb[0], 0);
}

// The middle of a pixel of twice the size lies a quarter of a pixel from the nearest old one: 3/4 and 1/4 of the two.
TEST(Resize, EnlargedPicturesRunEvenlyFromPixelToPixel) {
    Image two = grey(2, 1, 0);
    for (std::size_t i = 3; i < 6; ++i) two.rgb[i] = 200;
    const Image four = enlarged(two, 4, 3);
    for (std::size_t y = 0; y < 3; ++y)
        for (std::size_t x = 0; x < 4; ++x) EXPECT_EQ(four.rgb[3 * (4 * y + x)], (std::array{0, 50, 150, 200}[x]));
}

}  // namespace
}  // namespace taut::image
