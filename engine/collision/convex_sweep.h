// A path against a convex shape that is given by its signed distance.
#pragma once

#include "taut/collision/geometry.h"

namespace taut::collision {

// Where a path first comes as near as `gap` [m] to the shape. From outside, every nearest point carries a plane that
// the shape lies behind, so a step to that plane never goes too far, and a path that leads away from it never
// arrives: Newton's method on the distance, which for a convex shape converges from one side.
template <class Form>
bool reachConvex(const Form& form, const Path& path, Nearest near, double gap, Touch& touch) {
    constexpr int mostSteps = 32;
    const double close = path.skin > 1e-10 ? path.skin : 1e-10;  // [m] as near as Newton needs to come
    const dvec3 whole = path.to - path.from;
    dvec3 at = path.from;
    double t = 0.0;
    for (int i = 0; i < mostSteps; ++i) {
        const double closing = -glm::dot(near.normal, whole);
        if (!(closing > 0.0)) return false;
        if (near.distance - gap <= close) break;
        t += (near.distance - gap) / closing;
        if (t >= 1.0) return false;
        at = path.from + t * whole;
        near = form.nearest(at);
    }
    // The true surface at the touched place is at distance `near.distance`; the path must end `thickness` above it.
    touch = {near.normal, glm::dot(near.normal, at) - near.distance + path.thickness};
    return true;
}

// How near a path may come before it counts as touching: a start that is nearer than the thickness already must not
// touch at once, or nothing could move along the surface.
inline double sweepGap(double startDistance, double thickness) {
    if (startDistance >= thickness) return thickness;
    return startDistance > 0.0 ? 0.5 * startDistance : startDistance;
}

// True if the path ends, or passes, too near to the shape; `touch` then says where it has to end:
// - a path that starts inside (deeper than rounding explains) goes the shortest way out from its end;
// - one that ends near the surface, on the side from which it came, goes straight out;
// - any other, which would come out elsewhere, ends on the plane where it first touched.
template <class Form>
bool sweepConvex(const Form& form, const Path& path, Touch& touch) {
    const Nearest end = form.nearest(path.to);
    if (end.distance >= path.thickness + path.skin) {
        // The shape lies behind the plane of `end`: a start before that plane means a free path.
        const double startHeight = end.distance - glm::dot(end.normal, path.to - path.from);
        if (startHeight >= path.thickness) return false;
        const Nearest start = form.nearest(path.from);
        if (!(start.distance > -path.skin)) return false;
        return reachConvex(form, path, start, sweepGap(start.distance, path.thickness), touch);
    }
    touch = {end.normal, glm::dot(end.normal, path.to) - end.distance + path.thickness};
    // A path shorter than the height at its end cannot have come through the shape.
    const dvec3 way = path.to - path.from;
    if (end.distance > 0.0 && glm::dot(way, way) < end.distance * end.distance) return true;
    const Nearest start = form.nearest(path.from);
    if (start.distance > -path.skin && glm::dot(start.normal, end.normal) <= 0.0)
        reachConvex(form, path, start, sweepGap(start.distance, path.thickness), touch);
    return true;
}

}  // namespace taut::collision
