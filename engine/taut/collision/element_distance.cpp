#include "taut/collision/element_distance.h"

#include <cmath>

namespace taut::collision {
namespace {

constexpr double level = 1e-3;  // sine of the angle up to which a surface does not rise along an edge

template <ClosedKind kind>
Nearest distanceBy(const ClosedShape& shape, const dvec3& p) {
    const ClosedDistance at = closedDistance<kind>(shape.size, p.x, p.y, p.z);
    return {at.distance, {at.x, at.y, at.z}};
}

}  // namespace

Nearest distanceTo(const ClosedShape& shape, const dvec3& place) {
    switch (shape.kind) {
        case ClosedKind::sphere: return distanceBy<ClosedKind::sphere>(shape, place);
        case ClosedKind::box: return distanceBy<ClosedKind::box>(shape, place);
        case ClosedKind::capsule: return distanceBy<ClosedKind::capsule>(shape, place);
        case ClosedKind::cylinder: return distanceBy<ClosedKind::cylinder>(shape, place);
        case ClosedKind::cone: return distanceBy<ClosedKind::cone>(shape, place);
        case ClosedKind::halfSpace:
        case ClosedKind::none: break;
    }
    return {};
}

// The distance falls from a and falls from b: in between its gradient along the edge has a zero, which regula falsi
// with the halves of Illinois finds. Inside a shape the gradient may jump over zero where two sides of the shape are
// equally near. The normal there is the mean of the two at right angles to the edge.
std::optional<ElementNear> nearestInEdge(const ClosedShape& shape, const dvec3& a, const dvec3& b, const Nearest& atA,
                                         const Nearest& atB) {
    constexpr int mostRounds = 60;
    constexpr double flat = 1e-9;      // sine
    constexpr double leastMean = 0.4;  // length; below it, both sides of a plate are as near
    const dvec3 edge = b - a;
    const double size = std::sqrt(glm::dot(edge, edge));
    double low = 0, high = 1, riseAtLow = glm::dot(atA.normal, edge), riseAtHigh = glm::dot(atB.normal, edge);
    if (!(riseAtLow < -level * size && riseAtHigh > level * size)) return std::nullopt;
    ElementNear found;
    dvec3 normalAtLow = atA.normal, normalAtHigh = atB.normal;
    bool isFlat = false;
    for (int round = 0, last = 0; round < mostRounds; ++round) {
        const double share = (low * riseAtHigh - high * riseAtLow) / (riseAtHigh - riseAtLow);
        const Nearest near = distanceTo(shape, a + share * edge);
        found = {near.distance, near.normal, {1.0 - share, share, 0.0}};
        const double rise = glm::dot(near.normal, edge);
        isFlat = std::abs(rise) < flat * size;
        if (isFlat) break;
        const int sign = rise < 0 ? -1 : 1;
        (sign < 0 ? low : high) = share;
        (sign < 0 ? riseAtLow : riseAtHigh) = rise;
        (sign < 0 ? normalAtLow : normalAtHigh) = near.normal;
        if (sign == last) (sign < 0 ? riseAtHigh : riseAtLow) *= 0.5;
        last = sign;
    }
    if (isFlat) return found;
    const double fall = -glm::dot(normalAtLow, edge), rise = glm::dot(normalAtHigh, edge);
    const dvec3 mean = (rise * normalAtLow + fall * normalAtHigh) / (rise + fall);
    if (const double length = std::sqrt(glm::dot(mean, mean)); length > leastMean) found.normal = mean / length;
    return found;
}

std::optional<ElementNear> nearestInFace(const Convex& shape, const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 ab = b - a, ac = c - a, area = glm::cross(ab, ac);
    const double square = glm::dot(area, area);
    if (!(square > 0)) return std::nullopt;
    dvec3 normal = area / std::sqrt(square);
    if (glm::dot(normal, a - shape.bounds()->centre()) < 0) normal = -normal;
    const dvec3 reaches = shape.support(normal) + shape.rounding() * normal;
    const double distance = glm::dot(normal, a - reaches);
    const dvec3 foot = reaches + distance * normal, way = foot - a;
    const double ofB = glm::dot(area, glm::cross(way, ac)) / square, ofC = glm::dot(area, glm::cross(ab, way)) / square;
    if (!(ofB > 0 && ofC > 0 && ofB + ofC < 1)) return std::nullopt;
    // The shape may pierce the plane beside the triangle.
    if (distance < 0 && distanceTo(shape.closed(), foot).distance > 0) return std::nullopt;
    return ElementNear{distance, normal, {1.0 - ofB - ofC, ofB, ofC}};
}

}  // namespace taut::collision
