// The picture while it is drawn: shaded once a pixel, given smooth edges from four samples a pixel, read back. What is
// shown is kept as sRGB.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"
#include "render/gl.h"

namespace taut::render {

class Targets {
  public:
    // Throws Error(badContent) if GL does not offer the size.
    Targets(const Gl& gl, int width, int height, int samples);

    // Smooth edges are made for exactly four samples a pixel, else left out.
    bool hasSmoothEdges() const { return smooth_; }

    void bindShading() const;   // to draw into, one sample a pixel
    void bindCoverage() const;  // to draw into, four samples a pixel; bytes are kept as they are

    // To draw the final picture into, with textures bound for the shaded picture (its bytes, its depth) and the
    // coverage; bytes are kept as they are.
    void bindResolve();

    // To draw over the picture that has been made, with the depth of the shaded one.
    void bindFinished() const;

    image::Image read() const;  // what has been made; the rows run from the top

  private:
    GlObject texture(GLenum format, GLenum layout, GLenum type) const;
    void bind(const GlObject& target) const;

    const Gl* gl_;
    int width_, height_;
    bool smooth_;
    GlObject shadedColour_, shadedDepth_, shadedTarget_;
    GlObject copiedColour_, copyTarget_;
    GlObject coverage_, coverageDepth_, coverageTarget_;
    GlObject finishedColour_, resolveTarget_, finishedTarget_;
};

}  // namespace taut::render
