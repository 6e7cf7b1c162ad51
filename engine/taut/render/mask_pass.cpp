#include "taut/render/mask_pass.h"

#include <algorithm>
#include <utility>

namespace taut::render {

MaskPass::MaskPass(const Gl& gl, const ShaderFolder& shaders, glm::ivec2 size,
                   std::map<std::string, std::uint32_t> colours)
    : gl_(&gl),
      program_(shaders.program("mask.vert", "mask.frag")),
      size_(size),
      colours_(std::move(colours)),
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

std::vector<std::uint8_t> MaskPass::draw(std::span<const DrawItem> items, const MeshCache& meshes, glm::vec4 seenSide) {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, target_.id());
    gl_->Viewport(0, 0, size_.x, size_.y);
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->DepthMask(GL_TRUE);
    gl_->ClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    program_.use();
    program_.set("seenSide", seenSide);
    for (const DrawItem& item : items) {
        const auto known = colours_.find(item.surface->name);
        const std::uint32_t flat = known == colours_.end() ? 0 : known->second;
        program_.set("flatColour", glm::vec3(flat >> 16 & 255U, flat >> 8 & 255U, flat & 255U) / 255.0F);
        program_.set("transform", item.surface->transform);
        if (item.surface->twoSided)
            gl_->Disable(GL_CULL_FACE);
        else
            gl_->Enable(GL_CULL_FACE);
        meshes.draw(item);
    }
    gl_->Disable(GL_CULL_FACE);

    const auto row = 3 * static_cast<std::size_t>(size_.x);
    std::vector<std::uint8_t> below(row * static_cast<std::size_t>(size_.y)), mask;
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->ReadPixels(0, 0, size_.x, size_.y, GL_RGB, GL_UNSIGNED_BYTE, below.data());
    mask.reserve(below.size());
    for (auto first = below.end(); first != below.begin(); first -= static_cast<std::ptrdiff_t>(row))
        mask.insert(mask.end(), first - static_cast<std::ptrdiff_t>(row), first);
    return mask;
}

}  // namespace taut::render
