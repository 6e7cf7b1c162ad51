// Picture files as GL textures, each read once. It knows nothing of surfaces.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "taut/render/gl.h"

namespace taut::render {

class TextureCache {
  public:
    explicit TextureCache(const Gl& gl) : gl_(&gl) {}

    // Binds a repeating, mip-mapped sRGB texture from a PNG or JPEG file to the unit of pictures. Throws what
    // image::readImage throws: Error(inputOutput) for a file that cannot be read, Error(badContent) for one that is no
    // picture, or with which all textures together had more than 134 million pixels.
    void bind(const std::string& path);

  private:
    const Gl* gl_;
    std::map<std::string, GlObject> textures_;
    std::int64_t pixels_ = 0;  // of all of them
};

}  // namespace taut::render
