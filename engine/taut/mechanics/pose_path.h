// The path of a rigid body: a position on a straight line, and a rotation that goes from one to another the short way,
// at the pace of world::between(). Points fixed to the body move with it.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "taut/mechanics/linear_path.h"

namespace taut::mechanics {

struct PosePath {
    LinearPath place;
    glm::dquat from{1, 0, 0, 0}, to{1, 0, 0, 0};  // unit; at t0 and t1, less than half a turn apart
    double t0 = 0.0, t1 = 1.0;                    // [s] t0 < t1; it goes on at both ends

    PosePath() = default;
    PosePath(const LinearPath& path) : place(path) {}  // turned by nothing
    PosePath(const LinearPath& path, const glm::dquat& a, const glm::dquat& b, double ta, double tb)
        : place(path), from(a), to(b), t0(ta), t1(tb) {}

    bool isTurned() const { return turns() || from != glm::dquat(1, 0, 0, 0); }
    bool turns() const { return from != to; }
    bool moves() const { return turns() || place.from != place.to; }

    // The body at a moment.
    struct Frame {
        glm::dvec3 place, velocity;  // [m], [m/s]
        glm::dquat rotation;
        glm::dvec3 spin;  // [rad/s]
        bool isTurned;

        // The vector from `place` to a point that is fixed to the body at that offset [m], and the velocity of that
        // point [m/s].
        glm::dvec3 arm(const glm::dvec3& offset) const { return isTurned ? rotated(rotation, offset) : offset; }
        glm::dvec3 offsetOf(const glm::dvec3& point) const { return rotated(glm::conjugate(rotation), point - place); }
        glm::dvec3 velocityOf(const glm::dvec3& arm) const {
            return isTurned ? velocity + glm::cross(spin, arm) : velocity;
        }
    };
    Frame at(double t) const {
        Frame frame{place.at(t), place.rate(t), from, glm::dvec3(0.0), isTurned()};
        if (!turns()) return frame;
        // q = r/|r| with r = (1 - u) q0 + u q1, so that ω = 2 q̇ q* = 2 u̇ Im(q1 q0*)/|r|²: the axis stays.
        const double u = (t - t0) / (t1 - t0);
        const glm::dquat end = glm::dot(from, to) < 0 ? -to : to;
        const glm::dquat r = from * (1.0 - u) + end * u;
        const double r2 = glm::dot(r, r);
        if (!(r2 > 0)) return frame;
        frame.rotation = glm::normalize(r);
        const glm::dquat way = end * glm::conjugate(from);
        frame.spin = glm::dvec3(way.x, way.y, way.z) * (2.0 / ((t1 - t0) * r2));
        return frame;
    }

    static glm::dvec3 rotated(const glm::dquat& q, const glm::dvec3& x) {
        const glm::dvec3 u(q.x, q.y, q.z);
        return x + 2.0 * (q.w * glm::cross(u, x) + glm::cross(u, glm::cross(u, x)));
    }
};

}  // namespace taut::mechanics
