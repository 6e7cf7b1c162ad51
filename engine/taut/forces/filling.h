// A gas or a liquid in bodies whose surfaces enclose it.
#pragma once

#include <string>
#include <vector>

#include "taut/spec/force_spec.h"
#include "taut/spec/specs.h"

namespace taut::mechanics {
enum class FillingKeeps;
}

namespace taut::world {

// Each part of the surfaces that hangs together has a filling of its own.
struct FillingSpec final : SpecOf<FillingSpec, ForceSpec> {
    static constexpr const char* kindName = "filling";
    std::vector<std::string> in;      // bodies, e.g. "cloth.ball"
    double pressure = 0;              // [Pa] more than outside, at the first volume
    mechanics::FillingKeeps keeps{};  // the pressure
    double bulkModulus = 1e6;         // [Pa] for a kept volume

    static fields::Section section();
    std::shared_ptr<const Force> make(const SceneSpec& scene) const override;
    void checkBodies(std::span<Body* const> bodies) const override;
};

}  // namespace taut::world
