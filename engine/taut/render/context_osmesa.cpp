#include <GL/osmesa.h>

#include <array>
#include <vector>

#include "taut/core/error.h"
#include "taut/render/private/context.h"

namespace taut::render {

namespace {

class OsmesaContext final : public Context {
  public:
    OsmesaContext() {
        info_.backend = "osmesa";
        const std::array<int, 13> wanted{OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_DEPTH_BITS,
                                         0,
                                         OSMESA_PROFILE,
                                         OSMESA_CORE_PROFILE,
                                         OSMESA_CONTEXT_MAJOR_VERSION,
                                         3,
                                         OSMESA_CONTEXT_MINOR_VERSION,
                                         3,
                                         0,
                                         0,
                                         0};
        context_ = OSMesaCreateContextAttribs(wanted.data(), nullptr);
        if (context_ == nullptr) {
            throw core::Error(
                core::ErrorKind::noRenderer,
                "no renderer: OSMesa gave no OpenGL 3.3 core context (OSMesaCreateContextAttribs failed); "
                "install Debian's libosmesa6, or try --gl egl");
        }
    }
    ~OsmesaContext() override { OSMesaDestroyContext(context_); }

    void makeCurrent() override {
        if (OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
            throw core::Error(core::ErrorKind::noRenderer,
                              "no renderer: OSMesa's context cannot be used (OSMesaMakeCurrent failed); try --gl egl");
        }
    }
    void release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  protected:
    Function functionNamed(const char* name) override { return OSMesaGetProcAddress(name); }

  private:
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4> pixel_{};  // OSMesa wants a window; pictures are drawn elsewhere
};

}  // namespace

std::vector<Backend> backends() {
    return {Backend::osmesa, Backend::egl};
}

std::unique_ptr<Context> makeOsmesaContext() {
    return std::make_unique<OsmesaContext>();
}

}  // namespace taut::render

// OSMesa keeps the window of every context that was made, about 200 bytes. Where leaks are looked for, that is not
// ours.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TAUT_LOOKS_FOR_LEAKS
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(TAUT_LOOKS_FOR_LEAKS)
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libOSMesa\n";
}
#endif
