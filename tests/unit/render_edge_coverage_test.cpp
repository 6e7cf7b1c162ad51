// Which samples triangles cover: geometry without GL. Expected numbers are areas.
#include "taut/render/private/edge_coverage.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "taut/core/private/instruction_set.h"

namespace taut::render {
namespace {

constexpr PixelBox tileBox{32, 16, edgeTileSize, edgeTileSize};

EdgeTriangle coveringTriangle(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, std::uint32_t mark, double depth) {
    EdgeTriangle result;
    result.corners = {a, b, c};
    if ((b.x - a.x) * (c.y - a.y) < (b.y - a.y) * (c.x - a.x)) std::swap(result.corners[1], result.corners[2]);
    result.depth = depth;
    result.left = tileBox.x;
    result.low = tileBox.y;
    result.right = tileBox.x + tileBox.width - 1;
    result.high = tileBox.y + tileBox.height - 1;
    result.mark = mark;
    return result;
}

int samplesWith(const CoveredTile& covered, std::int32_t mark) {
    int count = 0;
    for (const FourInts& marks : covered.mark)
        for (int i = 0; i < 4; ++i) count += marks[i] == mark ? 1 : 0;
    return count;
}

TEST(EdgeCoverage, AFanAroundAPointCoversEachSampleOnce) {
    // Eight triangles around places on the raster of corners, so that sides go through samples: a sample that one omits
    // the other must have. Drawn from the far to the near, a sample that two cover would be missing from the first.
    std::mt19937 random(7);
    std::uniform_int_distribution<int> step(-6 * 256, 6 * 256);
    for (int trial = 0; trial < 50; ++trial) {
        const glm::dvec2 middle(40.0 + step(random) / 256.0, 24.0 + step(random) / 256.0);
        const std::array<glm::dvec2, 8> rim{glm::dvec2(0, 0), {40, 0},  {80, 0}, {80, 24},
                                            {80, 60},         {40, 60}, {0, 60}, {0, 24}};
        int sum = 0;
        for (std::size_t i = 0; i < rim.size(); ++i) {
            CoveredTile covered;
            covered.clear();
            covered.add(tileBox, coveringTriangle(middle, rim[i], rim[(i + 1) % rim.size()], 1, 0.5));
            sum += samplesWith(covered, 1);
        }
        EXPECT_EQ(sum, 4 * edgeTileSize * edgeTileSize);
    }
}

TEST(EdgeCoverage, AHalfPlaneCoversItsShareOfThePixelsOnItsBorder) {
    CoveredTile covered;
    covered.clear();
    // Right of x = 40.5: of the pixels of column 8 the two samples of the right half, of those beyond all.
    covered.add(tileBox, coveringTriangle({40.5, -100.0}, {400.0, 16.0}, {40.5, 200.0}, 3, 0.5));
    for (int y = 0; y < edgeTileSize; ++y) {
        for (int x = 0; x < edgeTileSize; ++x) {
            const FourInts& marks = covered.mark[y * edgeTileSize + x];
            EXPECT_EQ((marks[0] + marks[1] + marks[2] + marks[3]) / 3, x < 8 ? 0 : x == 8 ? 2 : 4);
        }
    }
}

TEST(EdgeCoverage, TheNearestIsSeenAndOfTwoAtOneDepthTheFirst) {
    CoveredTile covered;
    covered.clear();
    const auto everywhere = [](std::uint32_t mark, double depth) {
        return coveringTriangle({0.0, 0.0}, {200.0, 0.0}, {0.0, 200.0}, mark, depth);
    };
    for (const EdgeTriangle& drawn : {everywhere(1, 0.5), everywhere(2, 0.4), everywhere(3, 0.4), everywhere(4, 0.6)})
        covered.add(tileBox, drawn);
    EXPECT_EQ(samplesWith(covered, 2), 4 * edgeTileSize * edgeTileSize);
}

TEST(EdgeCoverage, DepthIsThatOfThePixelsMiddle) {
    CoveredTile covered;
    covered.clear();
    EdgeTriangle slope = coveringTriangle({0.0, 0.0}, {200.0, 0.0}, {0.0, 200.0}, 1, 0.1);
    slope.depthAlong = 0.002;
    slope.depthUp = 0.004;
    covered.add(tileBox, slope);
    // Pixel (3, 2) of the tile: its middle is at (35.5, 18.5); sample 1 is at (35.875, 18.375).
    const auto pixel = static_cast<std::size_t>(2 * edgeTileSize + 3);
    EXPECT_NEAR(covered.depth[pixel][1], 0.1F + 0.002F * 35.5F + 0.004F * 18.5F, 1e-6F);
    EXPECT_NEAR(covered.nearest[pixel][1], 0.1F + 0.002F * 35.875F + 0.004F * 18.375F, 1e-6F);
}

TEST(EdgeCoverage, EveryInstructionSetGivesTheSameBits) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> along(20.0, 60.0), depth(0.1, 0.9);
    const auto place = [&] { return glm::dvec2(along(random), along(random) - 16.0); };
    std::vector<EdgeTriangle> triangles;
    for (std::uint32_t i = 0; i < 200; ++i) {
        triangles.push_back(coveringTriangle(place(), place(), place(), i, depth(random)));
        triangles.back().depthAlong = 1e-3 * depth(random);
        triangles.back().right -= static_cast<int>(i % 7);
    }
    const core::InstructionSet before = core::instructionSet();
    std::vector<CoveredTile> tiles;
    for (const auto set : {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512}) {
        if (!core::isSupported(set)) continue;
        core::useInstructionSet(set);
        CoveredTile& covered = tiles.emplace_back();
        covered.clear();
        for (const EdgeTriangle& triangle : triangles) covered.add(tileBox, triangle);
    }
    core::useInstructionSet(before);
    for (const CoveredTile& covered : tiles) {
        EXPECT_EQ(std::memcmp(&covered.nearest, &tiles[0].nearest, sizeof(covered.nearest)), 0);
        EXPECT_EQ(std::memcmp(&covered.depth, &tiles[0].depth, sizeof(covered.depth)), 0);
        EXPECT_EQ(std::memcmp(&covered.mark, &tiles[0].mark, sizeof(covered.mark)), 0);
    }
}

}  // namespace
}  // namespace taut::render
