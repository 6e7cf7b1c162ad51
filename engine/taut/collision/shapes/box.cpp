// A box about its middle.
#include <BulletCollision/CollisionShapes/btBoxShape.h>

#include <algorithm>

#include "taut/collision/private/bullet_convex.h"
#include "taut/collision/private/shapes/shape_parts.h"

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

std::shared_ptr<const Convex> makeBox(const ShapeSizes& sizes, double rounding) {
    for (int k = 0; k < 3; ++k) expectSize(sizes.halfSize[k], "box: a half size");
    return std::make_shared<const BoxConvex>(sizes.halfSize, rounding);
}

// Corner i is on the positive side of axis k if bit k of i is set.
SolidShape solidBox(const ShapeSizes& sizes, double rounding) {
    static constexpr const char* names[3][2] = {{"left", "right"}, {"bottom", "top"}, {"back", "front"}};
    SolidShape box;
    for (int i = 0; i < 8; ++i) {
        dvec3& corner = box.positions.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const int side = (i >> k) & 1;
            corner[k] = side != 0 ? sizes.halfSize[k] : -sizes.halfSize[k];
            box.sides[names[k][side]].push_back(i);
        }
    }
    for (int k = 0; k < 3; ++k) {
        const int u = 1 << ((k + 1) % 3), v = 1 << ((k + 2) % 3), top = 1 << k;
        box.triangles.push_back({top, top | u, top | u | v});
        box.triangles.push_back({top, top | u | v, top | v});
        box.triangles.push_back({0, u | v, u});
        box.triangles.push_back({0, v, u | v});
    }
    box.properties = core::massPropertiesOf(box.positions, box.triangles);
    for (dvec3& corner : box.positions) corner -= rounding * glm::sign(corner);
    return box;
}

}  // namespace

ShapeKind boxKind() {
    return {.name = "box",
            .fields = {"size", "edge"},
            .convex = makeBox,
            .mesh =
                [](const ShapeSizes& sizes) {
                    return view::boxMesh(glm::vec3(sizes.halfSize), static_cast<float>(sizes.edge), sizes.stands);
                },
            .solid = solidBox,
            .largestBall =
                [](const ShapeSizes& sizes) {
                    return std::min({sizes.halfSize.x, sizes.halfSize.y, sizes.halfSize.z});
                }};
}

}  // namespace taut::collision
