// How a layer of pictures is drawn: of each pixel's middle, at the time of the view, after the colours. It knows no
// layer.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "taut/image/image.h"
#include "taut/render/private/edge_tiles.h"
#include "taut/render/private/mesh_cache.h"
#include "taut/render/private/program.h"
#include "taut/render/private/surface_pass.h"
#include "taut/render/private/targets.h"
#include "taut/view/frame_view.h"

namespace taut::render {

// The items to draw; the frame block is in place.
struct LayerScene {
    const view::FrameView& view;
    std::span<const DrawItem> items;  // with rims and widened tubes, the nearest first
    PixelBox part;                    // in which they are
    glm::ivec2 size;                  // [px] of the picture
    const MeshCache& meshes;
    // Those of the colours, free to be used.
    Targets& targets;
    SurfacePass& surfaces;
};

class LayerPass {
  public:
    virtual ~LayerPass() = default;
    // Fills the numbers of the layer; its name is set.
    virtual void draw(const LayerScene& scene, image::Layer& layer) = 0;
};

// Three numbers of 8 or 16 bits a pixel, with a depth of their own.
class LayerTarget {
  public:
    LayerTarget(const Gl& gl, glm::ivec2 size, bool isWide);

    void begin() const;                    // binds and clears it
    void read(image::Layer& layer) const;  // into the numbers, rows from the top

  private:
    const Gl* gl_;
    glm::ivec2 size_;
    bool isWide_;
    GlObject colour_, depth_, target_;
};

// Draws the camera's view into colours of 8 bits by a pair of shaders of its own, without anti-aliasing. The shaders
// read `transform` and `seenSide`, like mask.vert.
class FlatPass : public LayerPass {
  public:
    FlatPass(const Gl& gl, Program program, glm::ivec2 size);

    void draw(const LayerScene& scene, image::Layer& layer) final;

  private:
    // Before each surface; the program is in use.
    virtual void begin(Program& program, const LayerScene& scene, const view::Surface& surface) const = 0;

    const Gl* gl_;
    Program program_;
    LayerTarget target_;
};

}  // namespace taut::render
