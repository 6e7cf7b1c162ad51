#include "game/python/painter.h"

#include <cstdlib>

#include "game/python/folders.h"
#include "taut/pipeline/self_test.h"

namespace taut::python {

image::Image Painter::draw(const view::FrameView& view, const world::PictureSpec& picture) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool isSame = picture.size == picture_.size && picture.samples == picture_.samples &&
                        picture.shadowSize == picture_.shadowSize;
    if (!renderer_ || !isSame) {
        render::RendererOptions options;
        options.width = picture.size.x;
        options.height = picture.size.y;
        options.samples = picture.samples;
        options.shadowSize = picture.shadowSize;
        options.shaders = shaderFolder();
        if (const char* font = std::getenv("TAUT_FONT"); font != nullptr) options.font = font;
        renderer_.reset();
        renderer_ = pipeline::workingRenderer(options, {render::Backend::osmesa, render::Backend::egl});
        picture_ = picture;
    }
    return renderer_->draw(view);
}

}  // namespace taut::python
