#include "game/python/painter.h"

#include <unistd.h>

#include <atomic>
#include <cstdlib>

#include "game/python/folders.h"
#include "taut/core/error.h"
#include "taut/pipeline/self_test.h"

namespace taut::python {
namespace {

// The process that drew first; 0: none yet.
std::atomic<pid_t> drawer = 0;

bool isForked() {
    const pid_t first = drawer.load();
    return first != 0 && first != ::getpid();
}

}  // namespace

Painter::~Painter() {
    if (isForked()) (void)renderer_.release();  // its end would wait for threads that only the parent has
}

image::Image Painter::draw(const view::FrameView& view, const world::PictureSpec& picture) {
    if (isForked())
        throw core::Error(core::ErrorKind::noRenderer,
                          "this process was forked from one that had drawn, and cannot draw; start it with "
                          "multiprocessing.get_context(\"spawn\")");
    drawer = ::getpid();
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
        renderer_ = pipeline::workingRenderer(options, render::backends());
        picture_ = picture;
    }
    return renderer_->draw(view);
}

}  // namespace taut::python
