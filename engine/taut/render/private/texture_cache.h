// Picture files as GL textures, each read once. It knows nothing of surfaces.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "taut/render/private/gl.h"

namespace taut::render {

// How many pixels all pictures of a renderer together may still have.
struct TextureBudget {
    std::int64_t pixels = std::int64_t{1} << 27U;  // 700 MB with their smaller levels
};

class TextureCache {
  public:
    TextureCache(const Gl& gl, TextureBudget& budget) : gl_(&gl), budget_(&budget) {}

    // Binds a repeating, mip-mapped sRGB texture from a PNG or JPEG file to the unit of pictures. Throws as
    // image::readImage does: Error(inputOutput) for a file that cannot be read, Error(badContent) for one that is no
    // picture, or if all of the budget would have more than 134 million pixels.
    void bind(const std::string& path);

  private:
    const Gl* gl_;
    TextureBudget* budget_;
    std::map<std::string, GlObject> textures_;
};

}  // namespace taut::render
