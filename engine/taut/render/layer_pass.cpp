#include "taut/render/private/layer_pass.h"

#include <algorithm>
#include <utility>

#include "taut/render/private/edge_pass.h"

namespace taut::render {

LayerTarget::LayerTarget(const Gl& gl, glm::ivec2 size, bool isWide)
    : gl_(&gl),
      size_(size),
      isWide_(isWide),
      colour_(gl, GlKind::renderbuffer),
      depth_(gl, GlKind::renderbuffer),
      target_(gl, GlKind::framebuffer) {
    gl.BindRenderbuffer(GL_RENDERBUFFER, colour_.id());
    gl.RenderbufferStorage(GL_RENDERBUFFER, isWide ? GL_RGBA16 : GL_RGBA8, size.x, size.y);
    gl.BindRenderbuffer(GL_RENDERBUFFER, depth_.id());
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size.x, size.y);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target_.id());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
}

void LayerTarget::begin() const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, target_.id());
    gl_->Viewport(0, 0, size_.x, size_.y);
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->DepthMask(GL_TRUE);
    gl_->ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
}

void LayerTarget::read(image::Layer& layer) const {
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    const auto readRows = [&](auto& numbers, GLenum type) {
        const auto row = 3 * static_cast<std::size_t>(size_.x), rows = static_cast<std::size_t>(size_.y);
        numbers.resize(row * rows);
        gl_->ReadPixels(0, 0, size_.x, size_.y, GL_RGB, type, numbers.data());
        for (std::size_t y = 0; y < rows / 2; ++y)
            std::swap_ranges(numbers.data() + y * row, numbers.data() + (y + 1) * row,
                             numbers.data() + (rows - 1 - y) * row);
    };
    if (isWide_)
        readRows(layer.numbers, GL_UNSIGNED_SHORT);
    else
        readRows(layer.rgb, GL_UNSIGNED_BYTE);
}

FlatPass::FlatPass(const Gl& gl, Program program, glm::ivec2 size)
    : gl_(&gl), program_(std::move(program)), target_(gl, size, false) {}

void FlatPass::draw(const LayerScene& scene, image::Layer& layer) {
    target_.begin();
    program_.use();
    program_.set("seenSide", seenSideOf(scene.view));
    for (const DrawItem& item : scene.items) {
        begin(program_, scene, *item.surface);
        program_.set("transform", item.surface->transform);
        if (item.surface->twoSided)
            gl_->Disable(GL_CULL_FACE);
        else
            gl_->Enable(GL_CULL_FACE);
        scene.meshes.draw(item);
    }
    gl_->Disable(GL_CULL_FACE);
    target_.read(layer);
}

}  // namespace taut::render
