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

}  // namespace

ShapeKind meshKind() {
    return {.name = "mesh",
            .fields = {"mesh", "scale"},
            .own = {},
            .isBounded = true,
            .form =
                [](const ShapeSizes& sizes) {
                    return std::make_shared<const TriangleMesh>(sizes.vertices, sizes.triangles);
                },
            .mesh = meshOfTriangles};
}

}  // namespace taut::collision
