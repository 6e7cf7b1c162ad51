// Gives GL the shadow map and the bounds that make reading it cheap. Independent of the shading of shadows.
#pragma once

#include <span>
#include <vector>

#include "taut/render/private/gl.h"
#include "taut/render/private/lights.h"
#include "taut/render/private/mesh_cache.h"
#include "taut/render/private/program.h"
#include "taut/render/private/shadow_map.h"

namespace taut::render {

class ShadowPass {
  public:
    ShadowPass(const Gl& gl, int texels);

    // Parts that have not changed in the same box are not drawn again, unless `anew`. `isWide`: the shaders read the
    // search radius of wide lights.
    void draw(std::span<const DrawItem> items, const Shadower& light, bool isWide, bool anew);

    void bindMaps(const ShadowUnits& units) const;

    // Whether the shaders find nothing in the light of a parallelogram, whose corners in the world are given.
    bool isLit(std::span<const glm::vec3, 4> corners) const;

  private:
    void putWideBounds();

    const Gl* gl_;
    ShadowMap map_;
    GlObject depth_;                   // texture of the map
    GlObject bounds_;                  // texture of its bounds; b, a: the wide ones, if `wide_` is above 0
    std::vector<glm::vec2> bounded_;   // (boundsEdge²) bounds of the places where everything is lit
    int wide_ = 0;                     // [blocks] that they reach
    std::vector<ShadowShape> shapes_;  // in the map
    glm::mat4 drawnBox_{0.0F};         // its toMap
    GlObject comparing_;               // a sampler that compares
};

}  // namespace taut::render
