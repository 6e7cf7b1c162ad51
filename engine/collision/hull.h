// The convex hull of a set of points. Bullet finds the hull and, near edges and corners, the distance by GJK.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "taut/collision/geometry.h"

namespace taut::collision {

class Hull {
  public:
    // Throws core::Error(badContent) for fewer than four vertices or a hull without volume.
    explicit Hull(std::span<const dvec3> vertices);
    ~Hull();
    Hull(Hull&&) noexcept;
    Hull& operator=(Hull&&) noexcept;

    // Exact inside and above a face as far as the faces are: each is moved out until no vertex lies before it, and
    // Bullet rounds the vertices to about 1/10000 of the size to decide what is a face.
    Nearest nearest(const dvec3& p) const;

    // The highest of the faces' planes over p: never more than the distance. Costs a fraction of `nearest`.
    Nearest highestFace(const dvec3& p) const;

    const Box& bounds() const { return bounds_; }

  private:
    struct Bullet;
    bool isUnderEveryFace(const dvec3& p, double by) const;
    void addFace(const dvec3& normal, std::span<const dvec3> vertices);

    std::unique_ptr<Bullet> bullet_;
    std::vector<double> normalX_, normalY_, normalZ_, offset_;  // (faces) normal · p - offset is the height [-, m]
    Box bounds_;
};

bool sweepHull(const Hull& hull, const Path& path, Touch& touch);

}  // namespace taut::collision
