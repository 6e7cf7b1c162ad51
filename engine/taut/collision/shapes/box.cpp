// A box about its middle.
#include <BulletCollision/CollisionShapes/btBoxShape.h>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/shapes/shape_parts.h"
#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

class BoxConvex final : public Convex {
  public:
    BoxConvex(const dvec3& half, double rounding)
        : Convex(shapeOf<btBoxShape>(half, rounding), rounding), core_(half - rounding) {}
    SupportingFace faceTowards(const dvec3& d) const override {
        const dvec3 size = glm::abs(d);
        const int axis = size.y >= size.x && size.y >= size.z ? 1 : size.x >= size.z ? 0 : 2;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double side = d[axis] < 0.0 ? -1.0 : 1.0;
        SupportingFace face;
        for (int i = 0; i < 4; ++i) {
            dvec3 corner;
            corner[axis] = side * core_[axis];
            corner[u] = (i == 0 || i == 3 ? -side : side) * core_[u];
            corner[v] = (i < 2 ? -1.0 : 1.0) * core_[v];
            face.add(corner);
        }
        return face;
    }

    ClosedShape closed() const override {
        const dvec3 half = halfSizeOf<btBoxShape>(*this);
        return {ClosedKind::box, {half.x, half.y, half.z}};
    }

  private:
    dvec3 core_;
};

std::shared_ptr<const Form> makeBox(const ShapeSizes& sizes) {
    for (int k = 0; k < 3; ++k) expectSize(sizes.halfSize[k], "box: a half size");
    return byFormula<ClosedKind::box>(BoxConvex(sizes.halfSize, 0.0));
}

}  // namespace

ShapeKind boxKind() {
    return {.name = "box",
            .fields = {"size", "edge"},
            .own = {},
            .isBounded = true,
            .form = makeBox,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::boxMesh(glm::vec3(sizes.halfSize), static_cast<float>(sizes.edge), sizes.stands);
                },
            .convex = [](const ShapeSizes& sizes,
                         double rounding) { return std::make_shared<const BoxConvex>(sizes.halfSize, rounding); }};
}

}  // namespace taut::collision
