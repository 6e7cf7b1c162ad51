#include "taut/render/occlusion_pass.h"

#include <algorithm>
#include <array>

namespace taut::render {

namespace {

constexpr float margin = 0.8F;   // [m] how far the darkening reaches around things
constexpr float nothing = 1e4F;  // [m] height where there is no surface

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

OcclusionPass::OcclusionPass(const Gl& gl, const ShaderFolder& shaders)
    : gl_(&gl),
      heights_(shaders.program("heights.vert", "heights.frag")),
      gather_(shaders.program("screen.vert", "occlusion.frag")),
      blur_(shaders.program("screen.vert", "occlusion_blur.frag")),
      columns_(gl, occlusionEdge, GL_RG32F, GL_NEAREST, nothing),
      rough_(gl, occlusionEdge, GL_R16F, GL_NEAREST, 0.0F),
      map_(gl, occlusionEdge, GL_R16F, GL_LINEAR, 0.0F),
      empty_(gl, GlKind::vertexArray) {
    map_.bind(gl);  // read also where nothing has been drawn into it
    const std::array<float, 4> open{};
    gl.ClearBufferfv(GL_COLOR, 0, open.data());
}

void OcclusionPass::draw(std::span<const DrawItem> items, const MeshCache& meshes, const OcclusionArea& area,
                         float groundHeight, bool anew) {
    std::vector<Shape> low;
    for (const DrawItem& item : items)
        if (item.bounds.low.y <= groundHeight + occlusionCeiling) low.push_back(item.shape);
    if (!anew && area == area_ && groundHeight == groundHeight_ && low == low_) return;
    area_ = area;
    groundHeight_ = groundHeight;
    low_ = std::move(low);

    // Lowest and highest surface in one go: the least of h and of -h.
    columns_.bind(*gl_);
    gl_->Disable(GL_DEPTH_TEST);
    gl_->Disable(GL_CULL_FACE);
    const std::array<float, 4> clear{nothing, nothing, nothing, nothing};
    gl_->ClearBufferfv(GL_COLOR, 0, clear.data());
    gl_->Enable(GL_BLEND);
    gl_->BlendEquation(GL_MIN);
    heights_.use();
    const glm::vec2 size = area.high - area.low;
    heights_.set("area", glm::vec4(area.low, size));
    heights_.set("groundHeight", groundHeight);
    for (const DrawItem& item : items) {
        if (item.bounds.low.y > groundHeight + occlusionCeiling) continue;
        heights_.set("transform", item.surface->transform);
        meshes.drawShape(item);
    }
    gl_->BlendEquation(GL_FUNC_ADD);
    gl_->Disable(GL_BLEND);

    rough_.bind(*gl_);
    gl_->BindVertexArray(empty_.id());
    gl_->ActiveTexture(GL_TEXTURE0 + occlusionUnit);
    gl_->BindTexture(GL_TEXTURE_2D, columns_.texture.id());
    gather_.use();
    gather_.set("texel", size / static_cast<float>(occlusionEdge));
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);

    map_.bind(*gl_);
    gl_->BindTexture(GL_TEXTURE_2D, rough_.texture.id());
    blur_.use();
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

void OcclusionPass::bindMap() const {
    gl_->ActiveTexture(GL_TEXTURE0 + occlusionUnit);
    gl_->BindTexture(GL_TEXTURE_2D, map_.texture.id());
}

}  // namespace taut::render
