// A surface of triangles, two-sided, found through Bullet's bounding volume tree. A closed one has an inside.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "taut/collision/form.h"
#include "taut/collision/mesh_tree.h"

namespace taut::collision {

class TriangleMesh final : public Form {
  public:
    // Throws core::Error(badContent) for a mesh without triangles of non-zero area, an index out of range, or more
    // than two million triangles. A closed mesh that is inside out is turned.
    TriangleMesh(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles);

    // Distance to the surface; negative inside a closed mesh. Among triangles that are equally near (at an edge or a
    // corner) the one that faces p most decides the sign, which makes it right for every closed surface.
    Nearest nearest(const dvec3& p) const override;

    // A path that crosses a triangle ends before it; one that ends too near is pushed off on the side where it ends;
    // one that starts inside a closed mesh goes the shortest way out. `crossed` tells the first case. The thickness
    // has to be larger than the skin: a side needs a distance that rounding cannot turn round.
    bool sweep(const Path& path, Touch& touch, bool& crossed) const override;

    std::optional<Box> bounds() const override { return bounds_; }

  private:
    struct Triangle {
        dvec3 corner, ab, ac, normal;
    };
    struct Foot {                                                 // the nearest point so far
        double square = std::numeric_limits<double>::infinity();  // [m²] of the distance
        double facing = -1.0;                                     // |height over the triangle's plane| [m]
        dvec3 point{0.0};
        int triangle = -1;
    };
    // What is known of a place without looking at triangles: from the signed distance at the middle of its cell.
    struct Guess {
        double least;  // [m] the surface is at least this far
        double most;   // [m] and at most this far
        bool inside;   // if least > 0
    };

    void updateFoot(const dvec3& p, int triangle, Foot& foot) const;
    Foot footWithin(const dvec3& p, double radius) const;
    Nearest nearestFrom(const dvec3& p, const Foot& foot) const;
    static bool isInFront(const Path& path, const Triangle& t);
    bool findWayOut(const Path& path, Touch& touch) const;

    void takeTriangles(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles);
    void findOutside(std::span<const dvec3> vertices);
    void measureCells();
    Guess guess(const dvec3& p) const;

    MeshTree tree_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> corners_;  // (3 · triangles)
    bool closed_ = false;  // every edge belongs to two triangles that run through it in opposite directions
    Box bounds_;

    glm::ivec3 cellCount_{0};
    double cellSize_ = 0.0;
    std::vector<double> cells_;  // (cells) signed distance at the middle of a cell [m]
};

}  // namespace taut::collision
