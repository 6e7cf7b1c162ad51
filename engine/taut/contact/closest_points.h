// Closest points of a point and a triangle, and of two segments; where a segment pierces a triangle. Only + - × ÷ and
// comparisons, so that all machines agree.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace taut::contact {

using glm::dvec3;

inline double length(const dvec3& v) {
    return std::sqrt(glm::dot(v, v));
}

// Of a triangle. Edge k has the corners k and k + 1.
enum class Feature : unsigned char { face, edge0, edge1, edge2, corner0, corner1, corner2 };

struct OnTriangle {
    std::array<double, 3> weights;  // of the corners, not negative, sum 1
    Feature feature;
};

// By Voronoi regions: Ericson, Real-Time Collision Detection, 2005, 5.1.5.
inline OnTriangle closestOnTriangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 ab = b - a, ac = c - a, ap = p - a;
    const double abAp = glm::dot(ab, ap), acAp = glm::dot(ac, ap);
    if (abAp <= 0 && acAp <= 0) return {{1, 0, 0}, Feature::corner0};
    const dvec3 bp = p - b;
    const double abBp = glm::dot(ab, bp), acBp = glm::dot(ac, bp);
    if (abBp >= 0 && acBp <= abBp) return {{0, 1, 0}, Feature::corner1};
    const double areaC = abAp * acBp - abBp * acAp;
    // Corners a and b in one place: the edge to c is closest.
    if (areaC <= 0 && abAp >= 0 && abBp <= 0 && abAp > abBp) {
        const double s = abAp / (abAp - abBp);
        return {{1 - s, s, 0}, Feature::edge0};
    }
    const dvec3 cp = p - c;
    const double abCp = glm::dot(ab, cp), acCp = glm::dot(ac, cp);
    if (acCp >= 0 && abCp <= acCp) return {{0, 0, 1}, Feature::corner2};
    const double areaB = abCp * acAp - abAp * acCp;
    if (areaB <= 0 && acAp >= 0 && acCp <= 0) {
        const double s = acAp - acCp > 0 ? acAp / (acAp - acCp) : 0.0;
        return {{1 - s, 0, s}, Feature::edge2};
    }
    const double areaA = abBp * acCp - abCp * acBp;
    const double alongB = acBp - abBp, alongC = abCp - acCp;
    if (areaA <= 0 && alongB >= 0 && alongC >= 0) {
        const double s = alongB + alongC > 0 ? alongB / (alongB + alongC) : 0.0;
        return {{0, 1 - s, s}, Feature::edge1};
    }
    const double area = areaA + areaB + areaC;
    const double v = areaB / area, w = areaC / area;
    return {{1 - v - w, v, w}, Feature::face};
}

struct OnSegments {
    double s, t;     // place along the first and the second, from 0 to 1
    bool areInside;  // neither place is at an end
};

inline double clampShare(double s) {
    return s < 0 ? 0.0 : (s > 1 ? 1.0 : s);
}

// Segments may be points. Ericson 2005, 5.1.9.
inline OnSegments closestOnSegments(const dvec3& a0, const dvec3& a1, const dvec3& b0, const dvec3& b1) {
    const dvec3 a = a1 - a0, b = b1 - b0, r = a0 - b0;
    const double aa = glm::dot(a, a), bb = glm::dot(b, b), ab = glm::dot(a, b);
    const double ar = glm::dot(a, r), br = glm::dot(b, r);
    double s = 0, t = 0;
    if (aa > 0 && bb > 0) {
        const double det = aa * bb - ab * ab;
        // Nearly parallel: any place on the first is as close as any other.
        s = det > 1e-12 * aa * bb ? clampShare((ab * br - ar * bb) / det) : 0.5;
        t = (ab * s + br) / bb;
        if (t < 0 || t > 1) {
            t = clampShare(t);
            s = clampShare((ab * t - ar) / aa);
        } else if (!(det > 1e-12 * aa * bb)) {
            s = clampShare((ab * t - ar) / aa);
        }
    } else if (aa > 0) {
        s = clampShare(-ar / aa);
    } else if (bb > 0) {
        t = clampShare(br / bb);
    }
    return {s, t, s > 0 && s < 1 && t > 0 && t < 1};
}

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
