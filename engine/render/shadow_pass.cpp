#include "taut/render/shadow_pass.h"

#include <array>
#include <string>

#include "taut/core/error.h"

namespace taut::render {

namespace {

int checkedSize(const Gl& gl, int texels) {
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (texels < boundsEdge || texels % boundsEdge != 0 || texels > largest) {
        throw core::Error(core::ErrorKind::badContent,
                          "a shadow map of " + std::to_string(texels) +
                              " texels cannot be drawn: it must be a multiple of 128, at most " +
                              std::to_string(largest));
    }
    return texels;
}

// Half a texel keeps surfaces from shading themselves: a step of 16 bits is a sixteenth of that, or less.
GLenum depthFormat(int texels) {
    return texels <= 2048 ? GL_DEPTH_COMPONENT16 : GL_DEPTH_COMPONENT32F;
}

}  // namespace

ShadowPass::ShadowPass(const Gl& gl, const ShaderFolder& shaders, int texels)
    : gl_(&gl),
      depth_(shaders.program("shadow.vert", "shadow.frag")),
      reduce_(shaders.program("screen.vert", "shadow_reduce.frag",
                              {"BLOCK " + std::to_string(checkedSize(gl, texels) / boundsEdge)})),
      spread_(shaders.program("screen.vert", "shadow_spread.frag")),
      map_(gl, texels, depthFormat(texels), GL_NEAREST, 1.0F),
      blocks_(gl, boundsEdge, GL_RG32F, GL_NEAREST, 1.0F),
      neighbourhood_(gl, boundsEdge, GL_RG32F, GL_LINEAR, 1.0F),
      comparing_(gl, GlKind::sampler),
      empty_(gl, GlKind::vertexArray) {
    const std::array<float, 4> lit{1.0F, 1.0F, 1.0F, 1.0F};
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl.SamplerParameterfv(comparing_.id(), GL_TEXTURE_BORDER_COLOR, lit.data());
}

void ShadowPass::draw(std::span<const DrawItem> items, const MeshCache& meshes, const LightBox& box, bool anew) {
    std::vector<const DrawItem*> still, moving;
    for (const DrawItem& item : items) (item.isStill && !anew ? still : moving).push_back(&item);
    if (keep(still, meshes, box)) {
        gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, still_->target.id());
        gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, map_.target.id());
        gl_->BlitFramebuffer(0, 0, map_.size, map_.size, 0, 0, map_.size, map_.size, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
        map_.bind(*gl_);
    } else {
        map_.bind(*gl_);
        gl_->DepthMask(GL_TRUE);
        gl_->ClearDepth(1.0);
        gl_->Clear(GL_DEPTH_BUFFER_BIT);
        drawDepth(still, meshes, box);
    }
    drawDepth(moving, meshes, box);
    drawBounds();
}

// Whether still_ holds these items. It is drawn when they are met a second time.
bool ShadowPass::keep(std::span<const DrawItem* const> still, const MeshCache& meshes, const LightBox& box) {
    std::vector<Shape> shapes;
    for (const DrawItem* item : still) shapes.push_back(item->shape);
    const bool isSame = !shapes.empty() && box.toMap == stillBox_ && shapes == stillShapes_;
    if (isSame && !isKept_) {
        if (!still_) still_.emplace(*gl_, map_.size, depthFormat(map_.size), GL_NEAREST, 1.0F);
        still_->bind(*gl_);
        gl_->DepthMask(GL_TRUE);
        gl_->ClearDepth(1.0);
        gl_->Clear(GL_DEPTH_BUFFER_BIT);
        drawDepth(still, meshes, box);
    }
    stillBox_ = box.toMap;
    stillShapes_ = std::move(shapes);
    isKept_ = isSame;
    return isKept_;
}

// Casters outside the box sideways are clipped; the box holds all of them along the light.
void ShadowPass::drawDepth(std::span<const DrawItem* const> items, const MeshCache& meshes, const LightBox& box) {
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(GL_TRUE);
    depth_.use();
    for (const DrawItem* item : items) {
        // Of closed things the sides towards the light are enough.
        if (item->surface->twoSided)
            gl_->Disable(GL_CULL_FACE);
        else
            gl_->Enable(GL_CULL_FACE);
        depth_.set("toMap", box.toMap * item->surface->transform);
        meshes.drawShape(*item);
    }
    gl_->Disable(GL_CULL_FACE);
}

// Least and largest depth: of each block, then of its neighbourhood.
void ShadowPass::drawBounds() {
    gl_->Disable(GL_DEPTH_TEST);
    gl_->BindVertexArray(empty_.id());
    gl_->ActiveTexture(GL_TEXTURE0 + shadowBoundsUnit);
    gl_->BindSampler(shadowBoundsUnit, 0);
    blocks_.bind(*gl_);
    gl_->BindTexture(GL_TEXTURE_2D, map_.texture.id());
    reduce_.use();
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    neighbourhood_.bind(*gl_);
    gl_->BindTexture(GL_TEXTURE_2D, blocks_.texture.id());
    spread_.use();
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

void ShadowPass::bindMaps() const {
    gl_->ActiveTexture(GL_TEXTURE0 + shadowMapUnit);
    gl_->BindTexture(GL_TEXTURE_2D, map_.texture.id());
    gl_->BindSampler(shadowMapUnit, comparing_.id());
    gl_->ActiveTexture(GL_TEXTURE0 + shadowDepthUnit);
    gl_->BindTexture(GL_TEXTURE_2D, map_.texture.id());
    gl_->ActiveTexture(GL_TEXTURE0 + shadowBoundsUnit);
    gl_->BindTexture(GL_TEXTURE_2D, neighbourhood_.texture.id());
    gl_->BindSampler(shadowBoundsUnit, 0);
}

}  // namespace taut::render
