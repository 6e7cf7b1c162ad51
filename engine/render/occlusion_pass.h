// How much of the sky the things above hide from each place of the ground: the soft darkening where they touch it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "taut/render/map_target.h"
#include "taut/render/mesh_cache.h"
#include "taut/render/program.h"

namespace taut::render {

// Where on the ground the map lies.
struct OcclusionArea {
    glm::vec2 low{0.0F};   // [m] x and z
    glm::vec2 high{1.0F};  // [m]
    bool operator==(const OcclusionArea&) const = default;
};

inline constexpr int occlusionEdge = 128;        // [texels] of the map
inline constexpr float occlusionCeiling = 1.5F;  // [m] higher things hide too little of the sky to be seen as a stain

// How far things darken the ground around them [m], along x and z: as far as a texel looks, is blurred and is filtered.
inline glm::vec2 occlusionReach(const OcclusionArea& area) {
    return 18.0F / occlusionEdge * (area.high - area.low);
}

// Around everything that is low enough to matter; none if nothing is.
std::optional<OcclusionArea> occlusionArea(std::span<const Bounds> casters, float groundHeight);

class OcclusionPass {
  public:
    OcclusionPass(const Gl& gl, const ShaderFolder& shaders);

    // Nothing is drawn again where nothing has moved that is low enough, unless `anew`.
    void draw(std::span<const DrawItem> items, const MeshCache& meshes, const OcclusionArea& area, float groundHeight,
              bool anew);
    void bindMap() const;

  private:
    const Gl* gl_;
    Program heights_, gather_, blur_;
    MapTarget columns_;  // lowest and highest surface above each place
    MapTarget rough_;    // hidden part of the sky, 0 … 1
    MapTarget map_;      // the same, smooth
    GlObject empty_;
    OcclusionArea area_;         // of the map as it is
    float groundHeight_ = 0.0F;  // [m]
    std::vector<Shape> low_;     // what the map shows
};

}  // namespace taut::render
