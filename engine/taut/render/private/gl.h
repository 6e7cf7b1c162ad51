// The GL functions of one context and an owner for GL objects. For the sources of this folder only: the one place
// where GL's own header comes in.
#pragma once

#include <glad/gl.h>

#include <utility>

namespace taut::render {

using Gl = GladGLContext;

enum class GlKind { buffer, framebuffer, program, renderbuffer, sampler, shader, texture, vertexArray };

// Creates an object and deletes it; the context must be current for both.
class GlObject {
  public:
    GlObject() = default;
    GlObject(const Gl& gl, GlKind kind, GLenum shaderType = 0);
    GlObject(GlObject&& other) noexcept : gl_(other.gl_), kind_(other.kind_), id_(std::exchange(other.id_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(gl_, other.gl_);
        std::swap(kind_, other.kind_);
        std::swap(id_, other.id_);
        return *this;
    }
    ~GlObject();

    GLuint id() const { return id_; }

  private:
    const Gl* gl_ = nullptr;
    GlKind kind_ = GlKind::buffer;
    GLuint id_ = 0;
};

}  // namespace taut::render
