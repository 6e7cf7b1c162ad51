#include "taut/bodies/private/bare_faces.h"

#include <algorithm>
#include <map>

namespace taut::world {

std::vector<std::array<int, 3>> bareFaces(const Body& body) {
    if (body.damage.goneTetrahedra() == 0) return {};
    using Face = std::array<int, 3>;
    const auto key = [](Face face) {
        std::sort(face.begin(), face.end());
        return face;
    };
    std::map<Face, int> users;
    for (std::size_t t = 0; t < body.model.triangles.size(); ++t)
        if (!body.damage.isTriangleGone(t)) ++users[key(body.model.triangles[t])];
    std::vector<Face> faces;
    for (std::size_t c = 0; c < body.model.cells.size(); ++c) {
        for (std::size_t n = 0; n < mechanics::cellTetrahedra.size(); ++n) {
            if (body.damage.isTetrahedronGone(c, n)) continue;
            const std::array<int, 4> p = tetrahedronOf(body.model.cells[c], n);
            for (const Face& face :
                 {Face{p[0], p[2], p[1]}, Face{p[0], p[1], p[3]}, Face{p[0], p[3], p[2]}, Face{p[1], p[2], p[3]}}) {
                ++users[key(face)];
                faces.push_back(face);
            }
        }
    }
    std::erase_if(faces, [&](const Face& face) { return users[key(face)] > 1; });
    return faces;
}

}  // namespace taut::world
