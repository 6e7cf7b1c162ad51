#include "taut/image/compare.h"

#include <gtest/gtest.h>

#include "image_support.h"

namespace taut::image {
namespace {

Image grey(int width, int height, int value = 100) {
    const auto size = static_cast<std::size_t>(width * height * 3);
    return {width, height, std::vector<std::uint8_t>(size, static_cast<std::uint8_t>(value))};
}

void shift(Image& image, int x, int y, int channel, int by) {
    auto& value = image.rgb[static_cast<std::size_t>((y * image.width + x) * 3 + channel)];
    value = static_cast<std::uint8_t>(value + by);
}

TEST(Compare, EqualPicturesDifferByNothing) {
    const Comparison c = compare(test::testPicture(50, 40), test::testPicture(50, 40));
    EXPECT_TRUE(c.within);
    EXPECT_EQ(c.share, 0.0);
    EXPECT_EQ(c.worstTileMean, 0.0);
    EXPECT_EQ(c.largest, 0);
}

TEST(Compare, DifferentSizesNeverAgree) {
    const Comparison c = compare(grey(16, 16), grey(16, 17));
    EXPECT_FALSE(c.sameSize);
    EXPECT_FALSE(c.within);
}

// 200 × 100 pixels: 0.01 % are two pixels. One channel off by 3 adds 3 / 768 to its tile: far below the second rule.
TEST(Compare, TwoPixelsInTwentyThousandMayDifferAndThreeMayNot) {
    const Image a = grey(200, 100);
    Image b = a;
    shift(b, 5, 5, 0, 3);
    shift(b, 100, 50, 1, -3);
    EXPECT_TRUE(compare(a, b).within);
    EXPECT_DOUBLE_EQ(compare(a, b).share, 2.0 / 20000.0);
    shift(b, 190, 90, 2, 3);
    EXPECT_FALSE(compare(a, b).within);
    EXPECT_EQ(compare(a, b).largest, 3);
}

// A difference of 2 is not counted by the first rule, so that the second one decides.
TEST(Compare, WeakChangeOfATileIsFoundByItsMean) {
    const Image a = grey(64, 64);
    Image b = a;
    for (int i = 0; i < 96; ++i) shift(b, 32 + i % 16, 16 + i / 16, 0, 2);  // 192 / 768 = 0.25
    EXPECT_TRUE(compare(a, b).within);
    EXPECT_DOUBLE_EQ(compare(a, b).worstTileMean, 0.25);
    EXPECT_EQ(compare(a, b).worstTileX, 32);
    EXPECT_EQ(compare(a, b).worstTileY, 16);
    shift(b, 32, 31, 1, 1);
    EXPECT_FALSE(compare(a, b).within);
    EXPECT_EQ(compare(a, b).share, 0.0);
}

TEST(Compare, TileAtTheEdgeIsAveragedOverItsOwnPixels) {
    const Image a = grey(17, 17);
    Image b = a;
    shift(b, 16, 16, 0, 2);  // alone in its tile: 2 / 3
    EXPECT_DOUBLE_EQ(compare(a, b).worstTileMean, 2.0 / 3.0);
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

}  // namespace
}  // namespace taut::image
