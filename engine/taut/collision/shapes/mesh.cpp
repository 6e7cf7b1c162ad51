// A surface of triangles, unchanged from its file; the work is in triangle_mesh.h.
#include "taut/collision/private/triangle_mesh.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

constexpr float meshCrease = 0.7F;  // [rad] edges sharper than this look sharp

view::Mesh meshOfTriangles(const ShapeSizes& sizes) {
    const std::vector<glm::vec3> positions(sizes.vertices.begin(), sizes.vertices.end());
    return view::creasedMesh(positions, sizes.triangles, meshCrease);
}

SolidShape solidMesh(const ShapeSizes& sizes, double) {
    SolidShape solid{.positions = sizes.vertices};
    for (std::size_t k = 0; k + 2 < sizes.triangles.size(); k += 3)
        solid.triangles.push_back({static_cast<int>(sizes.triangles[k]), static_cast<int>(sizes.triangles[k + 1]),
                                   static_cast<int>(sizes.triangles[k + 2])});
    return solid;
}

}  // namespace

ShapeKind meshKind() {
    return {.name = "mesh",
            .fields = {"mesh", "scale"},
            .form =
                [](const ShapeSizes& sizes) {
                    return std::make_shared<const TriangleMesh>(sizes.vertices, sizes.triangles);
                },
            .mesh = meshOfTriangles,
            .solid = solidMesh};
}

}  // namespace taut::collision
