#include "taut/render/private/edge_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace taut::render {
namespace {

constexpr std::uint32_t clothMark = 1U << 24, ballMark = 2U << 24;

// 64 x 48 pixels from (32, 16) on, filled by functions of the place in the box.
ShadedPixels picture(const std::function<std::uint32_t(int, int)>& mark, const std::function<float(int, int)>& depth) {
    ShadedPixels pixels{{32, 16, 64, 48}, {}, {}};
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            pixels.colour.push_back(mark(x, y) | 0x00123456U);
            pixels.depth.push_back(depth(x, y));
        }
    return pixels;
}

bool holds(const std::vector<PixelBox>& tiles, int x, int y) {
    return std::any_of(
        tiles.begin(), tiles.end(),
        [&](const PixelBox& tile) {
            return x >= tile.x && x < tile.x + tile.width && y >= tile.y && y < tile.y + tile.height;
        });
}

int area(const std::vector<PixelBox>& tiles) {
    int sum = 0;
    for (const PixelBox& tile : tiles) sum += tile.width * tile.height;
    return sum;
}

TEST(EdgeTiles, ASlopeHasNone) {
    const auto tiles = edgeTiles(
        picture([](int, int) { return clothMark; },
                [](int x, int y) { return 0.5F + 0.002F * static_cast<float>(x) + 0.001F * static_cast<float>(y); }));
    EXPECT_TRUE(tiles.empty());
}

TEST(EdgeTiles, BothSidesOfAnotherSurfaceAreFound) {
    // The border runs between columns 31 and 32, which lie in different tiles.
    const auto tiles =
        edgeTiles(picture([](int x, int) { return x < 32 ? clothMark : ballMark; }, [](int, int) { return 0.5F; }));
    for (int y = 16; y < 64; ++y) {
        EXPECT_TRUE(holds(tiles, 32 + 31, y));
        EXPECT_TRUE(holds(tiles, 32 + 32, y));
    }
    EXPECT_EQ(area(tiles), 2 * edgeTileSize * 48);
}

TEST(EdgeTiles, AFoldOfOneSurfaceIsFoundByItsDepth) {
    const auto tiles =
        edgeTiles(picture([](int, int) { return clothMark; }, [](int, int y) { return y < 20 ? 0.5F : 0.501F; }));
    EXPECT_TRUE(holds(tiles, 40, 16 + 19));
    EXPECT_TRUE(holds(tiles, 40, 16 + 20));
    EXPECT_EQ(area(tiles), 64 * edgeTileSize);
}

TEST(EdgeTiles, DepthBehindAllSurfacesDoesNotCount) {
    const auto tiles = edgeTiles(picture([](int, int) { return 0U; }, [](int x, int) { return x < 20 ? 0.5F : 0.9F; }));
    EXPECT_TRUE(tiles.empty());
}

// 65 columns: the last one is a tile of its own.
TEST(EdgeTiles, AnEdgeBeforeTheOutermostColumnIsFound) {
    ShadedPixels pixels{{0, 0, 65, 3}, {}, std::vector<float>(3 * 65, 0.5F)};
    for (int i = 0; i < 3 * 65; ++i) pixels.colour.push_back(i % 65 == 64 ? ballMark : clothMark);
    const auto tiles = edgeTiles(pixels);
    EXPECT_TRUE(holds(tiles, 64, 1));
    EXPECT_TRUE(holds(tiles, 63, 1));
    EXPECT_FALSE(holds(tiles, 40, 1));
}

}  // namespace
}  // namespace taut::render
