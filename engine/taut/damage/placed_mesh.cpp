#include "taut/damage/private/placed_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

namespace taut::world {
namespace {

using glm::dvec3;
using Triangle = std::array<int, 3>;
using Edge = std::pair<int, int>;

Edge edge(int v, int w) {
    return {std::min(v, w), std::max(v, w)};
}

// Visits the edges of a triangle.
template <class Visit>
void eachEdge(const Triangle& t, const Visit& visit) {
    for (std::size_t k = 0; k < 3; ++k) visit(t[k], t[(k + 1) % 3]);
}

// From a halved edge before which there is one that is not, if there is such.
void addParts(const Triangle& t, const std::map<Edge, int>& middles, std::vector<Triangle>& parts) {
    std::array<int, 3> middle{-1, -1, -1};  // of the edge from corner k
    for (std::size_t k = 0; k < 3; ++k)
        if (const auto found = middles.find(edge(t[k], t[(k + 1) % 3])); found != middles.end())
            middle[k] = found->second;
    std::size_t first = 0;
    while (first < 3 && (middle[first] < 0 || middle[(first + 2) % 3] >= 0)) ++first;
    first %= 3;
    const int a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    const int ab = middle[first], bc = middle[(first + 1) % 3], ca = middle[(first + 2) % 3];
    if (ab < 0)
        parts.push_back(t);
    else if (bc < 0)
        parts.insert(parts.end(), {{a, ab, c}, {ab, b, c}});
    else if (ca < 0)
        parts.insert(parts.end(), {{ab, b, bc}, {a, ab, c}, {ab, bc, c}});
    else
        parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
}

}  // namespace

void refine(PlacedMesh& mesh, double longest, const std::function<bool(const Triangle&)>& isWanted) {
    const auto at = [&](int v) -> const dvec3& { return mesh.places[v]; };
    std::map<std::array<double, 3>, int> known;
    std::vector<int> one;  // (vertices) the first in that place
    for (const dvec3& x : mesh.places)
        one.push_back(known.try_emplace({x.x, x.y, x.z}, static_cast<int>(one.size())).first->second);
    const auto inPlace = [&](int v, int w) { return edge(one[v], one[w]); };
    for (bool isDone = false; !isDone;) {
        std::map<Edge, int> places, middles;  // of edges in one place the first middle; of edges
        for (const Triangle& t : mesh.triangles)
            eachEdge(t, [&](int v, int w) {
                if (glm::distance(at(v), at(w)) > longest && isWanted(t)) places.try_emplace(inPlace(v, w), -1);
            });
        for (const Triangle& t : mesh.triangles)
            eachEdge(t, [&](int v, int w) {
                if (places.contains(inPlace(v, w))) middles.try_emplace(edge(v, w), -1);
            });
        for (auto& [ends, middle] : middles) {
            middle = static_cast<int>(mesh.places.size());
            int& first = places.at(inPlace(ends.first, ends.second));
            if (first < 0) first = middle;
            one.push_back(first);
            mesh.places.push_back(0.5 * (at(ends.first) + at(ends.second)));
            mesh.uv.push_back(0.5 * (mesh.uv[ends.first] + mesh.uv[ends.second]));
        }
        std::vector<Triangle> parts;
        for (const Triangle& t : mesh.triangles) addParts(t, middles, parts);
        mesh.triangles = std::move(parts);
        isDone = middles.empty();
    }
}

}  // namespace taut::world
