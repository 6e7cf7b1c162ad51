// Draws each thing in a flat colour, without smooth edges: which of them is seen in a pixel.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "taut/render/mesh_cache.h"
#include "taut/render/program.h"

namespace taut::render {

class MaskPass {
  public:
    // `colours`: 0xRRGGBB by the name of a surface; others are black, like ground and sky.
    MaskPass(const Gl& gl, const ShaderFolder& shaders, glm::ivec2 size, std::map<std::string, std::uint32_t> colours);

    // (height × width × 3), rows from the top. The frame block must be in place; what is not on the seen side is left
    // out.
    std::vector<std::uint8_t> draw(std::span<const DrawItem> items, const MeshCache& meshes, glm::vec4 seenSide);

  private:
    const Gl* gl_;
    Program program_;
    glm::ivec2 size_;
    std::map<std::string, std::uint32_t> colours_;
    GlObject colour_, depth_, target_;
};

}  // namespace taut::render
