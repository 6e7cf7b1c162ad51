// The picture that stands around a scene, as a GL texture, and the light that comes from it.
#pragma once

#include <map>
#include <string>

#include "taut/render/private/environment.h"
#include "taut/render/private/frame_block.h"
#include "taut/render/private/gl.h"
#include "taut/render/private/texture_cache.h"
#include "taut/view/frame_view.h"

namespace taut::render {

class EnvironmentMap {
  public:
    EnvironmentMap(const Gl& gl, TextureBudget& budget) : gl_(&gl), budget_(&budget) {}

    // Binds the picture of a view and writes its part of the block; does nothing if the view has none. A file is read
    // once. Throws as image::readLightImage does, and Error(badContent) for a picture that is not twice as wide as
    // high.
    void show(const view::FrameView& view, FrameBlock& block);

  private:
    struct Known {
        GlObject texture;
        AmbientLight ambient;
        float texelsPerRadian;
    };
    Known read(const std::string& path) const;

    const Gl* gl_;
    TextureBudget* budget_;
    std::map<std::string, Known> known_;
};

}  // namespace taut::render
