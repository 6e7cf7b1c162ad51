#include "taut/collision/private/facets.h"

#include <algorithm>
#include <array>
#include <string>

#include "taut/core/error.h"

namespace taut::collision {

namespace {

constexpr std::size_t mostTriangles = 2'000'000;  // Bullet numbers a mesh's triangles with 21 bits

[[noreturn]] void failMesh(const std::string& what) {
    throw core::Error(core::ErrorKind::badContent, "collider mesh: " + what);
}

Facets takeTriangles(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles) {
    if (triangles.empty()) failMesh("has no triangles");
    if (triangles.size() % 3 != 0) failMesh("the number of its corners is not a multiple of three");
    if (triangles.size() / 3 > mostTriangles) failMesh("has more than two million triangles");
    for (const dvec3& v : vertices)
        if (!isFinite(v)) failMesh("a vertex is not finite");
    for (const std::uint32_t corner : triangles)
        if (corner >= vertices.size())
            failMesh("a triangle names vertex " + std::to_string(corner) + ", there are " +
                     std::to_string(vertices.size()));
    Facets facets;
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const dvec3& a = vertices[triangles[i]];
        const dvec3 ab = vertices[triangles[i + 1]] - a;
        const dvec3 ac = vertices[triangles[i + 2]] - a;
        const dvec3 bc = ac - ab;
        const dvec3 across = glm::cross(ab, ac);
        const double twiceArea = std::sqrt(glm::dot(across, across));
        const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
        if (!(twiceArea > 1e-12 * longest)) continue;  // a line or a point, which its neighbours cover
        facets.triangles.push_back({a, ab, ac, across / twiceArea});
        for (std::size_t k = 0; k < 3; ++k) facets.corners.push_back(triangles[i + k]);
    }
    if (facets.triangles.empty()) failMesh("all its triangles have no area");
    return facets;
}

// Gives vertices at one place the same number. Files repeat a vertex where its texture or normal differs.
void joinCorners(std::span<const dvec3> vertices, Facets& facets) {
    std::vector<std::uint32_t> order(vertices.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto key = [&](std::uint32_t i) { return std::array{vertices[i].x, vertices[i].y, vertices[i].z}; };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    std::vector<std::uint32_t> same(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        same[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? same[order[i - 1]] : order[i];
    for (std::uint32_t& corner : facets.corners) corner = same[corner];
    facets.isBorder.resize(vertices.size());
}

// Finds the border. An inner edge belongs to two triangles, which run through it in opposite directions. All other
// edges are the border.
void findBorder(Facets& facets) {
    using Edge = std::uint64_t;
    const auto edge = [](std::uint32_t a, std::uint32_t b) { return Edge{a} << 32 | b; };
    std::vector<Edge> edges;
    edges.reserve(facets.corners.size());
    for (std::size_t i = 0; i < facets.corners.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k)
            edges.push_back(edge(facets.corners[i + k], facets.corners[i + (k + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    facets.isClosed = true;
    for (const Edge e : edges) {
        const auto a = static_cast<std::uint32_t>(e >> 32);
        const auto b = static_cast<std::uint32_t>(e);
        const auto once = [&](Edge wanted) {
            const auto [first, last] = std::equal_range(edges.begin(), edges.end(), wanted);
            return last - first == 1;
        };
        if (once(e) && once(edge(b, a))) continue;
        facets.isBorder[a] = facets.isBorder[b] = true;
        facets.isClosed = false;
    }
}

// Turns the triangles of a closed surface so that their fronts face outwards.
void turnOutside(Facets& facets) {
    const dvec3 origin = facets.triangles[0].corner;
    double sixVolumes = 0.0;
    for (const Facet& t : facets.triangles) {
        const dvec3 a = t.corner - origin;
        sixVolumes += glm::dot(a, glm::cross(a + t.ab, a + t.ac));
    }
    if (sixVolumes >= 0.0) return;
    for (Facet& t : facets.triangles) {
        std::swap(t.ab, t.ac);
        t.normal = -t.normal;
    }
    for (std::size_t i = 0; i < facets.corners.size(); i += 3) std::swap(facets.corners[i + 1], facets.corners[i + 2]);
}

}  // namespace

Facets makeFacets(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles) {
    Facets facets = takeTriangles(vertices, triangles);
    joinCorners(vertices, facets);
    findBorder(facets);
    if (facets.isClosed) turnOutside(facets);
    return facets;
}

}  // namespace taut::collision
