#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string>

#include "taut/core/error.h"
#include "taut/render/context.h"

namespace taut::render {

namespace {

[[noreturn]] void failEgl(const std::string& step) {
    throw core::Error(core::ErrorKind::noRenderer,
                      "no renderer: EGL without a surface failed at " + step +
                          "; install Debian's libegl1 and libegl-mesa0, or try --gl osmesa");
}

class EglContext final : public Context {
  public:
    EglContext() {
        const auto getDisplay =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
        if (getDisplay == nullptr) failEgl("eglGetPlatformDisplayEXT (not offered)");
        display_ = getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY) failEgl("eglGetPlatformDisplayEXT (no display)");
        if (eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) failEgl("eglInitialize");
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) failEgl("eglBindAPI");

        const std::array<EGLint, 5> config{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                           EGL_NONE};
        EGLConfig chosen = nullptr;
        EGLint count = 0;
        if (eglChooseConfig(display_, config.data(), &chosen, 1, &count) != EGL_TRUE || count == 0)
            failEgl("eglChooseConfig");
        const std::array<EGLint, 7> wanted{
            EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display_, chosen, EGL_NO_CONTEXT, wanted.data());
        if (context_ == EGL_NO_CONTEXT) failEgl("eglCreateContext (OpenGL 3.3 core)");
    }
    // The display is shared by the process and stays initialised.
    ~EglContext() override { eglDestroyContext(display_, context_); }

    void makeCurrent() override {
        eglBindAPI(EGL_OPENGL_API);
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) failEgl("eglMakeCurrent");
    }
    void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  protected:
    Function functionNamed(const char* name) override { return eglGetProcAddress(name); }

  private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    ::EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> makeEglContext() {
    return std::make_unique<EglContext>();
}

}  // namespace taut::render
