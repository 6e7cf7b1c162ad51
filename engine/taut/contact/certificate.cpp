#include "taut/contact/certificate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "taut/contact/closest_points.h"

namespace taut::contact {
namespace {

constexpr double aslant = 0.98;      // cosine of the least angle between the normal and the axis of sides that pass by
constexpr double leftApart = 0.2;    // sliding apart leaves this share of the distance at x0
constexpr double leastApart = 0.02;  // sliding apart leaves at least this share of the thickness
constexpr double into = -0.5;        // cosine of a way with a collider's normal: below it the way leads into it

Corners cornersOf(const ContactConstraint& pair, std::span<const dvec3> x) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = x[static_cast<std::size_t>(pair.points[k])];
    return corners;
}

// How far all of the first side is above all of the second along an axis. Negative: it is not above.
double height(const Corners& corners, int firstSide, const dvec3& axis) {
    double low = 1e300, high = -1e300;
    for (int k = 0; k < 4; ++k) {
        const double at = glm::dot(axis, corners[static_cast<std::size_t>(k)]);
        if (k < firstSide)
            low = std::min(low, at);
        else
            high = std::max(high, at);
    }
    return low - high;
}

// Whether the axis, or the axis reversed, keeps the first side above the second before and after.
bool separates(const Corners& before, const Corners& after, int firstSide, const dvec3& axis) {
    if (height(before, firstSide, axis) > 0) return height(after, firstSide, axis) > 0;
    return height(before, firstSide, -axis) > 0 && height(after, firstSide, -axis) > 0;
}

// The normal of the triangle, or the common normal of both edges. Not unit.
dvec3 normalOf(const Corners& c, bool isPoint) {
    return isPoint ? glm::cross(c[2] - c[1], c[3] - c[1]) : glm::cross(c[1] - c[0], c[3] - c[2]);
}

// Finds the time of closest approach by bisection. At each time it tries the direction between the closest points as an
// axis. The axis has to separate by more than `enough` [m] at both ends, and its cosine with the normal has to be below
// mostAlike. If the sides do not turn, their Minkowski difference is a rigid body on a straight way. Then the direction
// at the closest time is the best axis there is.
bool separatesOnTheWay(const ContactConstraint& pair, const Corners& before, const Corners& after, double enough,
                       double mostAlike) {
    constexpr int halvings = 12;
    const int side = pair.firstSide();
    double from = 0, to = 1, t = 1;
    for (int k = 0; k <= halvings; ++k) {
        Corners now;
        for (std::size_t i = 0; i < 4; ++i) now[i] = before[i] + t * (after[i] - before[i]);
        const Closest on = closestPoints(now, pair.isPoint);
        const double size = length(on.separation);
        if (!(size > enough)) return false;
        const dvec3 axis = on.separation / size;
        if (glm::dot(axis, pair.normal) < mostAlike && height(before, side, axis) > enough &&
            height(after, side, axis) > enough)
            return true;
        // The sides close before the closest time, and part after it.
        double parting = 0;
        for (std::size_t i = 0; i < 4; ++i) parting += on.weights[i] * glm::dot(axis, after[i] - before[i]);
        if (k == 0 && parting <= 0) return false;
        (parting < 0 ? from : to) = t;
        t = 0.5 * (from + to);
    }
    return false;
}

}  // namespace

bool isCertified(const ContactConstraint& pair, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    const Corners before = cornersOf(pair, x0), after = cornersOf(pair, x1);
    const int side = pair.firstSide();

    // If the ways relative to the first point are shorter than the distance, no axis is needed.
    const dvec3 reference = after[0] - before[0];
    double first = 0, second = 0;
    for (int k = 1; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const dvec3 way = after[i] - before[i] - reference;
        double& most = k < side ? first : second;
        most = std::max(most, glm::dot(way, way));
    }
    if (std::sqrt(first) + std::sqrt(second) < pair.distance) return true;

    // Cheap axes first: the normal at x0, the elements' normals at x0 and x1, the separation at x1, and the mean of
    // the first and the last.
    if (separates(before, after, side, pair.normal)) return true;
    if (separates(before, after, side, normalOf(before, pair.isPoint))) return true;
    if (separates(before, after, side, normalOf(after, pair.isPoint))) return true;
    const dvec3 last = closestPoints(after, pair.isPoint).separation;
    if (separates(before, after, side, last)) return true;
    const double size = length(last);
    if (size > 0 && separates(before, after, side, pair.normal + last / size)) return true;

    // Then a search over time.
    return separatesOnTheWay(pair, before, after, 0.0, 2.0);
}

