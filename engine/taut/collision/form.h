// The geometry of a collider: a surface that tells how far a place is from it, and how a path meets it. It knows
// neither colliders nor contacts. A new form derives from Form or, if it is convex, is a ClosedForm in ConvexForm
// (convex_form.h).
#pragma once

#include <optional>

#include "taut/collision/closed_shape.h"
#include "taut/collision/geometry.h"
#include "taut/collision/outline.h"

namespace taut::collision {

class FootFinder;

// Never changes once built: colliders, and copies of them, share it, also from several threads.
class Form {
  public:
    virtual ~Form() = default;

    // The signed distance from p [m], and the direction in which it grows fastest. It must not exceed the distance from
    // p to the surface: the default sweep() moves points by the result.
    virtual Nearest nearest(const dvec3& p) const = 0;

    // Whether a path ends, or passes, too near to the surface. `touch` then gets the half-space in which the path has
    // to end:
    // - a path that starts inside (deeper than rounding explains) goes the shortest way out from its end;
    // - one that ends near the surface, on the side from which it came, goes straight out;
    // - any other path, which would come out elsewhere, ends on the plane where it first touched.
    // `crossed` is false before the call. It becomes true if the path went through a surface that has no inside. The
    // default calls only nearest(), at one place after another along the path.
    virtual bool sweep(const Path& path, HalfSpace& touch, bool& crossed) const;

    // The box that the form fills [m]; none: the form is the half-space behind a plane through the origin.
    virtual std::optional<core::Aabb> bounds() const = 0;

    // A convex form touches a point once; any other form perhaps from several sides.
    virtual bool isConvex() const { return false; }

    // The closed form that loops over arrays of points may use for a convex form; none: points are tested one by one.
    virtual ClosedShape closed() const { return {}; }

    // The finder of the nearest places of a mesh, for loops over many points; nullptr: points are tested one by one.
    virtual const FootFinder* feet() const { return nullptr; }

    // Its corners and sharp edges; none: the points of the bodies that touch it suffice.
    virtual Outline outline() const { return {}; }
};

// How near a path may come before it counts as touching. A path that starts nearer than the thickness must not touch at
// once, or nothing could move along the surface.
inline double sweepGap(double startDistance, double thickness) {
    if (startDistance >= thickness) return thickness;
    return startDistance > 0.0 ? 0.5 * startDistance : startDistance;
}

// [m] accuracy of a search along a path.
inline double nearEnough(const Path& path) {
    return path.skin > 1e-10 ? path.skin : 1e-10;
}

}  // namespace taut::collision
