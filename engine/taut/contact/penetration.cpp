#include "taut/contact/penetration.h"

#include <algorithm>
#include <cmath>

#include "taut/contact/closest_points.h"

namespace taut::contact {
namespace {

// Where an edge pierces a triangle.
struct Passage {
    int surface;
    double share;  // of the way along the edge
    dvec3 normal;  // out, unit
    double steep;  // sine of the edge's angle with the triangle; above 0: the edge goes out
    dvec3 place;
};

// [m] The height of a piece with one triangle, from the piece's end.
double heightOf(const Passage& passage, const dvec3& end) {
    return std::abs(glm::dot(passage.normal, end - passage.place));
}

}  // namespace

double penetrationOf(const Elements& elements, std::span<const Crossing> crossings, std::span<const dvec3> x,
                     const std::function<bool(int surface)>& isWanted) {
    double most = 0;
    std::vector<Passage> passages;
    for (std::size_t first = 0, last = 0; first < crossings.size(); first = last) {
        while (last < crossings.size() && crossings[last].edge == crossings[first].edge) ++last;
        const Edge& edge = elements.edges()[static_cast<std::size_t>(crossings[first].edge)];
        if (!elements.isRigid(edge.surface)) continue;
        const dvec3 &a = x[static_cast<std::size_t>(edge.a)], &b = x[static_cast<std::size_t>(edge.b)];
        const double size = length(b - a);
        // Where this edge pierces wanted triangles, sorted by surface and then along the edge.
        passages.clear();
        for (std::size_t c = first; c < last; ++c) {
            const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(crossings[c].triangle)];
            if (!isWanted(triangle.surface)) continue;
            const dvec3 normal = outOfEdge(edge, triangle, x);
            passages.push_back({triangle.surface, crossings[c].weights[1], normal, glm::dot(normal, b - a) / size,
                                crossings[c].place});
        }
        std::stable_sort(passages.begin(), passages.end(), [](const Passage& p, const Passage& q) {
            return p.surface < q.surface || (p.surface == q.surface && p.share < q.share);
        });
        // A piece has two triangles, or starts at one and ends in the open, or the other way round (penetration.h).
        for (std::size_t k = 0; k < passages.size(); ++k) {
            const Passage& here = passages[k];
            const bool isLast = k + 1 == passages.size() || passages[k + 1].surface != here.surface;
            const bool isFirst = k == 0 || passages[k - 1].surface != here.surface;
            if (here.steep > 0 && !isLast && passages[k + 1].steep < 0) {
                const double sines = here.steep - passages[k + 1].steep;
                most = std::max(
                    most, (passages[k + 1].share - here.share) * size * here.steep * -passages[k + 1].steep / sines);
            } else if (here.steep > 0) {
                most = std::max(most, heightOf(here, isLast ? b : passages[k + 1].place));
            } else if (isFirst || !(passages[k - 1].steep > 0)) {
                most = std::max(most, heightOf(here, isFirst ? a : passages[k - 1].place));
            }
        }
    }
    return most;
}

}  // namespace taut::contact
