#include "taut/render/edge_coverage.h"

#include <algorithm>

namespace taut::render {

namespace {

// Each in a row and a column of its own.
constexpr FourFloats sampleX{0.375F, 0.875F, 0.125F, 0.625F};  // [pixels]
constexpr FourFloats sampleY{0.125F, 0.375F, 0.625F, 0.875F};

// A function that is linear over the picture, from a tile's corner on.
struct Slope {
    float start, along, up;
    FourFloats samples;

    Slope(double at, double perColumn, double perRow)
        : start(static_cast<float>(at)), along(static_cast<float>(perColumn)), up(static_cast<float>(perRow)) {
        samples = along * sampleX + up * sampleY;
    }
    float at(int x, int y) const { return start + along * static_cast<float>(x) + up * static_cast<float>(y); }
};

// Above `least` on the inner side of the way from a to b. What lies on it belongs to one of the two neighbours.
struct Border {
    Slope slope;
    FourFloats least;

    Border(const PixelBox& tile, glm::dvec2 a, glm::dvec2 b)
        : slope((b.x - a.x) * (tile.y - a.y) - (b.y - a.y) * (tile.x - a.x), a.y - b.y, b.x - a.x),
          least(fourTimes(b.y > a.y || (b.y == a.y && b.x > a.x) ? -1e-6F : 0.0F)) {}
};

}  // namespace

void CoveredTile::clear() {
    nearest.fill(fourTimes(1.0F));
    depth.fill(fourTimes(1.0F));
    mark.fill(FourInts{0, 0, 0, 0});
}

void CoveredTile::add(const PixelBox& tile, const EdgeTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const Border ab(tile, a, b), bc(tile, b, c), ca(tile, c, a);
    const Slope ahead(triangle.depth + triangle.depthAlong * tile.x + triangle.depthUp * tile.y, triangle.depthAlong,
                      triangle.depthUp);
    const float toMiddle = 0.5F * (ahead.along + ahead.up);
    const auto own = static_cast<std::int32_t>(triangle.mark);
    const FourInts marks{own, own, own, own};
    const int left = std::max(triangle.left - tile.x, 0), right = std::min(triangle.right - tile.x, tile.width - 1);
    const int low = std::max(triangle.low - tile.y, 0), high = std::min(triangle.high - tile.y, tile.height - 1);
    for (int y = low; y <= high; ++y) {
        for (int x = left; x <= right; ++x) {
            const FourInts inside = (FourInts)(ab.slope.at(x, y) + ab.slope.samples > ab.least) &
                                    (FourInts)(bc.slope.at(x, y) + bc.slope.samples > bc.least) &
                                    (FourInts)(ca.slope.at(x, y) + ca.slope.samples > ca.least);
            if (!isAny(inside)) continue;
            const auto i = static_cast<std::size_t>(y * edgeTileSize + x);
            const float start = ahead.at(x, y);
            const FourFloats here = start + ahead.samples;
            const FourInts seen = inside & (FourInts)(here < nearest[i]);
            nearest[i] = chosen(seen, here, nearest[i]);
            depth[i] = chosen(seen, fourTimes(start + toMiddle), depth[i]);
            mark[i] = chosen(seen, marks, mark[i]);
        }
    }
}

}  // namespace taut::render
