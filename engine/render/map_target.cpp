#include "taut/render/map_target.h"

#include <array>

#include "taut/core/error.h"

namespace taut::render {

MapTarget::MapTarget(const Gl& gl, int edge, GLenum format, GLenum filter, float border)
    : texture(gl, GlKind::texture), target(gl, GlKind::framebuffer), size(edge) {
    const bool isDepth = format == GL_DEPTH_COMPONENT32F || format == GL_DEPTH_COMPONENT16;
    const GLint filterValue = static_cast<GLint>(filter);
    const std::array<float, 4> colour{border, border, border, border};
    gl.BindTexture(GL_TEXTURE_2D, texture.id());
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), edge, edge, 0, isDepth ? GL_DEPTH_COMPONENT : GL_RGBA,
                  GL_FLOAT, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filterValue);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filterValue);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, colour.data());
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.id());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, isDepth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                            texture.id(), 0);
    if (isDepth) {
        gl.DrawBuffer(GL_NONE);
        gl.ReadBuffer(GL_NONE);
    }
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw core::Error(core::ErrorKind::noRenderer, "no renderer: GL cannot draw into the maps that shadows need");
}

void MapTarget::bind(const Gl& gl) const {
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.id());
    gl.Viewport(0, 0, size, size);
}

}  // namespace taut::render
