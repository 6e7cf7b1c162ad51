// The bodies of the refinement study: the builder of each at any resolution, its measured quantity at rest, and the
// theory. Independent of the compared resolutions.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::study {

// The share of a point and a spring at the edge of a body. Weighted: their share of the material. Naive: m = M/n for
// every point, and the full stiffness for every spring.
struct Lumped {
    bool isMassNaive = false;
    bool areSpringsNaive = false;
};

struct RefinementBody {
    std::string name;             // "cloth-strip"
    std::string title;            // "Cloth strip under its own weight"
    std::string quantity;         // "stretch", of which value() tells metres
    std::optional<double> exact;  // [m] by theory; none: only the limit of ever finer bodies is known
    std::string theory;           // where that comes from
    bool hasEdgeSprings = true;   // whether springs may be naive
    std::function<mechanics::Model(int cells, Lumped)> build;
    std::function<double(const std::vector<glm::dvec3>&, int cells)> value;  // of the points at rest [m]
};

inline constexpr glm::dvec3 refinementGravity{0.0, -9.81, 0.0};  // [m/s²]

// Ropes, cloths and blocks. Cells are along the longest side, even.
std::span<const RefinementBody> refinementBodies();

}  // namespace taut::study
