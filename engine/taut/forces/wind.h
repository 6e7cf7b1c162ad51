// Moving air, which acts on surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "taut/spec/force_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

struct WindSpec final : SpecOf<WindSpec, ForceSpec> {
    static constexpr const char* kindName = "wind";
    dvec3 velocity{0.0};       // [m/s]
    double gustAmplitude = 0;  // [m/s]
    double gustPeriod = 1.5;   // [s]
    double gustLength = 2.0;   // [m] size of an eddy
    std::int64_t gustSeed = 1;
    double drag = 1.0;            // drag coefficient of a triangle across the flow [-]
    double lift = 0.6;            // lift coefficient [-]
    std::vector<std::string> on;  // bodies on which it acts, e.g. "cloth.*"; empty: every cloth

    static fields::Section section();
    std::shared_ptr<const Force> make(const SceneSpec& scene) const override;
    std::vector<std::string> surroundedBodies() const override;
};

}  // namespace taut::world
