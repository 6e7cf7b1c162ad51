// A pair in an instant: where its two sides are nearest, and what it would take to press them apart.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace taut::contact {

using glm::dvec3;

struct ContactConstraint {
    std::array<int, 4> points;      // of the group; a point and the corners of a triangle, or the ends of two edges
    std::array<double, 4> weights;  // of the first side positive, of the second negative: Σ w x is the way between them
    dvec3 normal;                   // unit, towards the first side
    double distance;                // [m] at the start of the instant
    double thickness;               // [m] that they keep
    double friction;                // Coulomb's μ [-]
    int a, b;                       // as CandidatePair
    bool isPoint;                   // of a point and a triangle; else of edges
    bool isActive;                  // else it is only watched
    double recovery = 1.0;          // 0 … 1: share by which an overlap is taken back
    int firstSide() const { return isPoint ? 1 : 2; }    // points of the first side
    double gap() const { return distance - thickness; }  // [m]
};

}  // namespace taut::contact
