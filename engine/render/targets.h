// The picture while it is drawn: a multisampled sRGB target, its resolved copy, and the way back to memory.
#pragma once

#include "image/image.h"
#include "render/gl.h"

namespace taut::render {

class Targets {
  public:
    // Throws Error(badContent) if GL does not offer the size.
    Targets(const Gl& gl, int width, int height, int samples);

    void bind() const;    // to draw into; sets the viewport
    image::Image read();  // resolves, and turns the rows to run from the top

  private:
    const Gl* gl_;
    int width_, height_;
    GlObject drawColour_, drawDepth_, drawTarget_;
    GlObject readColour_, readTarget_;
    std::vector<std::uint8_t> rgba_;
};

}  // namespace taut::render
