// A deformable block: a box, or the inside of a closed mesh from a file.
#pragma once

#include "taut/core/value.h"
#include "taut/mechanics/builders.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

struct BlockSpec final : SpecOf<BlockSpec, BodySpec>, MeshSource {
    TAUT_VALUE(BlockSpec);
    static constexpr const char* kindName = "block";
    // A box …
    dvec3 size{0.5, 0.5, 0.5};  // [m]
    ivec3 cells{4, 4, 4};
    // … or a mesh.
    double cell = 0.05;  // [m] side of its cells
    double scale = 1.0;

    dvec3 position{0.0};            // of the centre, or of the mesh's origin [m]
    dvec3 rotation{0.0};            // [rad]
    double density = 300.0;         // [kg/m³]
    double young = 2e4;             // [Pa]
    std::optional<double> poisson;  // [-]; 0.4 if there is no bulk either
    std::optional<double> bulk;     // [Pa]; then young is that of the springs alone
    double dampingTime = 1e-3;      // [s]
    double drag = 0.1;              // [1/s]
    double workingStretch = 1.5;    // stretch up to which the step must hold [-]
    mechanics::Lumping lumping = mechanics::Lumping::weighted;
    PlasticitySpec plasticity{};

    static fields::Section section();
    mechanics::Model build(const SceneSpec& scene) const override;
    PlasticitySpec plasticityIn(const SceneSpec&) const override { return plasticity; }
    BodyOutline outline(const SceneSpec&) const override;
    std::unique_ptr<BodyDrawing> drawing(const Body& body) const override;
    using BodySpec::meshSource;
    const MeshSource* meshSource() const override { return this; }
    bool hasCarriedSurface() const override { return meshData != nullptr; }

    // Finds the cells that its mesh fills. The loader calls it; where it was not called, they are found when asked for.
    // Throws core::Error(badContent), naming the mesh and a line of it, for one that has no inside.
    void fillMesh();
    // Its cells. Throws as fillMesh() does, naming the scene as well.
    std::shared_ptr<const mechanics::Lattice> lattice() const;
    // The shape to build, of these cells.
    mechanics::BlockShape shapeOf(const mechanics::Lattice& cells) const;

  private:
    std::shared_ptr<const mechanics::Lattice> filled_;  // by its mesh; null: not yet known
};

}  // namespace taut::world
