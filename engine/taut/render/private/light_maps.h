// The shadow maps of all lights: the sun's, and those of lamps once there are any.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "taut/render/private/lights.h"
#include "taut/render/private/shadow_pass.h"

namespace taut::render {

class LightMaps {
  public:
    LightMaps(const Gl& gl, int texels);

    // Parts that have not changed in the same box are not drawn again, unless `anew` is set.
    void draw(std::span<const DrawItem> items, const LightSet& lights, bool anew);

    // Whether the shaders find nothing in any light of a parallelogram, whose corners in the world are given.
    bool isLit(std::span<const glm::vec3, 4> corners) const;

    void bind() const;  // to the texture units of the sun and of each lamp

  private:
    const Gl* gl_;
    int texels_;
    std::vector<ShadowPass> passes_;  // the sun's first
    std::size_t used_ = 1;            // of them
};

}  // namespace taut::render
