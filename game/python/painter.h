// Draws a world into arrays: a renderer that is made at first use, and again for another picture.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "taut/image/image.h"
#include "taut/render/renderer.h"
#include "taut/spec/picture_spec.h"
#include "taut/view/frame_view.h"

namespace taut::python {

class Painter {
  public:
    Painter() = default;
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;
    ~Painter();

    // Refuses in a process that was forked from one that had drawn: the threads of its renderer are not there. Expects
    // sizes that the caller has looked at. May be called without the interpreter's lock, by several threads. Throws
    // core::Error.
    image::Image draw(const view::FrameView& view, const world::PictureSpec& picture);

  private:
    std::mutex mutex_;
    std::unique_ptr<render::Renderer> renderer_;
    world::PictureSpec picture_;  // that it draws
};

}  // namespace taut::python
