// How a joint that is one tie at a place finds its ends there: on a body, and on another one or on a collider.
#pragma once

#include <functional>
#include <variant>

#include "taut/body/spot.h"
#include "taut/collision/geometry.h"
#include "taut/plan/constraint.h"

namespace taut::world {

struct Mounting {
    using End = std::variant<Spot, Constraint::Place>;
    // Of places [m] in the scene as it starts. Spots are of the plan.
    std::function<Spot(const dvec3&)> a;
    std::function<End(const dvec3&)> b;
    collision::Frame at;  // the place, and the axes of the side whose own they are
    double size = 1;      // [m] of the bodies
    dvec3 centre{0.0};    // [m] of b, or of a if b is a collider
};

}  // namespace taut::world
