// Convex forms. The search along a path asks for their distance at many places, so it is a direct call, not a virtual
// one.
#pragma once

#include <concepts>
#include <utility>

#include "taut/collision/form.h"

namespace taut::collision {

// A convex shape, given by its signed distance (exact outside and inside) and its box.
template <class T>
concept ClosedForm = requires(const T& shape, const dvec3& p) {
    { shape.nearest(p) } -> std::same_as<Nearest>;
    { shape.bounds() } -> std::convertible_to<std::optional<core::Aabb>>;
};

// Where a path first comes as near as `gap` [m] to the shape. Seen from outside, the shape lies behind the plane
// through every nearest point. So a step to that plane never goes too far, and a path that leads away from it never
// arrives. This is Newton's method on the distance, which for a convex shape converges from one side.
template <ClosedForm Closed>
bool reachConvex(const Closed& shape, const Path& path, Nearest near, double gap, HalfSpace& touch) {
    constexpr int mostSteps = 32;
    const double close = nearEnough(path);
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
        near = shape.nearest(at);
    }
    // The true surface at the touched place is at distance `near.distance`; the path must end `thickness` above it.
    touch = {near.normal, glm::dot(near.normal, at) - near.distance + path.thickness};
    return true;
}

// See Form::sweep.
template <ClosedForm Closed>
bool sweepConvex(const Closed& shape, const Path& path, HalfSpace& touch) {
    const Nearest end = shape.nearest(path.to);
    if (end.distance >= path.thickness + path.skin) {
        // The shape lies behind the plane of `end`, so a path that starts before that plane is free.
        const double startHeight = end.distance - glm::dot(end.normal, path.to - path.from);
        if (startHeight >= path.thickness) return false;
        const Nearest start = shape.nearest(path.from);
        if (!(start.distance > -path.skin)) return false;
        return reachConvex(shape, path, start, sweepGap(start.distance, path.thickness), touch);
    }
    touch = {end.normal, glm::dot(end.normal, path.to) - end.distance + path.thickness};
    // A path shorter than the height at its end cannot have come through the shape.
    const dvec3 way = path.to - path.from;
    if (end.distance > 0.0 && glm::dot(way, way) < end.distance * end.distance) return true;
    const Nearest start = shape.nearest(path.from);
    if (start.distance > -path.skin && glm::dot(start.normal, end.normal) <= 0.0)
        reachConvex(shape, path, start, sweepGap(start.distance, path.thickness), touch);
    return true;
}

template <ClosedForm Closed>
class ConvexForm final : public Form {
  public:
    explicit ConvexForm(Closed shape) : shape_(std::move(shape)) {}
    Nearest nearest(const dvec3& p) const override { return shape_.nearest(p); }
    bool sweep(const Path& path, HalfSpace& touch, bool&) const override { return sweepConvex(shape_, path, touch); }
    std::optional<core::Aabb> bounds() const override { return shape_.bounds(); }
    bool isConvex() const override { return true; }
    ClosedShape closed() const override {
        if constexpr (requires { shape_.closed(); }) return shape_.closed();
        return {};
    }

  private:
    Closed shape_;
};

}  // namespace taut::collision
