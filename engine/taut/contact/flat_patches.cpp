#include "taut/contact/flat_patches.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <utility>

#include "taut/contact/row_arithmetic.h"

namespace taut::contact {
namespace {

constexpr double sameNormal = 1e-6;  // 1 - cosine
constexpr double sameShare = 1e-3;   // of the thickness
constexpr std::size_t fewPairs = 3;  // have no inner ones

struct Spot {
    double x, y;       // [m] in the plane
    std::size_t pair;  // of all
};

// Andrew's monotone chain. Places nearer to an edge of the hull than `near` [m] are not kept, so that neither are
// twins.
std::vector<Spot> hullOf(std::vector<Spot> places, double near) {
    if (places.size() <= fewPairs) return places;
    std::sort(places.begin(), places.end(),
              [](const Spot& a, const Spot& b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
    std::vector<Spot> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = hull.size();
        for (const Spot& place : places) {
            while (hull.size() >= first + 2) {
                const Spot &from = hull[hull.size() - 2], &middle = hull.back();
                const double ax = middle.x - from.x, ay = middle.y - from.y, bx = place.x - from.x,
                             by = place.y - from.y;
                if (ax * by - ay * bx > near * std::sqrt(bx * bx + by * by)) break;
                hull.pop_back();
            }
            hull.push_back(place);
        }
        hull.pop_back();  // where the other side begins
        std::reverse(places.begin(), places.end());
    }
    return hull;
}

}  // namespace

void keepCorners(const Elements& elements, std::span<const dvec3> x, std::vector<ContactConstraint>& pairs) {
    std::map<std::pair<int, int>, std::vector<std::size_t>> ofSolids;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const int a = elements.surfaceOf(pairs[p].points[0]), b = elements.surfaceOf(pairs[p].points[3]);
        if (elements.surface(a).solid >= 0 && elements.surface(b).solid >= 0) ofSolids[std::minmax(a, b)].push_back(p);
    }
    std::vector<bool> isInner(pairs.size(), false);
    std::vector<Spot> places;
    for (auto& [solids, left] : ofSolids)
        while (left.size() > fewPairs) {
            const ContactConstraint first = pairs[left.front()];
            const dvec3 across = acrossOf(first.normal), other = glm::cross(first.normal, across);
            const double near = sameShare * first.thickness;
            places.clear();
            std::erase_if(left, [&](std::size_t p) {
                const ContactConstraint& pair = pairs[p];
                if (std::abs(glm::dot(pair.normal, first.normal)) < 1.0 - sameNormal) return false;
                if (std::abs(pair.distance - first.distance) > near) return false;
                dvec3 place = pair.place.value_or(dvec3(0.0));
                for (std::size_t k = 0; !pair.place && k < static_cast<std::size_t>(pair.firstSide()); ++k)
                    place += pair.weights[k] * x[static_cast<std::size_t>(pair.points[k])];
                places.push_back({glm::dot(place, across), glm::dot(place, other), p});
                return true;
            });
            for (const Spot& place : places) isInner[place.pair] = true;
            for (const Spot& corner : hullOf(places, near)) isInner[corner.pair] = false;
        }
    std::size_t p = 0;
    std::erase_if(pairs, [&](const ContactConstraint&) { return isInner[p++]; });
}

}  // namespace taut::contact
