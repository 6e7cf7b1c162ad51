// The depth of the lit surfaces, and its bounds, without GL: small triangles are expensive in a software renderer, and
// only depth is needed here.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "taut/render/private/depth_kernels.h"
#include "taut/render/private/light_box.h"
#include "taut/render/private/mesh_cache.h"

namespace taut::render {

// Whether filtered bounds (boundsEdge²) say that nothing is in the light of a parallelogram, whose corners are given as
// on the map.
bool isLit(std::span<const glm::vec2> bounds, std::span<const glm::vec3, 4> corners);

inline constexpr int boundsEdge = 128;  // [texels] edge of the map of bounds: as many blocks as it divides the map into

class ShadowMap {
  public:
    static constexpr int strips = 16;  // of rows, drawn each on its own

    explicit ShadowMap(int texels);  // expects a multiple of boundsEdge

    // Draws the items, in place of the earlier ones. Items outside the box sideways are cut off; it holds all of them
    // along the light.
    void draw(std::span<const DrawItem> items, const LightBox& box);

    int edge() const { return edge_; }                                    // [texels]
    const std::vector<std::uint16_t>& depths() const { return depths_; }  // (edge²) from below; 65535 is 1, or nothing
    int rowsAStrip() const { return edge_ / strips; }
    bool hasChanged(int strip) const { return changed_[static_cast<std::size_t>(strip)] != 0; }  // by draw()

    // (boundsEdge²) least and largest depth of a block and the two blocks to each side: wide enough that the filtered
    // value still bounds everything within one and a half blocks. Outside everything is lit.
    const std::vector<glm::vec2>& bounds() const { return bounds_; }
    // The same of as many blocks to each side, which bound everything within half a block less.
    std::vector<glm::vec2> boundsWithin(int blocks) const;

  private:
    void addTriangles(const DrawItem& item, const LightBox& box);
    void findBlocks(int strip, const DepthKernels& kernels);

    int edge_;
    std::vector<std::uint16_t> depths_;
    std::vector<glm::vec2> blocks_, bounds_;
    std::vector<std::uint8_t> isDrawn_, changed_;      // (strips)
    std::vector<std::vector<MapTriangle>> triangles_;  // (strips) that may cover something there
    std::vector<glm::vec3> places_;                    // (vertices of an item) on the map
};

}  // namespace taut::render
