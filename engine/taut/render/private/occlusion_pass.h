// How much of the sky the things above hide from each place of the ground: the soft darkening where they touch it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "taut/render/private/depth_kernels.h"
#include "taut/render/private/gl.h"
#include "taut/render/private/light_box.h"
#include "taut/render/private/mesh_cache.h"

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
    explicit OcclusionPass(const Gl& gl);

    // Areas without motion near the ground are not drawn again, unless `anew` is set.
    void draw(std::span<const DrawItem> items, const OcclusionArea& area, float groundHeight, bool anew);
    void bindMap() const;
    std::span<const float> hidden() const { return smooth_; }  // (occlusionEdge²) part of the sky, 0 … 1

  private:
    float highest() const { return glm::max(area_.high.x - area_.low.x, area_.high.y - area_.low.y); }  // [m]
    void addTriangles(std::span<const DrawItem> items);
    void findColumns();
    void gather();
    void blur();

    const Gl* gl_;
    GlObject texture_;                 // of the map
    OcclusionArea area_;               // of the map as it is
    float groundHeight_ = 0.0F;        // [m]
    std::vector<ShadowShape> shapes_;  // the content of the map

    std::vector<MapTriangle> triangles_;  // seen from above, with heights for depths
    std::vector<glm::vec3> places_;       // (vertices of an item) on the map
    std::vector<std::uint16_t> heights_;  // (occlusionEdge²)
    std::vector<float> low_, high_;       // lowest and highest surface [m], see columnAt() in the source
    std::vector<float> hidden_, smooth_;  // (occlusionEdge²) part of the sky, 0 … 1
};

}  // namespace taut::render
