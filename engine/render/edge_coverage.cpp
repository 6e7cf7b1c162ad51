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

// Not below zero on the inner side of the way from a to b. What lies on it belongs to one of the two neighbours.
struct Border {
    Slope slope;

    Border(const PixelBox& tile, glm::dvec2 a, glm::dvec2 b)
        : slope((b.x - a.x) * (tile.y - a.y) - (b.y - a.y) * (tile.x - a.x), a.y - b.y, b.x - a.x) {
        if (!(b.y > a.y || (b.y == a.y && b.x > a.x))) slope.samples -= 1e-6F;
    }

    // Leaves those of the columns of a row that may have a sample inside.
    void narrow(int y, int& left, int& right) const {
        if (slope.along == 0.0F) return;
        const float up = slope.up > 0.0F ? slope.up * static_cast<float>(y + 1) : slope.up * static_cast<float>(y);
        const float crossing = std::clamp(-(slope.start + up) / slope.along, -2.0F, 1.0F + edgeTileSize);
        if (slope.along > 0.0F)
            left = std::max(left, static_cast<int>(crossing + 1.0F) - 2);  // not before the pixel with the crossing
        else
            right = std::min(right, static_cast<int>(crossing + 1.0F));
    }

    FourFloats at(int x, int y) const { return slope.at(x, y) + slope.samples; }
};

constexpr int wide = 6;  // [pixels] narrowing a row pays where it is longer

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
        int from = left, to = right;
        if (right - left >= wide)
            for (const Border* border : {&ab, &bc, &ca}) border->narrow(y, from, to);
        FourFloats toAb = ab.at(from, y), toBc = bc.at(from, y), toCa = ca.at(from, y);
        for (int x = from; x <= to; ++x) {
            const FourInts inside = (FourInts)(((FourInts)toAb | (FourInts)toBc | (FourInts)toCa) >= 0);
            toAb += ab.slope.along;
            toBc += bc.slope.along;
            toCa += ca.slope.along;
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
