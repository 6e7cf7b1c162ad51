// Draws the shadow map and what makes reading it cheap. It does not know how shadows are shaded.
#pragma once

#include <span>

#include "taut/render/light_box.h"
#include "taut/render/map_target.h"
#include "taut/render/mesh_cache.h"
#include "taut/render/program.h"

namespace taut::render {

inline constexpr int boundsEdge = 128;  // [texels] edge of the map of bounds: as many blocks as it divides the map into

class ShadowPass {
  public:
    ShadowPass(const Gl& gl, const ShaderFolder& shaders, int texels);

    void draw(std::span<const DrawItem> items, const MeshCache& meshes, const LightBox& box);

    // Binds the maps to their texture units.
    void bindMaps() const;

  private:
    const Gl* gl_;
    Program depth_, reduce_, spread_;
    MapTarget map_;            // depth seen from the light
    MapTarget blocks_;         // least and largest depth of each block of texels
    MapTarget neighbourhood_;  // the same over each block and those around it
    GlObject comparing_;       // a sampler that compares
    GlObject empty_;           // vertex array of passes without vertices
};

}  // namespace taut::render
