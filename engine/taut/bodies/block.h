// A deformable block.
#pragma once

#include "taut/spec/body_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

struct BlockSpec final : SpecOf<BlockSpec, BodySpec> {
    static constexpr const char* kindName = "block";
    dvec3 size{0.5, 0.5, 0.5};  // [m]
    ivec3 cells{4, 4, 4};
    dvec3 position{0.0};            // centre [m]
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
};

}  // namespace taut::world
