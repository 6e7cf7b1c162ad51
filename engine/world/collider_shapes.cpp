#include <cmath>

#include "taut/core/error.h"
#include "taut/world/drawing.h"
#include "taut/world/motion.h"
#include "taut/world/rotation.h"

namespace taut::world {
namespace {

constexpr float creaseAngle = 0.7F;    // [rad] edges of a mesh sharper than this look sharp
constexpr float planeHalfSize = 6.0F;  // [m] of a tilted plane, drawn as a board

collision::Shape shapeOf(const ColliderSpec& spec) {
    collision::Shape shape;
    const auto vertices = [&] {
        TAUT_EXPECTS(spec.meshData != nullptr);
        for (const dvec3& x : spec.meshData->positions) shape.vertices.push_back(spec.scale * x);
    };
    if (spec.shape == "plane") {
        shape.kind = collision::ShapeKind::plane;
        shape.normal = spec.normal / std::sqrt(glm::dot(spec.normal, spec.normal));
    } else if (spec.shape == "box") {
        shape.kind = collision::ShapeKind::box;
        shape.halfSize = 0.5 * spec.size;
    } else if (spec.shape == "sphere" || spec.shape == "capsule" || spec.shape == "cylinder" || spec.shape == "cone") {
        shape.kind = spec.shape == "sphere"     ? collision::ShapeKind::sphere
                     : spec.shape == "capsule"  ? collision::ShapeKind::capsule
                     : spec.shape == "cylinder" ? collision::ShapeKind::cylinder
                                                : collision::ShapeKind::cone;
        shape.radius = spec.radius;
        shape.height = spec.height;
    } else if (spec.shape == "hull") {
        shape.kind = collision::ShapeKind::hull;
        vertices();
    } else if (spec.shape == "mesh") {
        shape.kind = collision::ShapeKind::mesh;
        vertices();
        for (const auto& triangle : spec.meshData->triangles)
            for (int i : triangle) shape.triangles.push_back(static_cast<std::uint32_t>(i));
    } else {
        TAUT_EXPECTS(spec.shape == "compound");
        shape.kind = collision::ShapeKind::compound;
        for (const ColliderSpec& part : spec.parts)
            shape.parts.push_back({shapeOf(part), {part.position, rotationOf(part.rotation)}});
    }
    return shape;
}

view::Mesh meshOf(const ColliderSpec& spec) {
    const auto radius = static_cast<float>(spec.radius), height = static_cast<float>(spec.height);
    if (spec.shape == "box") return view::boxMesh(glm::vec3(0.5 * spec.size), static_cast<float>(spec.edge));
    if (spec.shape == "sphere") return view::sphereMesh(radius);
    if (spec.shape == "capsule") return view::capsuleMesh(radius, height);
    if (spec.shape == "cylinder") return view::cylinderMesh(radius, height);
    if (spec.shape == "cone") return view::coneMesh(radius, height);
    if (spec.shape == "plane") return view::quadMesh(glm::vec3(spec.normal), planeHalfSize);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;
    for (const dvec3& x : spec.meshData->positions) positions.emplace_back(spec.scale * x);
    for (const auto& triangle : spec.meshData->triangles)
        for (int i : triangle) triangles.push_back(static_cast<std::uint32_t>(i));
    return view::creasedMesh(positions, triangles, creaseAngle);
}

void addPieces(const ColliderSpec& spec, const FinishSpec& finish, const glm::mat4& transform, ColliderModel& model) {
    if (spec.shape != "compound") {
        model.pieces.push_back({meshOf(spec), transform, finishOf(finish)});
        return;
    }
    for (const ColliderSpec& part : spec.parts)
        addPieces(part, finish, transform * matrixOf({part.position, rotationOf(part.rotation)}), model);
}

}  // namespace

glm::mat4 matrixOf(const collision::Pose& pose) {
    glm::mat4 m(glm::mat4_cast(pose.rotation));
    m[3] = glm::vec4(glm::vec3(pose.position), 1.0F);
    return m;
}

std::shared_ptr<const ColliderModel> makeColliderModel(const ColliderSpec& spec, bool mayTurn) {
    auto model = std::make_shared<ColliderModel>();
    model->shape = shapeOf(spec);
    model->material = {spec.friction, spec.restitution};
    model->isGround = spec.shape == "plane" && spec.normal.y > 0 && spec.normal.x == 0 && spec.normal.z == 0 &&
                      spec.rotation == dvec3(0.0) && spec.keys.empty() && !mayTurn;
    if (spec.visible && !model->isGround) addPieces(spec, spec.finish, glm::mat4(1.0F), *model);
    try {  // a shape that Bullet cannot take is found here, where its line is known
        collision::Colliders().add(model->shape, model->material, poseAt(spec, 0.0));
    } catch (const core::Error& error) {
        throw core::Error(error.code(), spec.source.file + ":" + std::to_string(spec.source.line) + ":" +
                                            std::to_string(spec.source.column) + ": error: collider." + spec.name +
                                            ": " + error.what());
    }
    return model;
}

}  // namespace taut::world
