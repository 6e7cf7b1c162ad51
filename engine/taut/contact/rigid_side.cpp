#include "taut/contact/rigid_side.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace taut::contact {
namespace {

constexpr double leastFree = 0.02;  // of the sum of the squares of the weights

bool eitherYields(std::span<const int> points, std::span<const double> weights, std::size_t firstSide,
                  std::span<const double> inverseMass) {
    return mayYield(points.first(firstSide), weights.first(firstSide), inverseMass) ||
           mayYield(points.subspan(firstSide), weights.subspan(firstSide), inverseMass);
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

double convexityOf(const Elements& elements, const Edge& edge, const dvec3& on, const dvec3& outward,
                   std::span<const dvec3> x) {
    double steepest = 0;  // sine of the angle
    for (int t : edge.triangles) {
        if (t < 0) continue;
        for (int i : elements.triangles()[static_cast<std::size_t>(t)].points) {
            if (i == edge.a || i == edge.b) continue;
            const dvec3 inwards = x[static_cast<std::size_t>(i)] - on;
            const double rise = glm::dot(inwards, outward);
            if (rise > steepest * length(inwards)) steepest = rise / length(inwards);
        }
    }
    return areWingsBehind(edge, outward, x) ? std::min(1.0, 2.0 * (1.0 - steepest / valley)) : -1.0;
}

bool areWingsBehind(const Edge& edge, const dvec3& outward, std::span<const dvec3> x) {
    for (int i : edge.wings)
        if (i >= 0 && glm::dot(acrossEdge(edge, i, x), outward) > valley) return false;
    return true;
}

bool mayYield(std::span<const int> points, std::span<const double> weights, std::span<const double> inverseMass) {
    double all = 0, free = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double square = weights[k] * weights[k];
        all += square;
        if (inverseMass[static_cast<std::size_t>(points[k])] > 0) free += square;
    }
    return free > leastFree * all;
}

bool mayYield(const ContactConstraint& pair, std::span<const double> inverseMass) {
    return eitherYields(pair.points, pair.weights, static_cast<std::size_t>(pair.firstSide()), inverseMass);
}

bool mayYield(const Crossing& crossing, std::span<const double> inverseMass) {
    return eitherYields(crossing.points, crossing.weights, 2, inverseMass);
}

}  // namespace taut::contact
