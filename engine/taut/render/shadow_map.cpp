#include "taut/render/private/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/parallel.h"

namespace taut::render {

namespace {

constexpr std::uint16_t untouched = 65535;

}  // namespace

bool isLit(std::span<const glm::vec2> bounds, std::span<const glm::vec3, 4> corners) {
    glm::vec3 low = corners[0], high = corners[0];
    for (const glm::vec3& corner : corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    // The texels between which a shader may filter; outside everything is lit.
    constexpr auto edge = static_cast<float>(boundsEdge);
    const glm::ivec2 first(glm::clamp(glm::floor(edge * glm::vec2(low) - 0.5F), 0.0F, edge));
    const glm::ivec2 last(glm::clamp(glm::floor(edge * glm::vec2(high) + 0.5F), -1.0F, edge - 1.0F));
    const float depth = std::min(high.z, 1.0F) - 0.0004F;  // shadow.glsl grants a little more
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            if (bounds[static_cast<std::size_t>(y * boundsEdge + x)].x < depth) return false;
    return true;
}

ShadowMap::ShadowMap(int texels) : edge_(texels) {
    TAUT_EXPECTS(texels >= boundsEdge && texels % boundsEdge == 0);
    depths_.assign(static_cast<std::size_t>(edge_) * static_cast<std::size_t>(edge_), untouched);
    blocks_.assign(static_cast<std::size_t>(boundsEdge) * boundsEdge, glm::vec2(1.0F));
    bounds_ = blocks_;
    isDrawn_.assign(strips, 0);
    triangles_.resize(strips);
}

void ShadowMap::draw(std::span<const DrawItem> items, const LightBox& box) {
    for (std::vector<MapTriangle>& triangles : triangles_) triangles.clear();
    for (const DrawItem& item : items) addTriangles(item, box);

    // What was drawn before is taken away where nothing is drawn now.
    const DepthKernels kernels = depthKernels();
    changed_.assign(strips, 0);
    core::parallelFor(strips, [&](int strip) {
        const auto number = static_cast<std::size_t>(strip);
        const std::vector<MapTriangle>& triangles = triangles_[number];
        changed_[number] = isDrawn_[number] != 0 || !triangles.empty() ? 1 : 0;
        isDrawn_[number] = triangles.empty() ? 0 : 1;
        if (changed_[number] == 0) return;
        const int low = strip * rowsAStrip(), high = low + rowsAStrip() - 1;
        std::fill_n(depths_.begin() + static_cast<std::ptrdiff_t>(low) * edge_,
                    static_cast<std::ptrdiff_t>(rowsAStrip()) * edge_, untouched);
        kernels.drawTriangles(triangles.data(), static_cast<int>(triangles.size()), edge_, low, high, depths_.data());
        findBlocks(strip, kernels);
    });
    bounds_ = boundsWithin(2);
}

void ShadowMap::findBlocks(int strip, const DepthKernels& kernels) {
    const int block = edge_ / boundsEdge;
    constexpr int rows = boundsEdge / strips;
    std::vector<std::uint16_t> least(static_cast<std::size_t>(edge_)), largest(least.size());
    for (int row = strip * rows; row < (strip + 1) * rows; ++row) {
        kernels.findBounds(depths_.data() + static_cast<std::ptrdiff_t>(row) * block * edge_, edge_, block,
                           least.data(), largest.data());
        for (int i = 0; i < boundsEdge; ++i) {
            const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(i) * block;
            const auto low = *std::min_element(least.begin() + begin, least.begin() + begin + block);
            const auto high = *std::max_element(largest.begin() + begin, largest.begin() + begin + block);
            blocks_[static_cast<std::size_t>(row * boundsEdge + i)] = glm::vec2(low, high) / 65535.0F;
        }
    }
}

// Of closed things the sides towards the light are enough.
void ShadowMap::addTriangles(const DrawItem& item, const LightBox& box) {
    const view::Surface& surface = *item.surface;
    const glm::mat4 toMap = box.toMap * surface.transform;
    const auto size = static_cast<float>(edge_), stripSize = static_cast<float>(rowsAStrip());
    places_.clear();
    for (const glm::vec3& position : surface.geometry->positions) {
        const glm::vec3 place(toMap * glm::vec4(position, 1.0F));
        places_.emplace_back(size * place.x, size * place.y, std::clamp(place.z, 0.0F, 1.0F));
    }
    const std::vector<std::uint32_t>& corners = surface.topology->triangles;
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
        const glm::vec3 &a = places_[corners[t]], &b = places_[corners[t + 1]], &c = places_[corners[t + 2]];
        if (!surface.twoSided && (b.x - a.x) * (c.y - a.y) <= (b.y - a.y) * (c.x - a.x)) continue;
        // To a strip that is missed by rounding the triangle says so itself.
        const float low = (std::min({a.y, b.y, c.y}) - 1.0F) / stripSize,
                    high = (std::max({a.y, b.y, c.y}) + 1.0F) / stripSize;
        if (!(high >= 0.0F && low < static_cast<float>(strips))) continue;
        const int last = std::min(static_cast<int>(high), strips - 1);
        for (int strip = static_cast<int>(std::max(low, 0.0F)); strip <= last; ++strip)
            triangles_[static_cast<std::size_t>(strip)].push_back({{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}});
    }
}

std::vector<glm::vec2> ShadowMap::boundsWithin(int reach) const {
    const auto at = [](int row, int column) { return static_cast<std::size_t>(row * boundsEdge + column); };
    const auto joined = [](glm::vec2 a, glm::vec2 b) { return glm::vec2(std::min(a.x, b.x), std::max(a.y, b.y)); };
    const auto widened = [&](const std::vector<glm::vec2>& from, bool alongRows, int row, int column) {
        const int middle = alongRows ? column : row;
        glm::vec2 found(1.0F, 0.0F);
        for (int i = middle - reach; i <= middle + reach; ++i) {
            const bool isOutside = i < 0 || i >= boundsEdge;
            found = joined(found, isOutside ? glm::vec2(1.0F) : from[alongRows ? at(row, i) : at(i, column)]);
        }
        return found;
    };
    std::vector<glm::vec2> rows(blocks_.size()), bounds(blocks_.size());
    for (int row = 0; row < boundsEdge; ++row)
        for (int column = 0; column < boundsEdge; ++column) rows[at(row, column)] = widened(blocks_, true, row, column);
    for (int row = 0; row < boundsEdge; ++row)
        for (int column = 0; column < boundsEdge; ++column) bounds[at(row, column)] = widened(rows, false, row, column);
    return bounds;
}

}  // namespace taut::render
