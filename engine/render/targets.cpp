#include "render/targets.h"

#include <algorithm>
#include <string>

#include "core/error.h"

namespace taut::render {

Targets::Targets(const Gl& gl, int width, int height, int samples)
    : gl_(&gl),
      width_(width),
      height_(height),
      drawColour_(gl, GlKind::renderbuffer),
      drawDepth_(gl, GlKind::renderbuffer),
      drawTarget_(gl, GlKind::framebuffer),
      readColour_(gl, GlKind::renderbuffer),
      readTarget_(gl, GlKind::framebuffer) {
    GLint largest = 0;
    GLint mostSamples = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    gl.GetIntegerv(GL_MAX_SAMPLES, &mostSamples);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        throw core::Error(core::ExitCode::badContent,
                          "a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                              " cannot be drawn: each side must be 1 to " + std::to_string(largest) + " pixels");
    }
    const GLsizei count = samples > 1 ? std::min(samples, mostSamples) : 0;
    gl.BindRenderbuffer(GL_RENDERBUFFER, drawColour_.id());
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count, GL_SRGB8_ALPHA8, width, height);
    gl.BindRenderbuffer(GL_RENDERBUFFER, drawDepth_.id());
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count, GL_DEPTH_COMPONENT32F, width, height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, drawTarget_.id());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, drawColour_.id());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, drawDepth_.id());
    bool complete = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;

    gl.BindRenderbuffer(GL_RENDERBUFFER, readColour_.id());
    gl.RenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, width, height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, readTarget_.id());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, readColour_.id());
    complete = complete && gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    if (!complete) throw core::Error(core::ExitCode::noRenderer, "no renderer: GL offers no multisampled sRGB target");
    rgba_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
}

void Targets::bind() const {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, drawTarget_.id());
    gl_->Viewport(0, 0, width_, height_);
    gl_->Enable(GL_FRAMEBUFFER_SRGB);
}

image::Image Targets::read() {
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, drawTarget_.id());
    gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, readTarget_.id());
    gl_->BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, readTarget_.id());
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());

    image::Image picture{width_, height_, {}};
    const auto width = static_cast<std::size_t>(width_);
    const auto height = static_cast<std::size_t>(height_);
    picture.rgb.resize(width * height * 3);
    for (std::size_t row = 0; row < height; ++row) {
        const std::uint8_t* from = rgba_.data() + (height - 1 - row) * width * 4;
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
