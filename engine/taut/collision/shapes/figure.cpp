// A mesh that an animation moves. It has no form: contact between surfaces stops bodies at its faces.
#include <limits>

#include "taut/collision/shape_table.h"

namespace taut::collision {
namespace {

class NoForm final : public Form {
  public:
    Nearest nearest(const dvec3&) const override { return {std::numeric_limits<double>::infinity(), {0.0, 1.0, 0.0}}; }
    bool sweep(const Path&, HalfSpace&, bool&) const override { return false; }
    std::optional<core::Aabb> bounds() const override { return core::Aabb{dvec3(0.0), dvec3(0.0)}; }
};

}  // namespace

ShapeKind figureKind() {
    return {.name = "figure",
            .fields = {"mesh", "scale", "animation"},
            .extent = Extent::animated,
            .form = [](const ShapeSizes&) { return std::make_shared<const NoForm>(); },
            .mesh = [](const ShapeSizes&) { return view::Mesh{}; }};
}

}  // namespace taut::collision
