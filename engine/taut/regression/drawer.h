// Draws golden pictures: one renderer for each size asked for, made when it is first needed. It belongs to one thread,
// and knows neither scenarios nor files of pictures.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "taut/image/image.h"
#include "taut/render/renderer.h"
#include "taut/spec/source.h"
#include "taut/view/frame_view.h"

namespace taut::world {
struct PictureSpec;
}

namespace taut::regression {

struct DrawingOptions {
    std::vector<render::Backend> backends = render::backends();  // the first that works
    std::optional<int> device{};                                 // of EGL; none: the best that works
    std::filesystem::path shaders;
    std::filesystem::path font;
    bool shadows = true;
};

class Drawer {
  public:
    explicit Drawer(DrawingOptions options);
    ~Drawer();
    Drawer(const Drawer&) = delete;
    Drawer& operator=(const Drawer&) = delete;

    // Throws core::Error(noRenderer) if there is no renderer, and the exceptions of Renderer::draw.
    image::Image draw(const view::FrameView& view, const world::PictureSpec& picture, world::ivec2 size);

    // The renderer of the last picture: "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6, osmesa".
    const std::string& renderer() const { return renderer_; }

  private:
    DrawingOptions options_;
    std::map<std::tuple<int, int, int, int>, std::unique_ptr<render::Renderer>> renderers_;
    std::string renderer_;
};

}  // namespace taut::regression
