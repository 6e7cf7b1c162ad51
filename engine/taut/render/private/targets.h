// The picture in progress: the visible parts of surfaces, the shaded picture with one sample per pixel, and the way
// back from GL. The final picture is kept as sRGB.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "taut/render/private/edge_tiles.h"
#include "taut/render/private/gl.h"

namespace taut::render {

class Targets {
  public:
    // Throws Error(badContent) if GL does not offer the size.
    Targets(const Gl& gl, int width, int height);

    glm::ivec2 size() const { return {width_, height_}; }  // [pixels]

    void bindSurfaces() const;  // target for visible surfaces, with the depth of the picture; bytes are kept as they
                                // are
    void bindHidden() const;  // target for the share of light that surfaces nearby leave, a pixel for 2 × 2; depth and
                              // visible surfaces are bound to its units
    void bindShading() const;  // target with one sample per pixel; the visible surfaces, and the share of light, are
                               // bound to its units

    // The shaded picture: bytes red, green, blue, mark from the lowest on; rows from below.
    void colours(std::vector<std::uint32_t>& to) const;               // (width · height)
    void depths(const PixelBox& part, std::vector<float>& to) const;  // (part.width · part.height) 0 … 1

    // Of the drawn surfaces (part.width · part.height): the inverse depth ahead of the eye along the camera's axis, 1 /
    // [m]; undefined where there is no surface.
    std::vector<float> nearness(const PixelBox& part) const;

    // Puts colours back, to draw over.
    void put(std::span<const std::uint32_t> colours);

  private:
    GlObject texture(GLenum format, GLenum layout, GLenum type, int width, int height) const;
    void bind(const GlObject& target, int width, int height) const;
    void bindTexture(int unit, const GlObject& object) const;

    const Gl* gl_;
    int width_, height_;
    GlObject colour_, depth_, target_;
    GlObject tints_, shapes_, surfaceTarget_;
    GlObject hidden_, hiddenTarget_;
    GlObject putColour_, putTarget_;
};

}  // namespace taut::render
