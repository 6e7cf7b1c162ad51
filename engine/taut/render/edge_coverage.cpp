#include "taut/render/private/edge_coverage.h"

#include <algorithm>

namespace taut::render {

namespace {

// Each in a row and a column of its own.
constexpr float sampleX[]{0.375F, 0.875F, 0.125F, 0.625F};  // [pixels]
constexpr float sampleY[]{0.125F, 0.375F, 0.625F, 0.875F};

TileSlope slopeOf(double at, double along, double up) {
    TileSlope slope{static_cast<float>(at), static_cast<float>(along), static_cast<float>(up), {}};
    for (int i = 0; i < 4; ++i) slope.samples[i] = slope.along * sampleX[i] + slope.up * sampleY[i];
    return slope;
}

// Not below zero on the inner side of the way from a to b. What lies on it belongs to one of the two neighbours.
TileSlope borderOf(const PixelBox& tile, glm::dvec2 a, glm::dvec2 b) {
    TileSlope border = slopeOf((b.x - a.x) * (tile.y - a.y) - (b.y - a.y) * (tile.x - a.x), a.y - b.y, b.x - a.x);
    if (!(b.y > a.y || (b.y == a.y && b.x > a.x)))
        for (float& sample : border.samples) sample -= 1e-6F;
    return border;
}

}  // namespace

void CoveredTile::clear() {
    nearest.fill(fourTimes(1.0F));
    depth.fill(fourTimes(1.0F));
    mark.fill(FourInts{0, 0, 0, 0});
}

void CoveredTile::add(const PixelBox& tile, const EdgeTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    CoverageArgs args{};
    args.sides[0] = borderOf(tile, a, b);
    args.sides[1] = borderOf(tile, b, c);
    args.sides[2] = borderOf(tile, c, a);
    args.depth = slopeOf(triangle.depth + triangle.depthAlong * tile.x + triangle.depthUp * tile.y, triangle.depthAlong,
                         triangle.depthUp);
    args.toMiddle = 0.5F * (args.depth.along + args.depth.up);
    args.left = std::max(triangle.left - tile.x, 0);
    args.right = std::min(triangle.right - tile.x, tile.width - 1);
    args.low = std::max(triangle.low - tile.y, 0);
    args.high = std::min(triangle.high - tile.y, tile.height - 1);
    args.mark = static_cast<std::int32_t>(triangle.mark);
    args.nearest = reinterpret_cast<float*>(nearest.data());
    args.middle = reinterpret_cast<float*>(depth.data());
    args.marks = reinterpret_cast<std::int32_t*>(mark.data());
    kernels.cover(args);
}

}  // namespace taut::render
