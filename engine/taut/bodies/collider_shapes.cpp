#include <algorithm>
#include <cmath>

#include "taut/bodies/drawing.h"
#include "taut/core/error.h"
#include "taut/spec/private/motion.h"
#include "taut/spec/private/rotation.h"

namespace taut::world {
namespace {

collision::ShapeSizes sizesOf(const ColliderSpec& spec) {
    collision::ShapeSizes sizes;
    sizes.normal = spec.normal / std::sqrt(glm::dot(spec.normal, spec.normal));
    sizes.halfSize = 0.5 * spec.size;
    sizes.radius = spec.radius;
    sizes.height = spec.height;
    sizes.edge = spec.edge;
    sizes.own = spec.sizes;
    if (spec.meshData != nullptr) {
        for (const dvec3& x : spec.meshData->positions) sizes.vertices.push_back(spec.scale * x);
        for (const auto& triangle : spec.meshData->triangles)
            for (int i : triangle) sizes.triangles.push_back(static_cast<std::uint32_t>(i));
    }
    return sizes;
}

bool isFloor(const ColliderSpec& spec) {
    return spec.shape == "plane" && spec.normal.y > 0 && spec.normal.x == 0 && spec.normal.z == 0 &&
           spec.rotation == dvec3(0.0) && spec.keys.empty();
}

// Makes the shape of a collider, and the pieces that are drawn.
class Maker {
  public:
    Maker(const collision::ShapeKinds& kinds, const ColliderSpec& whole, std::span<const ColliderSpec> all,
          std::vector<ColliderModel::Piece>* pieces)
        : kinds_(kinds), whole_(whole), all_(all), pieces_(pieces) {}

    collision::Shape make(const ColliderSpec& spec, const glm::mat4& transform) const {
        collision::Shape shape;
        if (spec.shape == "compound") {
            for (const ColliderSpec& part : spec.parts) {
                const collision::Pose pose{part.position, rotationOf(part.rotation)};
                shape.parts.push_back({make(part, transform * matrixOf(pose)), pose});
            }
            return shape;
        }
        const collision::ShapeKind* kind = kinds_.find(spec.shape);
        if (kind == nullptr) throw core::Error(core::ErrorKind::badContent, "there is no shape \"" + spec.shape + "\"");
        collision::ShapeSizes sizes = sizesOf(spec);
        for (const collision::OwnSize& own : kind->own) sizes.own.emplace(own.key, own.standard);
        shape.form = kind->form(sizes);
        if (kind->convex) shape.convex = kind->convex(sizes, 0.0);
        sizes.stands = stands(sizes, transform);
        if (pieces_ != nullptr)
            pieces_->push_back({kind->mesh(sizes), transform, finishOf(spec.ownFinish.value_or(whole_.finish))});
        return shape;
    }

  private:
    // Whether it stands upright on a floor at the start, or is sunk into one.
    bool stands(const collision::ShapeSizes& sizes, const glm::mat4& transform) const {
        constexpr double near = 1e-4;  // [m]
        const glm::mat4 at = matrixOf(poseAt(whole_, 0.0)) * transform;
        return at[1].y > 1.0F - 1e-6F && std::any_of(all_.begin(), all_.end(), [&](const ColliderSpec& other) {
                   return isFloor(other) && at[3].y - sizes.halfSize.y < other.position.y + near;
               });
    }

    const collision::ShapeKinds& kinds_;
    const ColliderSpec& whole_;
    std::span<const ColliderSpec> all_;
    std::vector<ColliderModel::Piece>* pieces_;  // null: the collider is not drawn
};

}  // namespace

glm::mat4 matrixOf(const collision::Pose& pose) {
    glm::mat4 m(glm::mat4_cast(pose.rotation));
    m[3] = glm::vec4(glm::vec3(pose.position), 1.0F);
    return m;
}

std::shared_ptr<const ColliderModel> makeColliderModel(const ColliderSpec& spec, const collision::ShapeKinds& kinds,
                                                       bool mayTurn, std::span<const ColliderSpec> all) {
    auto model = std::make_shared<ColliderModel>();
    model->material = {spec.friction, spec.restitution};
    model->isGround = isFloor(spec) && !mayTurn;
    const bool isFigure = spec.shape == "figure";
    const bool isDrawn = spec.visible && !model->isGround && !isFigure;
    try {  // errors are found here, where the line is known
        if (isFigure && (spec.meshData == nullptr || spec.meshData->figure == nullptr))
            throw core::Error(core::ErrorKind::badContent, "a figure needs a glTF file; shape = \"mesh\" takes OBJ");
        if (isFigure) model->figure = std::make_shared<const ColliderFigure>(spec);
        model->shape = Maker(kinds, spec, all, isDrawn ? &model->pieces : nullptr).make(spec, glm::mat4(1.0F));
        collision::Colliders().add(model->shape, model->material, poseAt(spec, 0.0));
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), spec.source.file + ":" + std::to_string(spec.source.line) + ":" +
                                            std::to_string(spec.source.column) + ": error: collider." + spec.name +
                                            ": " + error.what());
    }
    return model;
}

}  // namespace taut::world
