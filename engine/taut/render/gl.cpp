#include "taut/render/private/gl.h"

namespace taut::render {

GlObject::GlObject(const Gl& gl, GlKind kind, GLenum shaderType) : gl_(&gl), kind_(kind) {
    switch (kind) {
        case GlKind::buffer: gl.GenBuffers(1, &id_); break;
        case GlKind::framebuffer: gl.GenFramebuffers(1, &id_); break;
        case GlKind::program: id_ = gl.CreateProgram(); break;
        case GlKind::renderbuffer: gl.GenRenderbuffers(1, &id_); break;
        case GlKind::sampler: gl.GenSamplers(1, &id_); break;
        case GlKind::shader: id_ = gl.CreateShader(shaderType); break;
        case GlKind::texture: gl.GenTextures(1, &id_); break;
        case GlKind::vertexArray: gl.GenVertexArrays(1, &id_); break;
    }
}

GlObject::~GlObject() {
    if (id_ == 0) return;
    switch (kind_) {
        case GlKind::buffer: gl_->DeleteBuffers(1, &id_); break;
        case GlKind::framebuffer: gl_->DeleteFramebuffers(1, &id_); break;
        case GlKind::program: gl_->DeleteProgram(id_); break;
        case GlKind::renderbuffer: gl_->DeleteRenderbuffers(1, &id_); break;
        case GlKind::sampler: gl_->DeleteSamplers(1, &id_); break;
        case GlKind::shader: gl_->DeleteShader(id_); break;
        case GlKind::texture: gl_->DeleteTextures(1, &id_); break;
        case GlKind::vertexArray: gl_->DeleteVertexArrays(1, &id_); break;
    }
}

}  // namespace taut::render
