// A rope between two points, or a ring.
#pragma once

#include <optional>

#include "taut/core/value.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

struct RopePlaceSpec {
    dvec3 position{0.0};  // [m]
};

struct RopeSpec final : SpecOf<RopeSpec, BodySpec> {
    static constexpr const char* kindName = "rope";
    dvec3 start{0.0}, end{1.0, 0.0, 0.0};  // ends = [[…], […]] in the file [m]
    int segments = 40;
    double length = 0.0;  // natural length [m]; 0: the distance of the ends
    std::vector<RopePlaceSpec> through;
    bool isClosed = false;           // a ring
    double mass = 1.0;               // [kg]
    double stretch = 1e4;            // EA [N]
    double bend = 0.0;               // EA of the span-2 springs [N]
    std::optional<double> rigidity;  // EI of bending [N m²]; none: no bending rigidity
    bool isCurvedAtRest = false;     // it keeps the curve in which it is laid
    double dampingTime = 1e-4;       // [s]
    double drag = 0.3;               // [1/s]
    double radius = 0.02;            // [m] for drawing
    mechanics::Lumping lumping = mechanics::Lumping::weighted;
    PlasticitySpec plasticity{};

    TAUT_VALUE(RopeSpec);
    static fields::Section section();
    mechanics::Model build(const SceneSpec& scene) const override;
    PlasticitySpec plasticityIn(const SceneSpec&) const override { return plasticity; }
    BodyOutline outline(const SceneSpec&) const override;
    std::unique_ptr<BodyDrawing> drawing(const Body& body) const override;
};

}  // namespace taut::world
