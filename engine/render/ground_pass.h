// Draws the floor, with shadows only where they can fall.
#pragma once

#include <optional>
#include <span>

#include "taut/render/ground.h"
#include "taut/render/program.h"

namespace taut::render {

class GroundPass {
  public:
    GroundPass(const Gl& gl, const ShaderFolder& shaders);

    // Expects a view with a ground; into the bound target, with the frame block and the maps in place.
    void draw(const view::FrameView& view, const LightBox& box, std::span<const Bounds> casters,
              const std::optional<OcclusionArea>& occlusion);

  private:
    const Gl* gl_;
    Program shaded_, open_;
    GlObject layout_, vertices_, indices_;
};

}  // namespace taut::render
