// The geometry of contact: frames, boxes, nearest points and swept paths. Knows no Bullet.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "taut/core/aabb.h"

namespace taut::collision {

using glm::dvec3;

// Where a shape stands: local to world by rotation, then shift.
struct Frame {
    glm::dmat3 rotation{1.0};
    dvec3 position{0.0};  // [m]
    bool turned = false;  // false: the rotation is none, and is left out

    dvec3 toLocal(const dvec3& p) const { return turned ? (p - position) * rotation : p - position; }
    dvec3 toWorld(const dvec3& p) const { return turned ? rotation * p + position : p + position; }
    dvec3 directionToWorld(const dvec3& d) const { return turned ? rotation * d : d; }
    Frame of(const Frame& child) const {
        return {rotation * child.rotation, toWorld(child.position), turned || child.turned};
    }
};

// The box around a box of a shape that stands there.
inline core::Aabb boxAt(const Frame& frame, const core::Aabb& local) {
    const glm::dmat3& r = frame.rotation;
    const dvec3 half = glm::dmat3(glm::abs(r[0]), glm::abs(r[1]), glm::abs(r[2])) * local.halfSize();
    const dvec3 centre = frame.toWorld(local.centre());
    return {centre - half, centre + half};
}
// [m] How far the fastest corner of a box goes.
inline double travelOf(const core::Aabb& box, const Frame& from, const Frame& to) {
    double most = 0.0;
    for (int i = 0; i < 8; ++i) {
        const dvec3 way = to.toWorld(box.corner(i)) - from.toWorld(box.corner(i));
        most = glm::max(most, glm::dot(way, way));
    }
    return std::sqrt(most);
}

// [rad/s] Of a turn from one frame to another that is not far.
inline dvec3 spinBetween(const Frame& from, const Frame& to, double seconds) {
    const glm::dmat3 turn = to.rotation * glm::transpose(from.rotation);
    return dvec3(turn[1][2] - turn[2][1], turn[2][0] - turn[0][2], turn[0][1] - turn[1][0]) / (2.0 * seconds);
}

// Signed distance to a surface [m], negative inside, and its gradient, a unit vector away from the solid.
struct Nearest {
    double distance;
    dvec3 normal;
};

// The path of a point during a step, seen from the shape; the shape stands still in it.
struct Path {
    dvec3 from;        // [m]
    dvec3 to;          // [m]
    double thickness;  // [m] distance to keep
    double skin;       // [m] rounding error of a distance: nearer than thickness + skin counts as touching
};

// The half-space normal · p >= offset in which the path has to end.
struct HalfSpace {
    dvec3 normal;
    double offset;  // [m]
};

inline bool isFinite(double a) {
    return a - a == 0.0;
}
inline bool isFinite(const dvec3& a) {
    return isFinite(a.x) && isFinite(a.y) && isFinite(a.z);
}

}  // namespace taut::collision
