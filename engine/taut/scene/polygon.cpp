#include "taut/scene/private/polygon.h"

#include <cmath>
#include <cstddef>
#include <numeric>

namespace taut::scene {

namespace {

using glm::dvec2;
using glm::dvec3;

// Twice the signed area of a triangle in the plane.
double area(const dvec2& a, const dvec2& b, const dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The polygon seen along the axis in which it is flattest, mirrored if needed to run counter-clockwise.
std::vector<dvec2> flattened(std::span<const dvec3> corners) {
    dvec3 normal(0.0);  // Newell's method
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const dvec3& a = corners[i];
        const dvec3& b = corners[(i + 1) % corners.size()];
        normal.x += (a.y - b.y) * (a.z + b.z);
        normal.y += (a.z - b.z) * (a.x + b.x);
        normal.z += (a.x - b.x) * (a.y + b.y);
    }
    const dvec3 size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::vector<dvec2> flat;
    for (const dvec3& corner : corners)
        flat.push_back(normal[axis] < 0.0 ? dvec2(corner[v], corner[u]) : dvec2(corner[u], corner[v]));
    return flat;
}

// Whether the corner at place i of the ring can be cut off.
bool isEar(const std::vector<dvec2>& points, const std::vector<int>& ring, std::size_t i) {
    const auto at = [&](std::size_t k) { return points[ring[k % ring.size()]]; };
    const dvec2 a = at(i + ring.size() - 1), b = at(i), c = at(i + 1);
    if (!(area(a, b, c) > 0.0)) return false;
    for (std::size_t k = i + 2; k < i + ring.size() - 1; ++k) {
        const dvec2 p = at(k);
        if (p == a || p == b || p == c) continue;
        if (area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0) return false;
    }
    return true;
}

}  // namespace

std::vector<std::array<int, 3>> polygonTriangles(std::span<const dvec3> corners) {
    const std::vector<dvec2> points = flattened(corners);
    std::vector<int> ring(corners.size());
    std::iota(ring.begin(), ring.end(), 0);
    std::vector<std::array<int, 3>> triangles;
    while (ring.size() > 3) {
        // Starts at corner 1, so that a convex polygon becomes a fan about corner 0.
        std::size_t ear = 1;
        while (ear <= ring.size() && !isEar(points, ring, ear % ring.size())) ++ear;
        ear = ear > ring.size() ? 1 : ear % ring.size();
        triangles.push_back({ring[(ear + ring.size() - 1) % ring.size()], ring[ear], ring[(ear + 1) % ring.size()]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({ring[0], ring[1], ring[2]});
    return triangles;
}

}  // namespace taut::scene
