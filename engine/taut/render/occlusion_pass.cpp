#include "taut/render/private/occlusion_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "taut/render/private/program.h"

namespace taut::render {

namespace {

constexpr float margin = 0.8F;   // [m] how far the darkening reaches around things
constexpr float nothing = 1e4F;  // [m] height where there is no surface

// Columns are kept row by row, in each those of even places first; what lies beyond the edge is like the last before.
constexpr int around = 16;  // [texels] farther than anything is looked at
constexpr int rowLength = occlusionEdge + 2 * around;
std::size_t columnAt(int row, int column) {
    return static_cast<std::size_t>((row + around) * rowLength + ((column & 1) != 0 ? rowLength / 2 : 0) +
                                    (column + around) / 2);
}

}  // namespace

std::optional<OcclusionArea> occlusionArea(std::span<const Bounds> casters, float groundHeight) {
    Bounds all;
    for (const Bounds& caster : casters) {
        if (caster.empty || caster.low.y > groundHeight + occlusionCeiling || caster.high.y < groundHeight) continue;
        all.include(caster.low);
        all.include(caster.high);
    }
    if (all.empty) return std::nullopt;
    // Sizes in steps and places on a raster: the texels stay where they are while things move.
    OcclusionArea area;
    for (const int axis : {0, 2}) {
        constexpr float step = 0.5F;
        const int flat = axis / 2;
        area.low[flat] = step * std::floor((all.low[axis] - margin) / step);
        area.high[flat] = step * std::ceil((all.high[axis] + margin) / step);
    }
    return area;
}

OcclusionPass::OcclusionPass(const Gl& gl)
    : gl_(&gl),
      texture_(gl, GlKind::texture),
      heights_(static_cast<std::size_t>(occlusionEdge) * occlusionEdge),
      low_(static_cast<std::size_t>(rowLength) * rowLength),
      high_(low_.size()),
      hidden_(heights_.size()),
      smooth_(heights_.size()) {
    constexpr std::array<float, 4> open{0.0F, 0.0F, 0.0F, 0.0F};
    gl.BindTexture(GL_TEXTURE_2D, texture_.id());
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, occlusionEdge, occlusionEdge, 0, GL_RED, GL_FLOAT, smooth_.data());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, open.data());
}

void OcclusionPass::draw(std::span<const DrawItem> items, const OcclusionArea& area, float groundHeight, bool anew) {
    std::vector<ShadowShape> shapes;
    for (const DrawItem& item : items)
        if (item.bounds.low.y <= groundHeight + occlusionCeiling) shapes.push_back(item.shape);
    if (!anew && area == area_ && groundHeight == groundHeight_ && shapes == shapes_) return;
    area_ = area;
    groundHeight_ = groundHeight;
    shapes_ = std::move(shapes);

    addTriangles(items);
    findColumns();
    gather();
    blur();
    gl_->ActiveTexture(GL_TEXTURE0 + occlusionUnit);
    gl_->BindTexture(GL_TEXTURE_2D, texture_.id());
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, occlusionEdge, occlusionEdge, GL_RED, GL_FLOAT, smooth_.data());
}

// Heights go up to the width of the map: from there on a column hides all the sky. They must not depend on what is
// drawn, or else what moves would change what lies elsewhere.
void OcclusionPass::addTriangles(std::span<const DrawItem> items) {
    const glm::vec2 scale = static_cast<float>(occlusionEdge) / (area_.high - area_.low);
    triangles_.clear();
    for (const DrawItem& item : items) {
        if (item.bounds.low.y > groundHeight_ + occlusionCeiling) continue;
        const view::Surface& surface = *item.surface;
        places_.clear();
        for (const glm::vec3& position : surface.geometry->positions) {
            const glm::vec3 at(surface.transform * glm::vec4(position, 1.0F));
            const glm::vec2 on = scale * (glm::vec2(at.x, at.z) - area_.low);
            places_.emplace_back(on.x, on.y,
                                 std::clamp((at.y - groundHeight_) / highest(), 0.0F, 1.0F) * (65534.0F / 65535.0F));
        }
        const std::vector<std::uint32_t>& corners = surface.topology->triangles;
        for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
            const glm::vec3 &a = places_[corners[t]], &b = places_[corners[t + 1]], &c = places_[corners[t + 2]];
            triangles_.push_back({{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}});
        }
    }
}

