// Points and springs listed one by one.
#pragma once

#include "taut/core/value.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

struct NetPointSpec {
    std::string name;
    dvec3 position{0.0};  // [m]
    double mass = 1.0;    // [kg]
    bool hold = false;
    Source source;
};
struct NetSpringSpec {
    std::string a, b;                   // names of two points
    double stiffness = 100.0;           // [N/m]
    std::optional<double> restLength;   // [m]; none: the distance at the start
    std::optional<double> dampingTime;  // [s]; none: the net's
    Source source;
};
struct NetSpec final : SpecOf<NetSpec, BodySpec> {
    static constexpr const char* kindName = "net";
    std::vector<NetPointSpec> points;
    std::vector<NetSpringSpec> springs;
    double dampingTime = 0.0;  // [s]
    double drag = 0.1;         // [1/s]
    double radius = 0.015;     // [m] of a drawn spring
    double ball = 0.06;        // [m] radius of a drawn point with a mass of 1 kg
    PlasticitySpec plasticity{};

    TAUT_VALUE(NetSpec);
    static fields::Section section();
    mechanics::Model build(const SceneSpec& scene) const override;
    PlasticitySpec plasticityIn(const SceneSpec&) const override { return plasticity; }
    BodyOutline outline(const SceneSpec&) const override;
    std::unique_ptr<BodyDrawing> drawing(const Body& body) const override;
};

}  // namespace taut::world
