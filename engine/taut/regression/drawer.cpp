#include "taut/regression/drawer.h"

#include <fmt/format.h>

#include <mutex>

#include "taut/pipeline/self_test.h"
#include "taut/spec/picture_spec.h"

namespace taut::regression {

Drawer::Drawer(DrawingOptions options) : options_(std::move(options)) {}
Drawer::~Drawer() = default;

image::Image Drawer::draw(const view::FrameView& view, const world::PictureSpec& picture, world::ivec2 size) {
    std::unique_ptr<render::Renderer>& renderer =
        renderers_[std::tuple(size.x, size.y, picture.samples, picture.shadowSize)];
    if (!renderer) {
        render::RendererOptions options;
        options.width = size.x;
        options.height = size.y;
        options.samples = picture.samples;
        options.shadowSize = picture.shadowSize;
        options.device = options_.device;
        options.shaders = options_.shaders;
        options.font = options_.font;
        options.shadows = options_.shadows;
        static std::mutex making;  // the GL libraries set themselves up when the first context is made
        const std::lock_guard lock(making);
        renderer = pipeline::workingRenderer(options, options_.backends);
    }
    const render::RendererInfo info = renderer->info();
    renderer_ = fmt::format("{}, {}, {}", info.renderer, info.version, info.backend);
    return renderer->draw(view);
}

}  // namespace taut::regression
