// A surface of triangles, two-sided. A closed one has an inside.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "taut/collision/form.h"
#include "taut/collision/private/foot_finder.h"

namespace taut::collision {

class TriangleMesh final : public Form {
  public:
    // Throws core::Error(badContent) for a mesh without triangles of non-zero area, an index out of range, or more
    // than two million triangles. A closed mesh that is inside out is turned.
    TriangleMesh(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles)
        : finder_(makeFacets(vertices, triangles)) {}

    // Distance to the surface; negative inside a closed mesh.
    Nearest nearest(const dvec3& p) const override { return finder_.nearest(p); }

    // A path that crosses a triangle ends before it; `crossed` reports this case. A path that ends too near is pushed
    // off on the side where it ends. A path that starts inside a closed mesh goes the shortest way out. Expects a
    // thickness larger than the skin, so that rounding cannot change the side.
    bool sweep(const Path& path, HalfSpace& touch, bool& crossed) const override;

    std::optional<core::Aabb> bounds() const override { return finder_.bounds(); }

    const FootFinder* feet() const override { return &finder_; }

    Outline outline() const override { return outlineOf(finder_.facets()); }

  private:
    static bool isInFront(const Path& path, const Facet& t);
    bool findWayOut(const Path& path, const Foot& end, HalfSpace& touch) const;
    bool touchNear(const Path& path, const Foot& end, HalfSpace& touch) const;
    int firstCrossing(const Path& path) const;

    FootFinder finder_;
};

}  // namespace taut::collision
