// Draws the marks of the debug view: lines and dots of a width in pixels, dimmer where something is in front.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "taut/render/private/program.h"
#include "taut/view/frame_view.h"

namespace taut::render {

class MarksPass {
  public:
    MarksPass(const Gl& gl, const ShaderFolder& shaders);

    // Over the picture in the bound target of the given size.
    void draw(const view::FrameView& view, const glm::mat4& viewProjection, int width, int height);

  private:
    struct Corner {
        glm::vec4 clip;
        glm::vec3 colour;
        glm::vec3 shape;
    };
    void collect(const view::FrameView& view, const glm::mat4& viewProjection, int width, int height);
    void appendQuad(const Corner& a, const Corner& b, const Corner& c, const Corner& d);

    const Gl* gl_;
    Program program_;
    GlObject layout_, corners_, indices_;
    std::vector<Corner> quads_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace taut::render
