// Shared by all builders: sets up the points of a model. It knows no shape.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <numeric>

#include "taut/mechanics/model.h"

namespace taut::mechanics::detail {

// Adds `count` free points at rest at the origin, without mass so far, with one drag rate. Makes the group "all".
inline void addRestingPoints(Model& model, int count, double dragRate) {
    const auto size = static_cast<std::size_t>(count);
    model.positions.assign(size, glm::dvec3(0.0));
    model.velocities.assign(size, glm::dvec3(0.0));
    model.masses.assign(size, 0.0);
    model.dragRates.assign(size, dragRate);
    model.held.assign(size, false);
    model.uv.assign(size, glm::dvec2(0.0));
    std::vector<int>& all = model.groups["all"];
    all.resize(size);
    std::iota(all.begin(), all.end(), 0);
}

// -0 + 0 = +0, and nothing else changes. So equal positions have equal bits.
inline glm::dvec3 withoutNegativeZero(glm::dvec3 p) {
    return p + glm::dvec3(0.0);
}

}  // namespace taut::mechanics::detail
