#include "taut/render/private/context.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "taut/core/error.h"
#include "taut/render/private/egl_devices.h"

namespace taut::render {

namespace {

// Mesa's renderers on the processor, by what they call themselves. A card whose driver is missing is drawn by them too.
bool isOfTheProcessor(std::string_view renderer) {
    constexpr std::array<std::string_view, 4> names{"llvmpipe", "softpipe", "swrast", "Software Rasterizer"};
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view name) { return renderer.find(name) != std::string_view::npos; });
}

void expectDevice(const std::vector<EglDevice>& devices, int number) {
    if (std::any_of(devices.begin(), devices.end(), [&](const EglDevice& d) { return d.number == number; })) return;
    std::string there;
    for (const EglDevice& device : devices)
        there += fmt::format("{}{} ({})", there.empty() ? "" : ", ", device.number, kindOf(device));
    throw core::Error(
        core::ErrorKind::noRenderer,
        fmt::format("no renderer: EGL has no device {} here; there {}", number,
                    devices.empty() ? "is none: install Debian's libegl-mesa0 and libgl1-mesa-dri"
                                    : fmt::format("{} {}", devices.size() == 1 ? "is device" : "are", there)));
}

std::unique_ptr<Context> connected(std::unique_ptr<Context> context) {
    context->connect();
    return context;
}

// The first that is hardware, else the first that draws at all.
std::unique_ptr<Context> bestEglContext() {
    std::vector<EglDevice> devices = eglDevices();
    std::stable_partition(devices.begin(), devices.end(), [](const EglDevice& device) { return !device.isSoftware; });
    std::unique_ptr<Context> software;
    std::string tried;
    for (const EglDevice& device : devices) {
        if (software && device.isSoftware) break;
        try {
            std::unique_ptr<Context> context = connected(makeEglContext(device.number));
            if (!context->info().isSoftware) return context;
            if (!software) software = std::move(context);
        } catch (const core::Error& error) {
            if (error.kind() != core::ErrorKind::noRenderer) throw;
            tried += fmt::format("\n  {}", error.what());
        }
    }
    if (software) return software;
    try {
        return connected(makeEglContext(std::nullopt));
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), error.what() + tried);
    }
}

}  // namespace

Context::Context() : gl_(new GladGLContext{}) {}

void Context::Deleter::operator()(GladGLContext* table) const {
    delete table;
}

void Context::connect() {
    const CurrentContext current(*this);
    const auto load = [](void* self, const char* name) { return static_cast<Context*>(self)->functionNamed(name); };
    const int version = gladLoadGLContextUserPtr(gl_.get(), load, this);
    if (version < GLAD_MAKE_VERSION(3, 3)) {
        throw core::Error(
            core::ErrorKind::noRenderer,
            fmt::format("no renderer: the GL library offers less than OpenGL 3.3; Mesa's llvmpipe offers it, on Debian "
                        "in {}",
                        info_.backend == "osmesa" ? "the package libosmesa6" : "libegl-mesa0 and libgl1-mesa-dri"));
    }
    const auto text = [&](GLenum name) {
        const auto* bytes = gl().GetString(name);
        return std::string(bytes != nullptr ? reinterpret_cast<const char*>(bytes) : "");
    };
    info_.vendor = text(GL_VENDOR);
    info_.renderer = text(GL_RENDERER);
    info_.version = text(GL_VERSION);
    info_.isSoftware = isOfTheProcessor(info_.renderer);
}

std::unique_ptr<Context> makeContext(Backend backend, std::optional<int> device) {
    if (backend == Backend::osmesa) return connected(makeOsmesaContext());
    if (!device) return bestEglContext();
    expectDevice(eglDevices(), *device);
    return connected(makeEglContext(device));
}

}  // namespace taut::render
