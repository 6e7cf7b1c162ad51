// The picture while it is drawn: shaded once a pixel, given smooth edges from four samples a pixel, read back. What is
// shown is kept as sRGB.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "taut/image/image.h"
#include "taut/render/edge_tiles.h"
#include "taut/render/gl.h"

namespace taut::render {

class Targets {
  public:
    // Throws Error(badContent) if GL does not offer the size.
    Targets(const Gl& gl, int width, int height, int samples);

    glm::ivec2 size() const { return {width_, height_}; }  // [pixels]

    // Smooth edges are made from exactly four samples a pixel, else left out.
    bool hasSmoothEdges() const { return smooth_; }

    void bindSurfaces() const;  // to draw what is seen into, with the depth of the picture; bytes are kept as they are
    void bindShading() const;   // to draw into, one sample a pixel; what is seen of surfaces is bound to its units
    void bindCoverage() const;  // to draw into, four samples a pixel; bytes are kept as they are

    // What has been shaded in a part of the picture.
    ShadedPixels shaded(const PixelBox& part) const;

    // To draw a part of the picture again, with textures bound for what has been shaded there (its bytes, its depth)
    // and for the coverage; bytes are kept as they are.
    void bindResolve(const PixelBox& part);

    image::Image read() const;  // the rows run from the top

  private:
    GlObject texture(GLenum format, GLenum layout, GLenum type) const;
    void bind(const GlObject& target) const;
    void bindTexture(int unit, GLenum kind, const GlObject& object) const;

    const Gl* gl_;
    int width_, height_;
    bool smooth_;
    GlObject colour_, depth_, target_;
    GlObject tints_, shapes_, surfaceTarget_;
    GlObject copiedColour_, copyTarget_;
    GlObject coverage_, coverageDepth_, coverageTarget_;
    GlObject resolveTarget_;
};

}  // namespace taut::render
