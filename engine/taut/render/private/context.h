// A GL 3.3 core context without a window, whichever library provides it. It draws nothing itself.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "taut/render/renderer.h"

struct GladGLContext;

namespace taut::render {

class Context {
  public:
    virtual ~Context() = default;

    // A context is current in one thread at a time; release() lets another thread take it.
    virtual void makeCurrent() = 0;
    virtual void release() = 0;

    // Finds the functions of this context and the name of its renderer. Throws Error(noRenderer) for less than OpenGL
    // 3.3.
    void connect();
    const GladGLContext& gl() const { return *gl_; }
    const RendererInfo& info() const { return info_; }

  protected:
    Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    using Function = void (*)();
    virtual Function functionNamed(const char* name) = 0;

    RendererInfo info_;

  private:
    struct Deleter {
        void operator()(GladGLContext* table) const;
    };
    std::unique_ptr<GladGLContext, Deleter> gl_;
};

// A context that is not current yet. `device` is a number of eglDevices(), for EGL only; without it EGL gives the first
// device that draws, hardware before software, and its default if it lists none. Throws Error(noRenderer) with the
// attempts and a remedy.
std::unique_ptr<Context> makeContext(Backend backend, std::optional<int> device = std::nullopt);

// Not connected yet.
std::unique_ptr<Context> makeOsmesaContext();
std::unique_ptr<Context> makeEglContext(std::optional<int> device);  // none: EGL's own choice, without a surface

// Keeps a context current for a scope.
class CurrentContext {
  public:
    explicit CurrentContext(Context& context) : context_(context) { context_.makeCurrent(); }
    ~CurrentContext() { context_.release(); }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;

  private:
    Context& context_;
};

}  // namespace taut::render
