#include "taut/spec/shape_spec.h"

#include <algorithm>

#include "taut/core/error.h"
#include "taut/spec/private/shape_rows.h"
#include "taut/spec/spec.h"

namespace taut::world {

const collision::ShapeKind& shapeKindOf(const ShapeSpec& spec, const collision::ShapeKinds& kinds) {
    const collision::ShapeKind* kind = kinds.find(spec.shape);
    if (kind == nullptr) throw core::Error(core::ErrorKind::badContent, "there is no shape \"" + spec.shape + "\"");
    return *kind;
}

collision::ShapeSizes sizesOf(const ShapeSpec& spec, const collision::ShapeKind& kind) {
    collision::ShapeSizes sizes;
    sizes.halfSize = 0.5 * spec.size;
    sizes.radius = spec.radius;
    sizes.height = spec.height;
    sizes.edge = spec.edge;
    sizes.own = spec.sizes;
    for (const collision::OwnSize& own : kind.own) sizes.own.emplace(own.key, own.standard);
    if (spec.meshData != nullptr) {
        for (const dvec3& x : spec.meshData->positions) sizes.vertices.push_back(spec.scale * x);
        for (const auto& triangle : spec.meshData->triangles)
            for (int i : triangle) sizes.triangles.push_back(static_cast<std::uint32_t>(i));
    }
    return sizes;
}

const collision::ShapeKinds& SceneSpec::knownShapes() const {
    return shapes != nullptr ? *shapes : collision::builtInShapes();
}

bool SceneSpec::isFigure(const ColliderSpec& collider) const {
    const collision::ShapeKind* kind = knownShapes().find(collider.shape);
    return kind != nullptr && kind->extent == collision::Extent::animated;
}

bool bodiesTouch(const SceneSpec& spec) {
    return std::any_of(
        spec.bodies.begin(), spec.bodies.end(), [](const BodySpec& body) { return body.touch != Touch::nothing; });
}

void meetFigures(SceneSpec& spec) {
    if (std::any_of(spec.colliders.begin(), spec.colliders.end(), [&](const auto& c) { return spec.isFigure(c); }))
        for (BodySpec& body : spec.bodies) body.meetsFigures = body.collide;
}

std::vector<std::string> namesOf(const collision::ShapeKinds& shapes, std::string_view field) {
    std::vector<std::string> names;
    for (const collision::ShapeKind& kind : shapes.all())
        if (field.empty() || std::find(kind.fields.begin(), kind.fields.end(), field) != kind.fields.end())
            names.emplace_back(kind.name);
    return names;
}

}  // namespace taut::world
