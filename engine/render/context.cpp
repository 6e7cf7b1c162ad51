#include "taut/render/context.h"

#include <glad/gl.h>

#include "taut/core/error.h"

namespace taut::render {

Context::Context() : gl_(new GladGLContext{}) {}

void Context::Deleter::operator()(GladGLContext* table) const {
    delete table;
}

std::unique_ptr<Context> makeContext(Backend backend) {
    std::unique_ptr<Context> context = backend == Backend::osmesa ? makeOsmesaContext() : makeEglContext();
    const CurrentContext current(*context);
    const auto load = [](void* self, const char* name) { return static_cast<Context*>(self)->functionNamed(name); };
    const int version = gladLoadGLContextUserPtr(context->gl_.get(), load, context.get());
    if (version < GLAD_MAKE_VERSION(3, 3)) {
        throw core::Error(core::ErrorKind::noRenderer,
                          "no renderer: the GL library offers less than OpenGL 3.3; Mesa's llvmpipe does, on Debian in "
                          "the package libosmesa6 (or libegl-mesa0 with --gl egl)");
    }
    const auto text = [&](GLenum name) {
        const auto* bytes = context->gl().GetString(name);
        return std::string(bytes != nullptr ? reinterpret_cast<const char*>(bytes) : "");
    };
    context->info_ = {backend == Backend::osmesa ? "osmesa" : "egl", text(GL_VENDOR), text(GL_RENDERER),
                      text(GL_VERSION)};
    return context;
}

}  // namespace taut::render
