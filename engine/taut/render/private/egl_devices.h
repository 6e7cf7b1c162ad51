// The EGL devices of this machine. It makes no context.
#pragma once

#include <string>
#include <vector>

namespace taut::render {

// A graphics card, or the processor.
struct EglDevice {
    int number = 0;           // in EGL's own order
    bool isSoftware = false;  // EGL says that the processor draws
    std::string file;         // "/dev/dri/card0"; empty: it has none
};

// None where EGL has no drivers, or cannot tell (EGL_EXT_device_enumeration, EGL_EXT_platform_device).
std::vector<EglDevice> eglDevices();

std::string kindOf(const EglDevice& device);  // "software", "/dev/dri/card0", "hardware" where it has no file

}  // namespace taut::render
