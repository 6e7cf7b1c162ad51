// A rigid body.
#pragma once

#include "taut/core/value.h"
#include "taut/mechanics/rigid.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/shape_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

// Sharp edges are rounded by the thickness in contact: others keep from the drawn surface, of meshes by the thickness.
struct SolidSpec final : SpecOf<SolidSpec, BodySpec>, ShapeSpec {
    static constexpr const char* kindName = "solid";
    double density = 500.0;      // [kg/m³]
    std::optional<double> mass;  // [kg]; none: by its density
    double drag = 0.0;           // [1/s]
    // Of a compound: the shapes that it is made of, with places in it and own sizes, thicknesses, masses and looks. Its
    // density says nothing, and its mass is theirs if it has none.
    std::vector<SolidSpec> parts;

    TAUT_VALUE(SolidSpec);
    static fields::Section section(const collision::ShapeKinds& shapes = collision::builtInShapes());
    mechanics::Model build(const SceneSpec& scene) const override;
    bool isRigid() const override { return true; }
    collision::Frame axes() const override;
    std::vector<RigidPiece> pieces(const SceneSpec& scene) const override;
    std::unique_ptr<BodyDrawing> drawing(const Body& body) const override;
    const MeshSource* meshSource() const override { return this; }
    std::vector<const BodySpec*> shapes() const override;

  private:
    const collision::ShapeKind& kindIn(const collision::ShapeKinds& kinds) const;
    mechanics::RigidShape made(const collision::ShapeKinds& kinds) const;
    void addShape(const collision::ShapeKind& kind, mechanics::RigidShape& made) const;
    RigidPiece piece(const collision::ShapeKinds& kinds) const;
};

}  // namespace taut::world