bool misses(const ContactConstraint& pair, std::span<const dvec3> x0, std::span<const dvec3> x1, double share) {
    return separatesOnTheWay(pair, cornersOf(pair, x0), cornersOf(pair, x1), share * pair.thickness, aslant);
}

bool slideApart(const ContactConstraint& pair, std::span<const double> inverseMass,
                std::span<const KinematicContact> kinematic, std::span<dvec3> x1, std::span<dvec3> v,
                std::vector<int>& moved) {
    // The point of each side that went deepest.
    int lowest = -1, highest = -1;
    double low = 1e300, high = -1e300;
    for (int k = 0; k < 4; ++k) {
        const int i = pair.points[static_cast<std::size_t>(k)];
        const double at = glm::dot(pair.normal, x1[static_cast<std::size_t>(i)]);
        if (k < pair.firstSide()) {
            if (at < low) lowest = i;
            low = std::min(low, at);
        } else {
            if (at > high) highest = i;
            high = std::max(high, at);
        }
    }
    const auto a = static_cast<std::size_t>(lowest), b = static_cast<std::size_t>(highest);
    // A point that would move into a collider counts as immovable.
    const auto inverseMassOf = [&](int point, const dvec3& way) {
        auto own = std::lower_bound(kinematic.begin(), kinematic.end(), point,
                                    [](const KinematicContact& contact, int i) { return contact.point() < i; });
        for (; own != kinematic.end() && own->point() == point; ++own)
            if (own->points[1] < 0 && glm::dot(own->normal, way) < into) return 0.0;
        return inverseMass[static_cast<std::size_t>(point)];
    };
    const double inverseA = inverseMassOf(lowest, pair.normal), inverseB = inverseMassOf(highest, -pair.normal);
    const double inverse = inverseA + inverseB;
    // Move the points apart, then stop their approach.
    const double wanted = std::max(leftApart * pair.distance, leastApart * pair.thickness);
    const double missing = wanted - (low - high);
    if (!(inverse > 0) || !(missing > 0)) return false;
    const double shareA = inverseA / inverse, shareB = inverseB / inverse;
    x1[a] += (shareA * missing) * pair.normal;
    x1[b] -= (shareB * missing) * pair.normal;
    const double approach = -glm::dot(pair.normal, v[a] - v[b]);
    if (approach > 0) {
        v[a] += (shareA * approach) * pair.normal;
        v[b] -= (shareB * approach) * pair.normal;
    }
    if (shareA > 0) moved.push_back(lowest);
    if (shareB > 0) moved.push_back(highest);
    return true;
}

void moveAsImpactZones(std::span<const ContactConstraint* const> pairs, std::span<const double> inverseMass, double h,
                       std::span<const dvec3> x0, std::span<dvec3> x1, std::span<dvec3> v, std::vector<int>& moved) {
    // Zones by union-find: the root is the lowest point.
    std::map<int, int> parent;
    const auto root = [&](int i) {
        while (parent.at(i) != i) i = parent.at(i);
        return i;
    };
    for (const ContactConstraint* pair : pairs) {
        for (int i : pair->points) parent.try_emplace(i, i);
        for (std::size_t k = 1; k < 4; ++k) {
            const int a = root(pair->points[0]), b = root(pair->points[k]);
            parent.at(std::max(a, b)) = std::min(a, b);
        }
    }
    // Sums over the points of a zone.
    struct Zone {
        dvec3 way{0.0};       // [kg m] mass × way
        dvec3 fixedWay{0.0};  // [m] sum of the ways of points that nothing moves
        double mass = 0;      // [kg]
        int fixed = 0;        // number of points that nothing moves
    };
    std::map<int, Zone> zones;
    for (const auto& entry : parent) {
        const int i = entry.first;
        Zone& zone = zones[root(i)];
        const auto k = static_cast<std::size_t>(i);
        const dvec3 way = x1[k] - x0[k];
        if (inverseMass[k] > 0) {
            zone.way += way / inverseMass[k];
            zone.mass += 1.0 / inverseMass[k];
        } else {
            zone.fixedWay += way;
            ++zone.fixed;
        }
    }
    // Each movable point goes the zone's mean way, and its velocity changes accordingly.
    for (const auto& entry : parent) {
        const auto k = static_cast<std::size_t>(entry.first);
        if (!(inverseMass[k] > 0)) continue;
        const Zone& zone = zones.at(root(entry.first));
        const dvec3 way = zone.fixed > 0 ? zone.fixedWay / static_cast<double>(zone.fixed) : zone.way / zone.mass;
        const dvec3 x = x0[k] + way;
        v[k] += (x - x1[k]) / h;
        x1[k] = x;
        moved.push_back(entry.first);
    }
}

}  // namespace taut::contact
