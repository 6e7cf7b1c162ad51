// Smooth edges: the outlines of everything once more with four samples a pixel, coloured from the picture that was
// shaded with one. A software renderer shades a multisampled target several times a pixel, hidden surfaces included;
// this way it costs a third. Only tiles with an edge in them are coloured anew.
#pragma once

#include <span>

#include "taut/render/mesh_cache.h"
#include "taut/render/program.h"
#include "taut/render/targets.h"
#include "taut/view/frame_view.h"

namespace taut::render {

// What the shaders write for an item beside its colour or depth, above 0; 0 is ground and sky.
float itemMark(std::size_t item);

// The part of a picture in which the items can be seen; all of it if one of them reaches behind the camera.
PixelBox pixelBox(std::span<const DrawItem> items, const glm::mat4& viewProjection, int width, int height);

class EdgePass {
  public:
    EdgePass(const Gl& gl, const ShaderFolder& shaders);

    // Smooths the part of the shaded picture that shows the items.
    void draw(const view::FrameView& view, std::span<const DrawItem> items, const MeshCache& meshes,
              const PixelBox& part, Targets& targets);

  private:
    void drawCoverage(const view::FrameView& view, std::span<const DrawItem> items, const MeshCache& meshes,
                      const PixelBox& part, const Targets& targets);
    void drawTiles(std::span<const PixelBox> tiles, glm::ivec2 size);

    const Gl* gl_;
    Program surfaces_, resolve_;
    GlObject tileLayout_, tileCorners_;
};

}  // namespace taut::render
