// Springs of zero length from points to a place.
#pragma once

#include "taut/spec/force_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

// A spring of zero rest length from each target point to a place, or to a moving place.
struct AnchorSpec final : SpecOf<AnchorSpec, ForceSpec> {
    static constexpr const char* kindName = "anchor";
    std::string target;        // KIND.NAME@SELECTOR
    dvec3 at{0.0};             // [m]
    double stiffness = 100.0;  // [N/m] of each point
    double damping = 0.0;      // [kg/s] of each point

    static fields::Section section();
    std::shared_ptr<const Force> make(const SceneSpec& scene) const override;
    void checkBodies(std::span<Body* const> bodies) const override;
    std::string_view pulledPoints() const override { return target; }
};

}  // namespace taut::world
