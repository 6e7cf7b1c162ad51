// Draws the surfaces, with a program made for each kind of finish when it is first met.
#pragma once

#include <map>
#include <span>
#include <tuple>

#include "taut/render/mesh_cache.h"
#include "taut/render/program.h"
#include "taut/render/texture_cache.h"

namespace taut::render {

class SurfacePass {
  public:
    SurfacePass(const Gl& gl, const ShaderFolder& shaders) : gl_(&gl), shaders_(&shaders), textures_(gl) {}

    // Into the bound target; the frame block and the shadow maps must be in place.
    void draw(std::span<const DrawItem> items, const MeshCache& meshes);

  private:
    Program& programFor(const view::Surface& surface);

    const Gl* gl_;
    const ShaderFolder* shaders_;
    TextureCache textures_;
    std::map<std::tuple<view::Pattern, bool, bool>, Program> programs_;  // pattern, woven, two-sided
};

}  // namespace taut::render
