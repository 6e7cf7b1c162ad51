#include "taut/render/private/targets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "taut/core/error.h"
#include "taut/render/private/program.h"

namespace taut::render {

namespace {

void expectSize(const Gl& gl, int width, int height) {
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        throw core::Error(core::ErrorKind::badContent,
                          "a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                              " cannot be drawn: each side must be 1 to " + std::to_string(largest) + " pixels");
    }
}

void expectComplete(const Gl& gl) {
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    throw core::Error(core::ErrorKind::noRenderer, "no renderer: GL cannot draw into the targets that a picture needs");
}

}  // namespace

Targets::Targets(const Gl& gl, int width, int height)
    : gl_(&gl),
      width_(width),
      height_(height),
      colour_(gl, GlKind::renderbuffer),
      target_(gl, GlKind::framebuffer),
      surfaceTarget_(gl, GlKind::framebuffer),
      hiddenTarget_(gl, GlKind::framebuffer),
      putTarget_(gl, GlKind::framebuffer) {
    expectSize(gl, width, height);
    const auto attach = [&](const GlObject& target, GLenum point, const GlObject& texture) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.id());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture.id(), 0);
    };

    // Shaded picture.
    gl.BindRenderbuffer(GL_RENDERBUFFER, colour_.id());
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, width, height);
    depth_ = texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, width, height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target_.id());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
    attach(target_, GL_DEPTH_ATTACHMENT, depth_);
    expectComplete(gl);

    // What is seen of surfaces, in front of the same depth.
    tints_ = texture(GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, width, height);
    shapes_ = texture(GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, width, height);
    attach(surfaceTarget_, GL_COLOR_ATTACHMENT0, tints_);
    attach(surfaceTarget_, GL_COLOR_ATTACHMENT1, shapes_);
    attach(surfaceTarget_, GL_DEPTH_ATTACHMENT, depth_);
    const std::array<GLenum, 2> both{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    gl.DrawBuffers(2, both.data());
    expectComplete(gl);

    hidden_ = texture(GL_RG32F, GL_RG, GL_FLOAT, (width + 1) / 2, (height + 1) / 2);
    attach(hiddenTarget_, GL_COLOR_ATTACHMENT0, hidden_);
    expectComplete(gl);
}

GlObject Targets::texture(GLenum format, GLenum layout, GLenum type, int width, int height) const {
    GlObject object(*gl_, GlKind::texture);
    gl_->BindTexture(GL_TEXTURE_2D, object.id());
    gl_->TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, layout, type, nullptr);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return object;
}

void Targets::bindTexture(int unit, const GlObject& object) const {
    gl_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_->BindTexture(GL_TEXTURE_2D, object.id());
}

void Targets::bind(const GlObject& target, int width, int height) const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, target.id());
    gl_->Viewport(0, 0, width, height);
}

void Targets::bindSurfaces() const {
    bind(surfaceTarget_, width_, height_);
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
}

void Targets::bindHidden() const {
    bind(hiddenTarget_, (width_ + 1) / 2, (height_ + 1) / 2);
    bindTexture(hiddenUnit, depth_);
    bindTexture(shapesUnit, shapes_);
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
}

void Targets::bindShading() const {
    bind(target_, width_, height_);
    bindTexture(tintsUnit, tints_);
    bindTexture(shapesUnit, shapes_);
    bindTexture(hiddenUnit, hidden_);
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
}

void Targets::colours(std::vector<std::uint32_t>& to) const {
    to.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, to.data());
}

void Targets::depths(const PixelBox& part, std::vector<float>& to) const {
    to.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->ReadPixels(part.x, part.y, part.width, part.height, GL_DEPTH_COMPONENT, GL_FLOAT, to.data());
}

std::vector<float> Targets::nearness(const PixelBox& part) const {
    const std::size_t count = static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height);
    std::vector<std::array<std::uint32_t, 4>> shapes(count);
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, surfaceTarget_.id());
    gl_->ReadBuffer(GL_COLOR_ATTACHMENT1);
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->ReadPixels(part.x, part.y, part.width, part.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, shapes.data());
    std::vector<float> nearness;
    nearness.reserve(count);
    for (const std::array<std::uint32_t, 4>& shape : shapes) nearness.push_back(std::bit_cast<float>(shape[2]));
    return nearness;
}

void Targets::put(std::span<const std::uint32_t> colours) {
    if (putColour_.id() == 0) {
        putColour_ = texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width_, height_);
        gl_->BindFramebuffer(GL_FRAMEBUFFER, putTarget_.id());
        gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, putColour_.id(), 0);
        expectComplete(*gl_);
    }
    gl_->BindTexture(GL_TEXTURE_2D, putColour_.id());
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, colours.data());
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, putTarget_.id());
    gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target_.id());
    gl_->BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace taut::render
