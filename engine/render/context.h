// A GL 3.3 core context without a window, whichever library provides it. It draws nothing itself.
#pragma once

#include <memory>
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

    // The functions of this context; filled by makeContext.
    const GladGLContext& gl() const { return *gl_; }
    RendererInfo info() const { return info_; }

  protected:
    Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    using Function = void (*)();
    virtual Function functionNamed(const char* name) = 0;

  private:
    friend std::unique_ptr<Context> makeContext(Backend backend);

    struct Deleter {
        void operator()(GladGLContext* table) const;
    };
    std::unique_ptr<GladGLContext, Deleter> gl_;
    RendererInfo info_;
};

// A context that is not current yet. Throws Error(noRenderer) that says what was tried and what helps.
std::unique_ptr<Context> makeContext(Backend backend);

std::unique_ptr<Context> makeOsmesaContext();
std::unique_ptr<Context> makeEglContext();

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
