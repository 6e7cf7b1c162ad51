#include "taut/render/private/edge_pass.h"

#include <algorithm>
#include <cmath>

#include "taut/core/private/parallel.h"
#include "taut/render/private/edge_coverage.h"

namespace taut::render {

namespace {

constexpr int tilesATask = 16;

// How badly a pixel fits each of the four samples of another.
FourFloats misfit(FourInts marks, FourFloats depths, std::int32_t mark, float depth) {
    const FourFloats off = depths - depth, away = off < 0.0F ? -off : off;
    return (marks != 0 ? away : FourFloats{}) + (marks != mark ? fourTimes(10.0F) : FourFloats{});
}

// Colours are bytes of the sRGB curve; as light they are close to their squares. What is not opaque counts as far as it
// covers.
template <bool isOpaque>
struct Lights {
    FourFloats red, green, blue, cover{};

    Lights(const ShadedPixels& shaded, std::size_t pixel) { take(~FourInts{}, shaded, pixel); }
    void take(FourInts samples, const ShadedPixels& shaded, std::size_t pixel) {
        const std::uint32_t colour = shaded.colour[pixel];
        float part = 1.0F;
        if constexpr (!isOpaque) {
            part = static_cast<float>(shaded.alpha[pixel]);
            cover = samples ? fourTimes(part) : cover;
        }
        red = samples ? fourTimes(part * square(colour)) : red;
        green = samples ? fourTimes(part * square(colour >> 8)) : green;
        blue = samples ? fourTimes(part * square(colour >> 16)) : blue;
    }
    static float square(std::uint32_t colour) {
        const auto byte = static_cast<float>(colour & 255U);
        return byte * byte;
    }
    static float sum(FourFloats four) { return four[0] + four[1] + four[2] + four[3]; }
    std::uint32_t mean(FourFloats lights) const {
        const float share = isOpaque ? 0.25F : 1.0F / std::max(sum(cover), 1.0F);
        return static_cast<std::uint32_t>(std::sqrt(share * sum(lights)) + 0.5F);
    }
    std::uint32_t mixed() const { return mean(red) | mean(green) << 8 | mean(blue) << 16; }
    std::uint8_t alpha() const { return static_cast<std::uint8_t>(0.25F * sum(cover) + 0.5F); }
};

// Each sample takes its colour from the pixel itself if that shows the same surface at about the same depth, else from
// the neighbour that fits best. In the middle of surfaces nothing changes.
template <bool isOpaque>
void smoothTile(const PixelBox& tile, const CoveredTile& covered, const ShadedPixels& shaded, int width,
                std::span<std::uint32_t> picture, std::span<std::uint8_t> alpha) {
    const PixelBox& box = shaded.box;
    for (int y = tile.y - box.y; y < tile.y - box.y + tile.height; ++y) {
        for (int x = tile.x - box.x; x < tile.x - box.x + tile.width; ++x) {
            const auto sample = static_cast<std::size_t>((y + box.y - tile.y) * edgeTileSize + x + box.x - tile.x);
            const auto here = static_cast<std::size_t>(y * box.width + x);
            const FourInts marks = covered.mark[sample];
            const FourFloats depths = covered.depth[sample];
            const std::uint32_t colour = shaded.colour[here];
            const float depth = shaded.depth[here];
            FourFloats error = misfit(marks, depths, static_cast<std::int32_t>(colour >> 24), depth);
            if (!isAny(error > 0.0008F * (1.0F - depth) + 1e-6F)) continue;
            Lights<isOpaque> lights(shaded, here);
            for (int row = std::max(y - 1, 0); row <= std::min(y + 1, box.height - 1); ++row) {
                for (int column = std::max(x - 1, 0); column <= std::min(x + 1, box.width - 1); ++column) {
                    const auto beside = static_cast<std::size_t>(row * box.width + column);
                    const std::uint32_t other = shaded.colour[beside];
                    const FourFloats badness =
                        misfit(marks, depths, static_cast<std::int32_t>(other >> 24), shaded.depth[beside]);
                    const FourInts better = badness < error;
                    lights.take(better, shaded, beside);
                    error = better ? badness : error;
                }
            }
            const auto to = static_cast<std::size_t>((y + box.y) * width + x + box.x);
            picture[to] = lights.mixed() | 0xff000000U;
            if constexpr (!isOpaque) alpha[to] = lights.alpha();
        }
    }
}

}  // namespace

float itemMark(std::size_t item) {
    return static_cast<float>(item % 254 + 1) / 255.0F;
}

PixelBox pixelBox(std::span<const DrawItem> items, const glm::mat4& viewProjection, int width, int height) {
    const glm::vec2 size(width, height);
    glm::vec2 low = size;
    glm::vec2 high(0.0F);
    for (const DrawItem& item : items) {
        for (const glm::vec3& corner : item.bounds.corners()) {
            const glm::vec4 clip = viewProjection * glm::vec4(corner, 1.0F);
            if (clip.z < -clip.w || clip.w <= 0.0F) return {0, 0, width, height};
            const glm::vec2 pixel = size * (0.5F + 0.5F * glm::vec2(clip) / clip.w);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
    }
    low = glm::clamp(glm::floor(low) - 1.0F, glm::vec2(0.0F), size);
    high = glm::clamp(glm::ceil(high) + 1.0F, low, size);
    const glm::ivec2 from(low);
    const glm::ivec2 extent(high - low);
    return {from.x, from.y, extent.x, extent.y};
}

glm::vec4 seenSideOf(const view::FrameView& view) {
    if (!view.ground) return {0.0F, 0.0F, 0.0F, 1.0F};
    const float side = view.camera.eye.y >= view.ground->height ? 1.0F : -1.0F;
    return {0.0F, side, 0.0F, -side * view.ground->height};
}

void forEachTile(const EdgeTriangles& triangles,
                 const std::function<void(const PixelBox& tile, const CoveredTile& covered)>& each) {
    const std::span<const PixelBox> tiles = triangles.tiles();
    const int count = static_cast<int>(tiles.size());
    core::parallelFor((count + tilesATask - 1) / tilesATask, [&](int task) {
        CoveredTile covered;
        for (int i = task * tilesATask; i < std::min((task + 1) * tilesATask, count); ++i) {
            const PixelBox& tile = tiles[static_cast<std::size_t>(i)];
            covered.clear();
            triangles.visit(static_cast<std::size_t>(i),
                            [&](const EdgeTriangle& triangle) { covered.add(tile, triangle); });
            each(tile, covered);
        }
    });
}

void smoothEdges(std::span<const DrawItem> items, const EdgeView& view, const ShadedPixels& shaded,
                 EdgeTriangles& triangles, std::span<std::uint32_t> picture, std::span<std::uint8_t> alpha) {
    if (shaded.box.width == 0 || shaded.box.height == 0) return;
    const std::vector<PixelBox> found = edgeTiles(shaded);
    triangles.find(items, view, shaded.box, found);
    forEachTile(triangles, [&](const PixelBox& tile, const CoveredTile& covered) {
        if (shaded.alpha.empty())
            smoothTile<true>(tile, covered, shaded, view.size.x, picture, alpha);
        else
            smoothTile<false>(tile, covered, shaded, view.size.x, picture, alpha);
    });
}

}  // namespace taut::render
