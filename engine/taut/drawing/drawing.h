// How bodies and colliders become surfaces in a picture.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "taut/body/body.h"
#include "taut/collision/colliders.h"
#include "taut/collision/shape_table.h"
#include "taut/drawing/collider_figure.h"
#include "taut/spec/collider_spec.h"
#include "taut/view/frame_view.h"
#include "taut/view/primitives.h"

namespace taut::world {

class BlockFrame;

glm::vec3 linearColour(const dvec3& srgb);
std::shared_ptr<const view::Finish> finishOf(const FinishSpec& spec);

// Draws one body. Constant parts are made only once.
class BodyDrawing {
  public:
    virtual ~BodyDrawing() = default;
    // positions (points of the model) [m], in the order of authoring.
    virtual void addSurfaces(std::span<const glm::vec3> positions, std::vector<view::Surface>& surfaces) const = 0;
};
// Where a mesh from a file lies that is drawn in place of a body: its own place x at shift + turn (scale x).
struct MeshPlace {
    dvec3 shift{0.0};  // [m]
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    double scale = 1.0;
    dvec3 of(const dvec3& x) const;  // [m]
};
// Drawings of the model's triangles. A sheet has a front and a back; `skin` places its finish.skin. A sided drawing is
// a skin with sharp edges between the groups left, right, bottom, top, back and front.
std::unique_ptr<BodyDrawing> sheetDrawing(const Body& body, const MeshPlace& skin = {});
std::unique_ptr<BodyDrawing> sidedDrawing(const Body& body);
// The same of a block in place of which a mesh is drawn, its finish.skin or its own, that moves with its cells.
std::unique_ptr<BodyDrawing> sidedDrawing(const Body& body, const BlockFrame& frame, const MeshPlace& mesh);
// Springs as rods of this radius [m]. Points as balls of radius `ball` times the cube root of their mass; 0: no balls.
std::unique_ptr<BodyDrawing> rodDrawing(const Body& body, double radius, double ball);

// A collider's shape, for collision and for drawing.
struct ColliderModel {
    collision::Shape shape;
    collision::Material material;
    bool isPlane = false;
    bool isGround = false;  // a level plane: drawn as the floor
    struct Piece {
        view::Mesh mesh;
        glm::mat4 transform;  // from the piece to the collider
        std::shared_ptr<const view::Finish> finish;
    };
    std::vector<Piece> pieces;
    std::shared_ptr<const ColliderFigure> figure;  // null: it is rigid, and all that is drawn are its pieces
};
// A plane with `mayTurn` is drawn as a board, not as the floor. `all`: the scene's colliders, on whose floors it may
// stand. Throws core::Error(badContent) with file, line and column for a shape that cannot be built.
std::shared_ptr<const ColliderModel> makeColliderModel(const ColliderSpec& spec, const collision::ShapeKinds& kinds,
                                                       bool mayTurn, std::span<const ColliderSpec> all);

glm::mat4 matrixOf(const collision::Pose& pose);

}  // namespace taut::world
