#include <cmath>

#include "taut/core/error.h"
#include "taut/world/drawing.h"
#include "taut/world/motion.h"
#include "taut/world/rotation.h"

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

// What is made of a collider: its shape, and the pieces that are drawn.
class Maker {
  public:
    Maker(const collision::ShapeKinds& kinds, const FinishSpec& finish, std::vector<ColliderModel::Piece>* pieces)
        : kinds_(kinds), finish_(finish), pieces_(pieces) {}

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
        if (pieces_ != nullptr) pieces_->push_back({kind->mesh(sizes), transform, finishOf(finish_)});
        return shape;
    }

  private:
    const collision::ShapeKinds& kinds_;
    const FinishSpec& finish_;
    std::vector<ColliderModel::Piece>* pieces_;  // null: it is not drawn
};

}  // namespace

glm::mat4 matrixOf(const collision::Pose& pose) {
    glm::mat4 m(glm::mat4_cast(pose.rotation));
    m[3] = glm::vec4(glm::vec3(pose.position), 1.0F);
    return m;
}

std::shared_ptr<const ColliderModel> makeColliderModel(const ColliderSpec& spec, const collision::ShapeKinds& kinds,
                                                       bool mayTurn) {
    auto model = std::make_shared<ColliderModel>();
    model->material = {spec.friction, spec.restitution};
    model->isGround = spec.shape == "plane" && spec.normal.y > 0 && spec.normal.x == 0 && spec.normal.z == 0 &&
                      spec.rotation == dvec3(0.0) && spec.keys.empty() && !mayTurn;
    const bool isDrawn = spec.visible && !model->isGround;
    try {  // what cannot be is found here, where its line is known
        model->shape = Maker(kinds, spec.finish, isDrawn ? &model->pieces : nullptr).make(spec, glm::mat4(1.0F));
        collision::Colliders().add(model->shape, model->material, poseAt(spec, 0.0));
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), spec.source.file + ":" + std::to_string(spec.source.line) + ":" +
                                            std::to_string(spec.source.column) + ": error: collider." + spec.name +
                                            ": " + error.what());
    }
    return model;
}

}  // namespace taut::world
