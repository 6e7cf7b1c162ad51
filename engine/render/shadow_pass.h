// Gives GL the shadow map and what makes reading it cheap. It does not know how shadows are shaded.
#pragma once

#include <span>
#include <vector>

#include "taut/render/gl.h"
#include "taut/render/light_box.h"
#include "taut/render/mesh_cache.h"
#include "taut/render/shadow_map.h"

namespace taut::render {

class ShadowPass {
  public:
    ShadowPass(const Gl& gl, int texels);

    // What is the same as before in the same box is not drawn again, unless `anew`.
    void draw(std::span<const DrawItem> items, const LightBox& box, bool anew);

    // Binds the maps to their texture units.
    void bindMaps() const;

  private:
    const Gl* gl_;
    ShadowMap map_;
    GlObject depth_;             // texture of the map
    GlObject bounds_;            // texture of its bounds
    std::vector<Shape> shapes_;  // in the map
    glm::mat4 drawnBox_{0.0F};   // its toMap
    GlObject comparing_;         // a sampler that compares
};

}  // namespace taut::render
