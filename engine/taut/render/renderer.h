// Draws a FrameView into a picture, off-screen. It knows neither the world nor files of frames.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "taut/image/image.h"
#include "taut/render/layer_table.h"
#include "taut/view/frame_view.h"

namespace taut::render {

// The library that gives the GL context: Mesa off-screen, in software and the same everywhere, or EGL, with the driver
// it finds.
enum class Backend { osmesa, egl };

// The backends of this build, the default first. OSMesa is one of them only if the build found it.
std::vector<Backend> backends();

struct RendererOptions {
    int width = 1280;  // [px]
    int height = 720;
    int samples = 4;         // of anti-aliasing, for each pixel: 1, 4, 8 or 16; the last two draw it 2 and 4 times
    int shadowSize = 2048;   // [texels] edge of the shadow map; a multiple of 128
    bool shadows = true;     // false: for a picture without them
    bool occlusion = true;   // false: things do not darken the ground around them
    bool keepsStill = true;  // false: nothing is kept from picture to picture, to compare
    bool plainByGl = false;  // plain ground and sky too, to compare
    bool alpha = false;      // no sky, and of the ground its shadows alone; the picture has alpha then
    std::vector<std::shared_ptr<const Layer>> layers{};  // Image::layers, in that order

    Backend backend = backends().front();
    std::optional<int> device;      // of EGL, a number of eglDevices(); none: the best that works
    std::filesystem::path shaders;  // folder of the shader files
    std::filesystem::path font;     // TrueType file for labels; empty: the one that Debian installs

    // For measurements: called with the name of each pass after GL has finished it. Waiting for that costs time.
    std::function<void(std::string_view)> passDone;
};

// The renderer, in the words of the GL library.
struct RendererInfo {
    std::string backend;
    std::string vendor;
    std::string renderer;
    std::string version;
    std::optional<int> device{};  // of EGL; none: it has no number there
    bool isSoftware = true;       // the processor draws
};

// Threads may take turns with it, but not call it at the same time. The picture depends on the view alone, not on the
// pictures drawn before.
class Renderer {
  public:
    // Throws Error(noRenderer) without a GL context, Error(inputOutput) without a shader file, and
    // Error(badContent) for a shader that does not compile or for sizes that GL does not offer.
    explicit Renderer(const RendererOptions& options);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    // Draws a picture of width × height. Throws Error(inputOutput) if a texture, or a font that a label needs, cannot
    // be read, Error(badContent) if it is no picture or no font.
    image::Image draw(const view::FrameView& view);

    // Changes size, samples, size of the shadow map and occlusion; the other options are ignored. From now on pictures
    // are those of a renderer that was made with these options. It costs less than a picture, because programs and
    // meshes stay. Throws as the constructor does; the renderer cannot draw after that.
    void change(const RendererOptions& options);

    RendererInfo info() const;  // of the context in use

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::render