// Lowest and highest surface above each place.
void OcclusionPass::findColumns() {
    constexpr std::uint16_t untouched = 65535;
    const float step = highest() / 65534.0F;  // [m]
    const DepthKernels kernels = depthKernels();
    const auto draw = [&](std::vector<float>& heights, const auto& heightOf) {
        std::fill(heights_.begin(), heights_.end(), untouched);
        kernels.drawTriangles(triangles_.data(), static_cast<int>(triangles_.size()), occlusionEdge, 0,
                              occlusionEdge - 1, heights_.data());
        for (int row = -around; row < occlusionEdge + around; ++row) {
            const int from = std::clamp(row, 0, occlusionEdge - 1) * occlusionEdge;
            for (int column = -around; column < occlusionEdge + around; ++column) {
                const auto height = heights_[static_cast<std::size_t>(from + std::clamp(column, 0, occlusionEdge - 1))];
                heights[columnAt(row, column)] = heightOf(height);
            }
        }
    };
    draw(low_, [&](std::uint16_t height) { return height == untouched ? nothing : step * static_cast<float>(height); });
    for (MapTriangle& triangle : triangles_)
        for (float& depth : triangle.depth) depth = 65534.0F / 65535.0F - depth;
    draw(high_,
         [&](std::uint16_t height) { return height == untouched ? 0.0F : step * static_cast<float>(65534 - height); });
}

// Which part of the sky the columns around a place hide, weighted by the cosine: a column between the elevations a and
// b, seen over the angle w, hides (sin² b - sin² a) w / 2π. Four places together look into four times as many
// directions; blur() joins them.
void OcclusionPass::gather() {
    constexpr int ways = 8;
    const glm::vec2 texel = (area_.high - area_.low) / static_cast<float>(occlusionEdge);
    const float size = 0.5F * (texel.x + texel.y);
    const DepthKernels kernels = depthKernels();
    std::array<float, occlusionEdge / 2> sum{};
    for (int row = 0; row < occlusionEdge; ++row) {
        for (int odd = 0; odd < 2; ++odd) {
            sum.fill(0.0F);
            const float turn = 0.25F * static_cast<float>(odd + 2 * (row & 1));
            for (int way = 0; way < ways; ++way) {
                const float angle = 2.0F * std::numbers::pi_v<float> * (static_cast<float>(way) + turn) / ways;
                const float along = std::cos(angle), up = std::sin(angle);
                SkyRing rings[skyRings];
                float radius = 0.5F;
                for (SkyRing& ring : rings) {
                    const std::size_t first = columnAt(row + static_cast<int>(std::nearbyint(up * radius)),
                                                       odd + static_cast<int>(std::nearbyint(along * radius)));
                    ring = {low_.data() + first, high_.data() + first, radius * size};
                    radius *= 1.6F;
                }
                kernels.addHidden(rings, occlusionEdge / 2, sum.data());
            }
            for (int i = 0; i < occlusionEdge / 2; ++i)
                hidden_[static_cast<std::size_t>(row * occlusionEdge + 2 * i + odd)] =
                    sum[static_cast<std::size_t>(i)] / ways;
        }
    }
}

void OcclusionPass::blur() {
    const auto widened = [](const std::vector<float>& from, std::vector<float>& to, bool alongRows) {
        for (int row = 0; row < occlusionEdge; ++row) {
            for (int column = 0; column < occlusionEdge; ++column) {
                float sum = 0.0F;
                for (int i = -2; i <= 2; ++i) {
                    const int y = alongRows ? row : std::clamp(row + i, 0, occlusionEdge - 1);
                    const int x = alongRows ? std::clamp(column + i, 0, occlusionEdge - 1) : column;
                    sum += static_cast<float>(3 - std::abs(i)) * from[static_cast<std::size_t>(y * occlusionEdge + x)];
                }
                to[static_cast<std::size_t>(row * occlusionEdge + column)] = sum / 9.0F;
            }
        }
    };
    widened(hidden_, smooth_, true);
    std::swap(hidden_, smooth_);
    widened(hidden_, smooth_, false);
}

void OcclusionPass::bindMap() const {
    gl_->ActiveTexture(GL_TEXTURE0 + occlusionUnit);
    gl_->BindTexture(GL_TEXTURE_2D, texture_.id());
}

}  // namespace taut::render
