// A contact constraint: where the two sides of a pair are closest at x0, and the direction that keeps them apart. Plain
// data.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "taut/core/turn_friction.h"

namespace taut::contact {

using glm::dvec3;

inline constexpr double noDistance = 1e-9;  // [m] sides that are closer touch: they have no direction from one another

struct ContactConstraint {
    std::array<int, 4> points;  // a point and the corners of a triangle, or the ends of two edges
    std::array<double, 4>
        weights;               // first side positive, second negative: Σ w x is the vector between the closest points
    dvec3 normal;              // unit, towards the first side
    double distance;           // [m] at x0
    double thickness;          // [m] distance to keep
    double friction;           // Coulomb's μ [-]
    int a, b;                  // as CandidatePair
    bool isPoint;              // a point and a triangle; else two edges
    bool isActive;             // the solver gets it; else it only needs a certificate
    std::uint64_t leaves = 0;  // the LeafPair that it was found for
    double recovery = 1.0;     // 0 … 1: share by which an overlap is taken back, see convexityOf()
    double firstShare = 0.5;   // of the thickness that is the first side's
    double restitution = 0.0;  // speed of parting over that of closing [-]
    core::TurnFriction turnFriction{};
    // [m] Of two solids, where their impulse acts on each; none: between the closest places.
    std::optional<std::array<dvec3, 2>> places{};
    double slack = 0.0;     // [m] by which the gap is wider where the sides are expected, as one turns past the other
    double softness = 0.0;  // share of the effective mass's impulse by which the pair yields, see gauss_seidel.h
    // A joint of a solid at two places, along the normal. Impulses of contacts do not change the speed of its sides; of
    // a leash, which holds one way, they change it as far as the gap allows.
    enum class Kind { contact, joint, leash } kind = Kind::contact;
    int firstSide() const { return isPoint ? 1 : 2; }        // points of the first side
    double gap() const { return distance - thickness; }      // [m]
    bool hasSides() const { return distance > noDistance; }  // else they touch, and there is no side to keep
    // By leaves, then as in a list of candidates: points and triangles by the triangle, then edges.
    bool comesBefore(const ContactConstraint& other) const {
        const auto rank = [](const ContactConstraint& c) {
            return std::array{c.isPoint ? 0 : 1, c.isPoint ? c.b : c.a, c.isPoint ? c.a : c.b};
        };
        return leaves < other.leaves || (leaves == other.leaves && rank(*this) < rank(other));
    }
};

}  // namespace taut::contact
