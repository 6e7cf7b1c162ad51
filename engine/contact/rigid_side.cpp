#include "taut/contact/rigid_side.h"

namespace taut::contact {
namespace {

constexpr double leastFree = 0.02;  // of the squares of the weights

bool isRigidAt(const Elements& elements, int point) {
    return elements.isRigid(elements.surfaceOf(point));
}

// Of points with those weights.
template <class Points, class Weights>
bool mayYield(const Points& points, const Weights& weights, std::size_t first, std::size_t last,
              std::span<const double> inverseMass) {
    double all = 0, free = 0;
    for (std::size_t k = first; k < last; ++k) {
        const double square = weights[k] * weights[k];
        all += square;
        if (inverseMass[static_cast<std::size_t>(points[k])] > 0) free += square;
    }
    return free >= leastFree * all;
}

}  // namespace

bool isCornerNearest(const Elements& elements, int point, const dvec3& outward, std::span<const dvec3> x) {
    for (int i : elements.neighbours(point)) {
        const dvec3 along = x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(point)];
        const double rise = glm::dot(along, outward);
        if (rise > 0 && rise * rise > valley * valley * glm::dot(along, along)) return false;
    }
    return true;
}

bool areWingsBehind(const Edge& edge, const dvec3& outward, std::span<const dvec3> x) {
    for (int i : edge.wings)
        if (i >= 0 && glm::dot(acrossEdge(edge, i, x), outward) > valley) return false;
    return true;
}

bool mayYield(const Elements& elements, const MeetingPair& pair, std::span<const double> inverseMass) {
    const auto side = static_cast<std::size_t>(pair.firstSide());
    if (isRigidAt(elements, pair.points[0])) return mayYield(pair.points, pair.weights, side, 4, inverseMass);
    if (isRigidAt(elements, pair.points[3])) return mayYield(pair.points, pair.weights, 0, side, inverseMass);
    return true;
}

bool mayYield(const Elements& elements, const Crossing& crossing, std::span<const double> inverseMass) {
    if (!isRigidAt(elements, crossing.points[0])) return true;
    return mayYield(crossing.points, crossing.weights, 2, 5, inverseMass);
}

}  // namespace taut::contact
