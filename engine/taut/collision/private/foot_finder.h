// Finds the nearest place on a set of triangles: in cells with their possible triangles, or in a tree outside of the
// cells. Independent of paths, and of the inside of the triangles.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "taut/collision/geometry.h"
#include "taut/collision/private/facets.h"
#include "taut/collision/private/mesh_tree.h"

namespace taut::collision {

// The nearest place on some triangles.
struct Foot {
    double square = std::numeric_limits<double>::infinity();  // [m²] of the distance
    double facing = -1.0;                                     // |height over the triangle's plane| [m]
    dvec3 point{0.0};
    int triangle = -1;
};

class FootFinder {
  public:
    FootFinder() = default;
    // Gives the same bits for any number of threads.
    explicit FootFinder(Facets facets);

    // The information of the cells about a place, without triangles.
    struct Place {
        double least;               // [m] the surface is at least this far
        double room;                // [m] from the place to the border of its cell; below 0 outside of all cells
        bool inside;                // the place is inside; valid if least > 0
        std::span<const int> list;  // triangles that include the nearest; empty: not known
    };
    Place place(const dvec3& p) const;

    // The nearest place to p. `place` is place(p). Of triangles that are equally near (at an edge or a corner) it takes
    // the one that faces p most.
    Foot foot(const dvec3& p, const Place& place) const;

    // The information about the places near p. If the surface is farther than `far` [m], nothing more is computed.
    struct Around {
        double clear = -1.0;       // [m] the surface is at least this far from p; below 0: p is inside
        double radius = -1.0;      // [m] places as near to p have their foot on p's triangle, if it is inside of that
        double fewRadius = -1.0;   // [m] places as near to p have their foot on one of `few`
        std::array<int, 4> few{};  // triangles, in the order of their list
        std::size_t fewCount = 0;
        Foot foot;  // of p; no triangle: p is far, or inside
    };
    Around know(const dvec3& p, double far) const;

    // The nearest place to p on the triangles of a list, which gives the same bits as foot() if all that can be nearest
    // are in it.
    Foot footAmong(const dvec3& p, std::span<const int> list) const;

    // Whether p is inside a closed surface; `foot` is the foot of p. The triangle that faces p most decides this
    // correctly for every closed surface.
    bool isInside(const dvec3& p, const Foot& foot) const;

    // The distance of p, negative inside, and the direction in which it grows.
    Nearest nearestFrom(const dvec3& p, const Foot& foot) const;
    Nearest nearest(const dvec3& p) const { return nearestFrom(p, foot(p, place(p))); }

    const Facet& triangle(int i) const { return facets_.triangles[i]; }
    const MeshTree& tree() const { return tree_; }
    const core::Aabb& bounds() const { return bounds_; }
    bool isClosed() const { return facets_.isClosed; }
    const Facets& facets() const { return facets_; }
    const double* facetNumbers() const { return &facets_.triangles.front().corner.x; }  // (12 · triangles)

  private:
    // A triangle in single precision, relative to the middle of all triangles. It gives a place's heights over the
    // triangle's plane and beyond its three edges.
    using Four = float __attribute__((vector_size(16)));
    struct Prism {
        Four x, y, z, offset;
    };
    // A cube of space. The surface is at least `least` metres away from its middle.
    struct Cell {
        float least = 0.0F;
        bool isInside = false;    // the middle
        std::uint32_t first = 0;  // start of its list, or of its eight parts
        std::int32_t count = 0;   // length of its list; 0: it has none; below 0: it has parts
    };
    static constexpr std::size_t longestList = 64;
    struct Slab;  // the cells of one layer, while they are made

    void update(const dvec3& p, int triangle, Foot& foot) const;
    Foot footAmong(const dvec3& p, std::span<const int> list, float* lowest) const;
    void footInTree(const dvec3& p, double shrink, Foot& foot) const;
    void lowestSquares(const dvec3& fromCentre, std::span<const int> list, float* lowest) const;  // [m²]

    void findFew(const Place& place, const float* lowest, Around& around) const;
    double radiusOfFace(const dvec3& p, const Place& place, const Foot& foot, const float* lowest) const;

    void makePrisms();
    void widenPrisms();
    bool mayBeNearest(const dvec3& middle, double half, int triangle) const;
    void measureCells();
    void measureSlab(int z, Slab& slab) const;
    void fillCell(std::size_t cell, const dvec3& middle, double half, int depth, std::span<const int> among,
                  Slab& slab) const;

    MeshTree tree_;
    Facets facets_;
    std::vector<Prism> prisms_;  // (triangles)
    std::vector<float> flares_;  // (triangles) see widenPrisms
    core::Aabb bounds_;
    double rounding_ = 0.0;  // [m] of a prism's heights

    glm::ivec3 cellCount_{0};
    dvec3 cellsFrom_{0.0};
    double cellSize_ = 0.0;       // [m]
    double cellsPerMetre_ = 0.0;  // [1/m]
    std::vector<Cell> cells_;     // (cellCount_, then eight for each that has parts)
    std::vector<int> lists_;      // triangles
};

}  // namespace taut::collision
