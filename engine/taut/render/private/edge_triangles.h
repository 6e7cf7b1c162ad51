// The drawn triangles in picture coordinates, sorted by the tiles whose edges are to be smoothed. Independent of GL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "taut/render/private/edge_tiles.h"
#include "taut/render/private/mesh_cache.h"

namespace taut::render {

// Counter-clockwise, seen from any side that is drawn.
struct EdgeTriangle {
    std::array<glm::dvec2, 3> corners;           // [pixels] on a raster of 1/256, as GL has them
    double depth = 0.0;                          // at the picture's corner, 0 … 1 within the view
    double depthAlong = 0.0, depthUp = 0.0;      // [1 / pixel]
    int left = 0, low = 0, right = 0, high = 0;  // [pixels] the first and the last that it may cover
    std::uint32_t mark = 0;                      // of the thing
};

// Parts on the other side of a plane are cut off: of the picture's near plane, and of `seenSide` [m].
struct EdgeView {
    glm::mat4 viewProjection{1.0F};
    glm::vec4 seenSide{0.0F, 0.0F, 0.0F, 1.0F};
    glm::ivec2 size{0};  // [pixels]
};

class EdgeTriangles {
  public:
    // Finds the triangles of the items, in place of earlier ones. `tiles` are boxes that edgeTiles() found in the part
    // of the picture `part`.
    void find(std::span<const DrawItem> items, const EdgeView& view, const PixelBox& part,
              std::span<const PixelBox> tiles);

    // The same with `hidden` things, marked by their number from 1 on, among `others`, which have the mark 0.
    void find(std::span<const DrawItem> hidden, std::span<const DrawItem> others, const EdgeView& view,
              const PixelBox& part, std::span<const PixelBox> tiles);

    std::span<const PixelBox> tiles() const { return tiles_; }  // at most edgeTileSize wide and high

    // Calls visit(triangle) for triangles that may cover a tile, in the order of drawing.
    template <class Visit>
    void visit(std::size_t tile, Visit&& visit) const {
        for (std::uint32_t i = first_[tile]; i < first_[tile + 1]; ++i) visit(triangles_[covering_[i]]);
    }

  private:
    void begin(const PixelBox& part, std::span<const PixelBox> tiles);
    void addTiles(std::span<const PixelBox> boxes);
    void addItem(const DrawItem& item, std::uint32_t mark, const EdgeView& view);
    void addTriangle(const std::array<glm::dvec3, 3>& corners, bool twoSided, std::uint32_t mark);
    void sortByTile();

    PixelBox part_;
    int columns_ = 0;
    std::vector<PixelBox> tiles_;
    std::vector<std::int32_t> tileAt_;  // (rows · columns) its number, -1 where there is no edge
    std::vector<EdgeTriangle> triangles_;
    std::vector<std::array<std::uint32_t, 2>> pairs_;  // tile, triangle
    std::vector<std::uint32_t> first_;                 // (tiles + 1) into the next
    std::vector<std::uint32_t> covering_;              // triangles, tile by tile
    std::vector<std::uint32_t> next_;                  // (tiles) while they are sorted
    std::vector<glm::dvec3> places_;                   // (vertices of an item) on the picture
    std::vector<std::uint8_t> needsCut_;               // (vertices of an item)
};

}  // namespace taut::render
