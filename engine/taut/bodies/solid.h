// A rigid body.
#pragma once

#include "taut/core/value.h"
#include "taut/mechanics/rigid.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

// Sharp edges are rounded by the thickness as it touches: what is drawn is what others keep from, of meshes by the
// thickness.
struct SolidSpec final : SpecOf<SolidSpec, BodySpec>, MeshSource {
    static constexpr const char* kindName = "solid";
    std::string shape = "box";   // box, sphere, capsule, cylinder, cone, mesh, hull, compound
    dvec3 size{0.5, 0.5, 0.5};   // [m] of a box
    double radius = 0.25;        // [m]
    double height = 0.5;         // [m] of a cylinder or cone; of a capsule between the centres of its half spheres
    double scale = 1.0;          // of a mesh or hull
    dvec3 position{0.0};         // [m] of its origin
    dvec3 rotation{0.0};         // [rad]
    double density = 500.0;      // [kg/m³]
    std::optional<double> mass;  // [kg]; none: by its density
    double drag = 0.0;           // [1/s]
    double edge = 0.0;           // [m] rounding of a drawn box's edges
    // Of a compound: the shapes that it is made of, with places in it and own sizes, thicknesses, masses and looks. Its
    // density says nothing, and its mass is theirs if it has none.
    std::vector<SolidSpec> parts;

    TAUT_VALUE(SolidSpec);
    bool isRound() const { return shape == "sphere" || shape == "capsule"; }
    // [m] Radius of the largest ball in a shape that has sharp edges; of others without bound.
    double mostThickness() const;
    static fields::Section section();
    mechanics::Model build(const SceneSpec& scene) const override;
    bool isRigid() const override { return true; }
    std::vector<collision::PlacedConvex> pieces(const SceneSpec& scene) const override;
    std::unique_ptr<BodyDrawing> drawing(const Body& body) const override;
    const MeshSource* meshSource() const override { return this; }
    std::vector<const BodySpec*> shapes() const override;

  private:
    mechanics::RigidShape made() const;
    void addShape(mechanics::RigidShape& made) const;
};

}  // namespace taut::world
