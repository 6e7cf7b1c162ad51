// Closest points of a pair, of a point and a triangle or of two segments; where a segment pierces a triangle. Only + -
// × ÷ and comparisons, so that all machines agree.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace taut::contact {

using glm::dvec3;

inline double length(const dvec3& v) {
    return std::sqrt(glm::dot(v, v));
}

// Of a triangle. Edge k has the corners k and k + 1.
enum class Feature : unsigned char { face, edge0, edge1, edge2, corner0, corner1, corner2 };

// The points of a pair: a point and the corners of a triangle, or the ends of two segments. Segments may be points.
using Corners = std::array<dvec3, 4>;

// The closest places of the two sides.
struct Closest {
    std::array<double, 4> weights;  // as of a ContactConstraint
    dvec3 separation;               // [m] from the second side to the first: the sum of weights times corners
    std::int64_t where;             // as of ClosestLanes
};
// By the text of the kernels (closest_text.h), to the bit.
Closest closestPoints(const Corners& corners, bool isPoint);

struct Piercing {
    double s;                       // place along the segment, from 0 to 1
    std::array<double, 3> weights;  // of the corners
};

// Whether a segment goes through a triangle. Segments in its plane do not. Möller and Trumbore 1997.
inline bool pierces(const dvec3& p, const dvec3& q, const dvec3& a, const dvec3& b, const dvec3& c,
                    Piercing& piercing) {
    const dvec3 ab = b - a, ac = c - a, way = q - p;
    const dvec3 normal = glm::cross(ab, ac);
    const double before = glm::dot(normal, p - a), after = glm::dot(normal, q - a);
    if (!((before > 0 && after < 0) || (before < 0 && after > 0))) return false;
    const double s = before / (before - after);
    const dvec3 at = p + s * way - a;
    const double square = glm::dot(normal, normal);
    const double w = glm::dot(normal, glm::cross(ab, at)) / square, v = glm::dot(normal, glm::cross(at, ac)) / square;
    if (v < 0 || w < 0 || v + w > 1) return false;
    piercing = {s, {1 - v - w, v, w}};
    return true;
}

}  // namespace taut::contact
