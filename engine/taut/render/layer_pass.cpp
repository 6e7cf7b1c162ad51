#include "taut/render/private/layer_pass.h"

#include <utility>

#include "taut/render/private/edge_pass.h"

namespace taut::render {

FlatPass::FlatPass(const Gl& gl, Program program, glm::ivec2 size)
    : gl_(&gl),
      program_(std::move(program)),
      size_(size),
      colour_(gl, GlKind::renderbuffer),
      depth_(gl, GlKind::renderbuffer),
      target_(gl, GlKind::framebuffer) {
    gl.BindRenderbuffer(GL_RENDERBUFFER, colour_.id());
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.x, size.y);
    gl.BindRenderbuffer(GL_RENDERBUFFER, depth_.id());
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size.x, size.y);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target_.id());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
}

void FlatPass::draw(const LayerScene& scene, image::Layer& layer) {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, target_.id());
    gl_->Viewport(0, 0, size_.x, size_.y);
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->DepthMask(GL_TRUE);
    gl_->ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
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

    const auto row = 3 * static_cast<std::size_t>(size_.x);
    std::vector<std::uint8_t> below(row * static_cast<std::size_t>(size_.y));
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->ReadPixels(0, 0, size_.x, size_.y, GL_RGB, GL_UNSIGNED_BYTE, below.data());
    layer.rgb.reserve(below.size());
    for (auto first = below.end(); first != below.begin(); first -= static_cast<std::ptrdiff_t>(row))
        layer.rgb.insert(layer.rgb.end(), first - static_cast<std::ptrdiff_t>(row), first);
}

}  // namespace taut::render
