#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/drawing/drawing.h"
#include "taut/spec/private/motion.h"
#include "taut/spec/private/rotation.h"

namespace taut::world {
namespace {

bool isPlane(const ColliderSpec& spec, const collision::ShapeKinds& kinds) {
    const collision::ShapeKind* kind = kinds.find(spec.shape);
    return kind != nullptr && kind->extent == collision::Extent::halfSpace;
}

bool isFloor(const ColliderSpec& spec, const collision::ShapeKinds& kinds) {
    return isPlane(spec, kinds) && spec.normal.y > 0 && spec.normal.x == 0 && spec.normal.z == 0 &&
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
        const collision::ShapeKind& kind = shapeKindOf(spec, kinds_);
        if (kind.extent == collision::Extent::parts) {
            for (const ColliderSpec& part : spec.parts) {
                const collision::Pose pose{part.position, rotationOf(part.rotation)};
                shape.parts.push_back({make(part, transform * matrixOf(pose)), pose});
            }
            return shape;
        }
        collision::ShapeSizes sizes = sizesOf(spec, kind);
        sizes.normal = spec.normal / std::sqrt(glm::dot(spec.normal, spec.normal));
        shape = kind.shape(sizes);
        sizes.stands = stands(sizes, transform);
        if (pieces_ != nullptr)
            pieces_->push_back({kind.mesh(sizes), transform, finishOf(spec.ownFinish.value_or(whole_.finish))});
        return shape;
    }

  private:
    // Whether it stands upright on a floor at the start, or is sunk into one.
    bool stands(const collision::ShapeSizes& sizes, const glm::mat4& transform) const {
        constexpr double near = 1e-4;  // [m]
        const glm::mat4 at = matrixOf(poseAt(whole_, 0.0)) * transform;
        return at[1].y > 1.0F - 1e-6F && std::any_of(all_.begin(), all_.end(), [&](const ColliderSpec& other) {
                   return isFloor(other, kinds_) && at[3].y - sizes.halfSize.y < other.position.y + near;
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
    model->material = {spec.friction, spec.restitution, spec.turnFriction};
    model->isPlane = isPlane(spec, kinds);
    model->isGround = isFloor(spec, kinds) && !mayTurn;
    const collision::ShapeKind* kind = kinds.find(spec.shape);
    const bool isFigure = kind != nullptr && kind->extent == collision::Extent::animated;
    const bool isDrawn = spec.visible && !model->isGround && !isFigure;
    try {  // errors are found here, where the line is known
        if (isFigure && (spec.meshData == nullptr || spec.meshData->figure == nullptr))
            throw core::Error(core::ErrorKind::badContent, "a figure needs a glTF file; shape = \"mesh\" takes OBJ");
        if (isFigure) model->figure = std::make_shared<const ColliderFigure>(spec);
        model->shape = Maker(kinds, spec, all, isDrawn ? &model->pieces : nullptr).make(spec, glm::mat4(1.0F));
        collision::Colliders().add(model->shape, model->material, poseAt(spec, 0.0));
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), at(spec.source) + "collider." + spec.name + ": " + error.what());
    }
    return model;
}

}  // namespace taut::world
