#include "taut/render/private/thin_tubes.h"

#include <algorithm>
#include <cmath>

#include "taut/render/private/edge_coverage.h"
#include "taut/render/private/edge_pass.h"
#include "taut/view/camera_axes.h"

namespace taut::render {

namespace {

// From the depth of a picture to metres along the camera's axis: 1 / ahead is linear in it.
struct DepthScale {
    float start, slope;

    explicit DepthScale(const EdgeView& view) {
        // Of two places on the camera's axis, from clip coordinates: w is how far ahead a place lies.
        const glm::dmat4 inverse = glm::inverse(glm::dmat4(view.viewProjection));
        const auto nearness = [&](double depth) {
            const glm::dvec4 place = inverse * glm::dvec4(0.0, 0.0, 2.0 * depth - 1.0, 1.0);
            return place.w;  // the clip coordinates are those of a place with w = 1 ahead, divided by that
        };
        start = static_cast<float>(nearness(0.0));
        slope = static_cast<float>(nearness(1.0) - nearness(0.0));
    }
    float ahead(float depth) const { return 1.0F / (start + slope * depth); }
};

// Light, as the square of bytes, times what it covers.
struct CoveredLight {
    float red = 0.0F, green = 0.0F, blue = 0.0F, cover = 0.0F;

    void add(const CoveredLight& mean, float part) {
        red += part * mean.red / mean.cover;
        green += part * mean.green / mean.cover;
        blue += part * mean.blue / mean.cover;
        cover += part;
    }
    void add(std::uint32_t colour, float part) {
        red += part * square(colour);
        green += part * square(colour >> 8);
        blue += part * square(colour >> 16);
        cover += part;
    }
    static float square(std::uint32_t colour) {
        const auto byte = static_cast<float>(colour & 255U);
        return byte * byte;
    }
    std::uint32_t colour() const {
        const float share = 1.0F / std::max(cover, 1e-6F);
        const auto byte = [&](float light) { return static_cast<std::uint32_t>(std::sqrt(share * light) + 0.5F); };
        return byte(red) | byte(green) << 8 | byte(blue) << 16;
    }
};

// What the layer shows at a pixel and around it of a tube, by its mark; of the others there where there is nothing of
// it. As far as a tube is thin that is all of its sides, else only what lies at about this depth.
CoveredLight lightOf(const ShadedPixels& shaded, int x, int y, std::uint32_t mark, float depth, bool isThin) {
    const PixelBox& box = shaded.box;
    CoveredLight own, any, best;
    float least = INFINITY;
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, box.height - 1); ++row) {
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, box.width - 1); ++column) {
            const auto i = static_cast<std::size_t>(row * box.width + column);
            const std::uint32_t colour = shaded.colour[i];
            if (colour >> 24 == 0) continue;
            any.add(colour, 1.0F);
            if (colour >> 24 != mark) continue;
            own.add(colour, 1.0F);
            const float off = std::fabs(shaded.depth[i] - depth);
            if (off >= least) continue;
            least = off;
            best = {};
            best.add(colour, 1.0F);
        }
    }
    return own.cover == 0.0F ? any : isThin ? own : best;
}

void layTile(const PixelBox& tile, const CoveredTile& covered, const ThinLayer& layer, const DepthScale& depths,
             int width, Drawn& picture) {
    const PixelBox& box = layer.shaded.box;
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            const auto pixel = static_cast<std::size_t>((y - tile.y) * edgeTileSize + x - tile.x);
            if (!isAny(covered.mark[pixel])) continue;
            CoveredLight light;
            for (int sample = 0; sample < 4; ++sample) {
                const auto number = static_cast<std::size_t>(covered.mark[pixel][sample]);
                if (number == 0) continue;
                const auto mark = static_cast<std::uint32_t>(std::lround(255.0F * itemMark(number - 1)));
                const float depth = covered.depth[pixel][sample];
                const float ahead = depths.ahead(covered.nearest[pixel][sample]);
                const float radius = layer.scale.pixels(layer.tubes[number - 1].surface->tubeRadius, ahead);
                const CoveredLight seen =
                    lightOf(layer.shaded, x - box.x, y - box.y, mark, depth, radius < shadedRadius);
                if (seen.cover > 0.0F) light.add(seen, 0.25F * std::min(radius / coveringRadius, 1.0F));
            }
            const auto to = static_cast<std::size_t>(y * width + x);
            const float below = picture.alpha.empty() ? 1.0F : static_cast<float>(picture.alpha[to]) / 255.0F;
            light.add(picture.colours[to], below * (1.0F - light.cover));
            picture.colours[to] = light.colour() | 0xff000000U;
            if (!picture.alpha.empty()) picture.alpha[to] = static_cast<std::uint8_t>(255.0F * light.cover + 0.5F);
        }
    }
}

}  // namespace

PixelScale::PixelScale(const view::Camera& camera, glm::ivec2 size)
    : eye_(camera.eye),
      forward_(axesOf(camera).forward),
      focal_(0.5F * static_cast<float>(size.y) / std::tan(0.5F * verticalField(camera, size))) {}

bool isThin(const DrawItem& item, const PixelScale& scale) {
    const float radius = item.surface->tubeRadius;
    if (!(radius > 0.0F)) return false;
    float farthest = 0.0F;
    for (const glm::vec3& corner : item.bounds.corners()) farthest = std::max(farthest, scale.ahead(corner));
    return farthest > 0.0F && scale.pixels(radius, farthest) < coveringRadius;
}

view::Surface widened(const view::Surface& tube, const PixelScale& scale, float radius) {
    auto geometry = std::make_shared<view::Geometry>(*tube.geometry);
    for (std::size_t i = 0; i < geometry->positions.size(); ++i) {
        const float ahead = scale.ahead(glm::vec3(tube.transform * glm::vec4(geometry->positions[i], 1.0F)));
        const float more = scale.length(radius, std::max(ahead, 0.0F)) - tube.tubeRadius;
        if (more > 0.0F) geometry->positions[i] += more * geometry->normals[i];
    }
    view::Surface wide = tube;
    wide.geometry = std::move(geometry);
    return wide;
}

void layThinTubes(const ThinLayer& layer, const EdgeView& view, EdgeTriangles& triangles, Drawn& picture) {
    if (layer.shaded.box.width == 0 || layer.shaded.box.height == 0) return;
    const std::vector<PixelBox> found = edgeTiles(layer.shaded);
    triangles.find(layer.tubes, layer.others, view, layer.shaded.box, found);
    const DepthScale depths(view);
    forEachTile(triangles, [&](const PixelBox& tile, const CoveredTile& covered) {
        layTile(tile, covered, layer, depths, view.size.x, picture);
    });
}

}  // namespace taut::render
