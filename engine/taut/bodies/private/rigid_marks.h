// Three inner points of a rigid body, one of each pair: they say where it is.
#pragma once

#include <array>

#include "taut/body/body.h"
#include "taut/collision/geometry.h"

namespace taut::world {

struct RigidMarks {
    std::array<int, 3> points;  // of the model
    std::array<dvec3, 3> rest;  // [m] at the start, without jitter
    // From the start to where these points are now.
    collision::Frame motionTo(const std::array<dvec3, 3>& now) const;
};

RigidMarks marksOf(const Body& body);

}  // namespace taut::world
