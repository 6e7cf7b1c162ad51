#include "taut/collision/outline.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "taut/collision/private/facets.h"
#include "taut/core/trig.h"

namespace taut::collision {
namespace {

// The direction from an edge to a place beside it, at right angles to the edge; unit, or zero.
dvec3 across(const dvec3& from, const dvec3& to, const dvec3& beside) {
    const dvec3 along = to - from, way = beside - from;
    const dvec3 off = way - (glm::dot(way, along) / glm::dot(along, along)) * along;
    const double size = std::sqrt(glm::dot(off, off));
    return size > 0.0 ? off / size : dvec3(0.0);
}

dvec3 cornerOf(const Facet& t, std::size_t k) {
    return k == 0 ? t.corner : t.corner + (k == 1 ? t.ab : t.ac);
}

}  // namespace

// A mesh is not convex, so its edges have no formula. Bullet's GJK takes 0.8 to 9 µs for a triangle of a body and one
// of the mesh, and has to be asked for all pairs; an edge and an edge take 15 ns in engine/contact.
Outline outlineOf(const Facets& facets) {
    struct Side {
        std::uint32_t a, b;      // vertices, the lower first
        std::uint32_t triangle;  //
        std::uint32_t apex;      // of its corners, 0 … 2
    };
    // The sides of all triangles, sorted so that those of one edge follow each other.
    std::vector<Side> sides;
    for (std::size_t i = 0; i < facets.corners.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = facets.corners[i + k], b = facets.corners[i + (k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(i / 3),
                             static_cast<std::uint32_t>((k + 2) % 3)});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
        return std::array{p.a, p.b, p.triangle} < std::array{q.a, q.b, q.triangle};
    });

    Outline outline;
    std::vector<int> numbers(facets.isBorder.size(), -1);
    const auto take = [&](const Side& side, std::size_t k) {
        int& number = numbers[facets.corners[3 * side.triangle + k]];
        if (number < 0) {
            number = static_cast<int>(outline.vertices.size());
            outline.vertices.push_back(cornerOf(facets.triangles[side.triangle], k));
        }
        return number;
    };
    // Edge by edge: leaves out edges that are not sharp and, in a closed surface, edges that do not stand out.
    const double least = core::cosine(leastSharpness);
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
        while (last < sides.size() && sides[last].a == sides[first].a && sides[last].b == sides[first].b) ++last;
        const Side& one = sides[first];
        const Facet& t = facets.triangles[one.triangle];
        const dvec3 a = cornerOf(t, (one.apex + 1) % 3), b = cornerOf(t, (one.apex + 2) % 3);
        const bool areTwo = last - first == 2;
        if (areTwo) {
            const Side& other = sides[first + 1];
            const dvec3 apex = cornerOf(facets.triangles[other.triangle], other.apex);
            if (glm::dot(across(a, b, cornerOf(t, one.apex)), across(a, b, apex)) <= -least) continue;
            if (facets.isClosed && glm::dot(t.normal, apex - a) >= 0.0) continue;
        }
        Outline::Edge edge{take(one, (one.apex + 1) % 3), take(one, (one.apex + 2) % 3)};
        if (last - first <= 2) edge.wingA = take(one, one.apex);
        if (areTwo) edge.wingB = take(sides[first + 1], sides[first + 1].apex);
        outline.edges.push_back(edge);
    }
    // Corners are the ends of these edges, each once.
    for (const Outline::Edge& edge : outline.edges) outline.corners.insert(outline.corners.end(), {edge.a, edge.b});
    std::sort(outline.corners.begin(), outline.corners.end());
    outline.corners.erase(std::unique(outline.corners.begin(), outline.corners.end()), outline.corners.end());
    return outline;
}

}  // namespace taut::collision
