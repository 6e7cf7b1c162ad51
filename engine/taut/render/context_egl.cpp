#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

#include "taut/core/error.h"
#include "taut/render/private/context.h"
#include "taut/render/private/egl_devices.h"

namespace taut::render {

namespace {

bool names(const char* extensions, std::string_view wanted) {
    if (extensions == nullptr) return false;
    const std::string all = fmt::format(" {} ", extensions);
    return all.find(fmt::format(" {} ", wanted)) != std::string::npos;
}

template <class Function>
Function eglFunction(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// By their numbers.
std::vector<EGLDeviceEXT> allDevices() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!names(extensions, "EGL_EXT_platform_device") ||
        !(names(extensions, "EGL_EXT_device_enumeration") || names(extensions, "EGL_EXT_device_base")))
        return {};
    const auto query = eglFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    EGLint count = 0;
    if (query == nullptr || query(0, nullptr, &count) != EGL_TRUE || count <= 0) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (query(count, devices.data(), &count) != EGL_TRUE) return {};
    devices.resize(static_cast<std::size_t>(count));
    return devices;
}

class EglContext final : public Context {
  public:
    explicit EglContext(std::optional<int> device) {
        info_.backend = "egl";
        info_.device = device;
        const auto getDisplay = eglFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
        if (getDisplay == nullptr) fail("eglGetPlatformDisplayEXT (not offered)");
        display_ =
            device ? getDisplay(EGL_PLATFORM_DEVICE_EXT, allDevices().at(static_cast<std::size_t>(*device)), nullptr)
                   : getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY) fail("eglGetPlatformDisplayEXT (no display)");
        if (eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) fail("eglInitialize");
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) fail("eglBindAPI");

        const std::array<EGLint, 5> config{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                           EGL_NONE};
        EGLConfig chosen = nullptr;
        EGLint count = 0;
        if (eglChooseConfig(display_, config.data(), &chosen, 1, &count) != EGL_TRUE || count == 0)
            fail("eglChooseConfig");
        const std::array<EGLint, 7> wanted{
            EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display_, chosen, EGL_NO_CONTEXT, wanted.data());
        if (context_ == EGL_NO_CONTEXT) fail("eglCreateContext (OpenGL 3.3 core)");
    }
    // The display is shared by the process and stays initialised.
    ~EglContext() override { eglDestroyContext(display_, context_); }

    void makeCurrent() override {
        eglBindAPI(EGL_OPENGL_API);
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) fail("eglMakeCurrent");
    }
    void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  protected:
    Function functionNamed(const char* name) override { return eglGetProcAddress(name); }

  private:
    [[noreturn]] void fail(const std::string& step) const {
        const std::string what = info_.device ? fmt::format("EGL's device {}", *info_.device) : "EGL without a surface";
        throw core::Error(
            core::ErrorKind::noRenderer,
            fmt::format("no renderer: {} failed at {}; install Debian's libegl-mesa0 and libgl1-mesa-dri{}", what, step,
                        backends().front() == Backend::osmesa ? ", or try --gl osmesa" : ""));
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    ::EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::vector<EglDevice> eglDevices() {
    const auto text = eglFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    std::vector<EglDevice> result;
    for (const EGLDeviceEXT device : allDevices()) {
        EglDevice& described = result.emplace_back();
        described.number = static_cast<int>(result.size()) - 1;
        if (text == nullptr) continue;
        const char* extensions = text(device, EGL_EXTENSIONS);
        described.isSoftware = names(extensions, "EGL_MESA_device_software");
        const char* file = names(extensions, "EGL_EXT_device_drm") ? text(device, EGL_DRM_DEVICE_FILE_EXT) : nullptr;
        if (file != nullptr) described.file = file;
    }
    return result;
}

std::string kindOf(const EglDevice& device) {
    return device.isSoftware ? "software" : device.file.empty() ? "hardware" : device.file;
}

std::unique_ptr<Context> makeEglContext(std::optional<int> device) {
    return std::make_unique<EglContext>(device);
}

}  // namespace taut::render
