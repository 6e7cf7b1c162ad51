#include "taut/render/targets.h"

#include <algorithm>
#include <array>
#include <string>

#include "taut/core/error.h"
#include "taut/render/program.h"

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

Targets::Targets(const Gl& gl, int width, int height, int samples)
    : gl_(&gl),
      width_(width),
      height_(height),
      smooth_(samples == 4),
      colour_(gl, GlKind::renderbuffer),
      target_(gl, GlKind::framebuffer),
      surfaceTarget_(gl, GlKind::framebuffer),
      copyTarget_(gl, GlKind::framebuffer),
      coverage_(gl, GlKind::texture),
      coverageDepth_(gl, GlKind::renderbuffer),
      coverageTarget_(gl, GlKind::framebuffer),
      resolveTarget_(gl, GlKind::framebuffer) {
    expectSize(gl, width, height);
    if (samples != 1 && samples != 4) {
        throw core::Error(core::ErrorKind::badContent,
                          "anti-aliasing takes 1 or 4 samples a pixel, not " + std::to_string(samples));
    }
    const auto storage = [&](const GlObject& buffer, GLenum format, int count) {
        gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.id());
        gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count, format, width, height);
    };
    const auto attach = [&](const GlObject& target, GLenum point, const GlObject& buffer) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.id());
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer.id());
    };
    const auto attachTexture = [&](const GlObject& target, GLenum point, GLenum kind, const GlObject& texture) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.id());
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, point, kind, texture.id(), 0);
    };

    // Shaded picture: colour to be drawn into, a copy of its bytes and its depth to be read.
    storage(colour_, GL_SRGB8_ALPHA8, 0);
    depth_ = texture(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
    attach(target_, GL_COLOR_ATTACHMENT0, colour_);
    attachTexture(target_, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_);
    expectComplete(gl);

    // What is seen of surfaces, in front of the same depth.
    tints_ = texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
    shapes_ = texture(GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT);
    attachTexture(surfaceTarget_, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, tints_);
    attachTexture(surfaceTarget_, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, shapes_);
    attachTexture(surfaceTarget_, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_);
    const std::array<GLenum, 2> both{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    gl.DrawBuffers(2, both.data());
    expectComplete(gl);
    if (!smooth_) return;
    copiedColour_ = texture(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
    attachTexture(copyTarget_, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, copiedColour_);
    expectComplete(gl);

    // What covers each sample.
    gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, coverage_.id());
    gl.TexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, GL_RGBA8, width, height, GL_TRUE);
    storage(coverageDepth_, GL_DEPTH_COMPONENT32F, samples);
    attach(coverageTarget_, GL_DEPTH_ATTACHMENT, coverageDepth_);
    attachTexture(coverageTarget_, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, coverage_);
    expectComplete(gl);

    // The same colour without depth: a texture cannot be read while it is attached.
    attach(resolveTarget_, GL_COLOR_ATTACHMENT0, colour_);
    expectComplete(gl);
}

GlObject Targets::texture(GLenum format, GLenum layout, GLenum type) const {
    GlObject object(*gl_, GlKind::texture);
    gl_->BindTexture(GL_TEXTURE_2D, object.id());
    gl_->TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width_, height_, 0, layout, type, nullptr);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return object;
}

void Targets::bindTexture(int unit, GLenum kind, const GlObject& object) const {
    gl_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_->BindTexture(kind, object.id());
}

void Targets::bind(const GlObject& target) const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, target.id());
    gl_->Viewport(0, 0, width_, height_);
}

void Targets::bindSurfaces() const {
    bind(surfaceTarget_);
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
}

void Targets::bindShading() const {
    bind(target_);
    bindTexture(tintsUnit, GL_TEXTURE_2D, tints_);
    bindTexture(shapesUnit, GL_TEXTURE_2D, shapes_);
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
}

void Targets::bindCoverage() const {
    bind(coverageTarget_);
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
}

ShadedPixels Targets::shaded(const PixelBox& part) const {
    const std::size_t count = static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height);
    ShadedPixels pixels{part, std::vector<std::uint32_t>(count), std::vector<float>(count)};
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->ReadPixels(part.x, part.y, part.width, part.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.colour.data());
    gl_->ReadPixels(part.x, part.y, part.width, part.height, GL_DEPTH_COMPONENT, GL_FLOAT, pixels.depth.data());
    return pixels;
}

void Targets::bindResolve(const PixelBox& part) {
    gl_->Disable(GL_FRAMEBUFFER_SRGB);
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
    gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, copyTarget_.id());
    // One pixel more to each side, for the neighbours.
    const int left = std::max(part.x - 1, 0);
    const int low = std::max(part.y - 1, 0);
    const int right = std::min(part.x + part.width + 1, width_);
    const int high = std::min(part.y + part.height + 1, height_);
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->BlitFramebuffer(left, low, right, high, left, low, right, high, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    bind(resolveTarget_);
    bindTexture(pictureUnit, GL_TEXTURE_2D, copiedColour_);
    bindTexture(pictureDepthUnit, GL_TEXTURE_2D, depth_);
    bindTexture(coveringUnit, GL_TEXTURE_2D_MULTISAMPLE, coverage_);
}

image::Image Targets::read() const {
    const auto width = static_cast<std::size_t>(width_);
    const auto height = static_cast<std::size_t>(height_);
    std::vector<std::uint8_t> rgba(width * height * 4);
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());

    image::Image picture{width_, height_, {}};
    picture.rgb.resize(width * height * 3);
    for (std::size_t row = 0; row < height; ++row) {
        const std::uint8_t* from = rgba.data() + (height - 1 - row) * width * 4;
        std::uint8_t* to = picture.rgb.data() + row * width * 3;
        for (std::size_t x = 0; x < width; ++x) {
            to[3 * x] = from[4 * x];
            to[3 * x + 1] = from[4 * x + 1];
            to[3 * x + 2] = from[4 * x + 2];
        }
    }
    return picture;
}

}  // namespace taut::render
