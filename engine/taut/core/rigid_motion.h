// The rigid motion that has the momenta of some points.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace taut::core {

struct RigidMotion {
    double mass = 0;                      // [kg]
    glm::dvec3 centre{0.0};               // [m] of mass
    glm::dmat3 inverseInertia{0.0};       // [1/(kg m²)] about the centre
    glm::dvec3 velocity{0.0}, spin{0.0};  // [m/s], [rad/s]

    glm::dvec3 velocityAt(const glm::dvec3& x) const { return velocity + glm::cross(spin, x - centre); }
};

// Masses of the points of a rigid body [kg], in which fixed points (mass 0) are so heavy that it turns about them.
// Returns the mass of the others; 0: it is fixed.
inline double massesOf(std::span<const double> inverseMass, std::vector<double>& masses) {
    constexpr double heldOver = 1e9;
    double free = 0;
    for (const double w : inverseMass)
        if (w > 0) free += 1.0 / w;
    masses.clear();
    for (const double w : inverseMass) masses.push_back(w > 0 ? 1.0 / w : heldOver * free);
    return free;
}

// tr(S) 1 - S: the inertia of points whose Σ m r rᵀ is S.
inline glm::dmat3 inertiaOf(const glm::dmat3& spread) {
    return (spread[0][0] + spread[1][1] + spread[2][2]) * glm::dmat3(1.0) - spread;
}

// Of points at x with velocities v, which need not be those of a rigid motion. Expects that they are not on one line.
inline RigidMotion rigidMotionOf(std::span<const double> masses, std::span<const glm::dvec3> x,
                                 std::span<const glm::dvec3> v) {
    RigidMotion motion;
    for (std::size_t i = 0; i < x.size(); ++i) {
        motion.mass += masses[i];
        motion.centre += masses[i] * x[i];
        motion.velocity += masses[i] * v[i];
    }
    motion.centre /= motion.mass;
    motion.velocity /= motion.mass;
    glm::dmat3 spread(0.0);
    glm::dvec3 momentum(0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const glm::dvec3 arm = x[i] - motion.centre;
        spread += glm::outerProduct(masses[i] * arm, arm);
        momentum += masses[i] * glm::cross(arm, v[i] - motion.velocity);
    }
    motion.inverseInertia = glm::inverse(inertiaOf(spread));
    motion.spin = motion.inverseInertia * momentum;
    return motion;
}

}  // namespace taut::core
