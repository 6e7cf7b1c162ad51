// A single shape in the world, with its motion during the step. A collider or a part of a compound is made of it.
#pragma once

#include <memory>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/collision/form.h"

namespace taut::collision {

struct Solid {
    std::shared_ptr<const Form> form;
    Frame inCollider;
    int collider = 0;
    Material material;

    Frame from, to;           // at the start and the end of the step
    std::vector<Frame> turn;  // between the two, at equal times; empty unless the solid turns far
    bool still = true;
    double travel = 0.0;  // [m] how far the collider's fastest corner goes during the step
    bool convex = true;
    ClosedShape closed;
    const FootFinder* feet = nullptr;  // of a mesh
    bool bounded = true;               // false: a plane
    HalfSpace above{};                 // a plane's half-space in the world at the end of the step
    core::Aabb localBounds;            // [m] unless it is a plane
    core::Aabb bounds;                 // [m] in the world, of the whole step
};

// During a step of h [s].
inline bool hasJumped(const Solid& solid, double h) {
    return solid.travel > fastestSurface * h;
}

// Throws core::Error(badContent) for a compound without parts or with a part whose pose is not finite.
void appendSolids(const Shape& shape, const Frame& inCollider, std::vector<Solid>& solids);

// The frame of a pose; throws core::Error(badContent) if it is not finite or has no rotation.
Frame frameOf(const Pose& pose);

// Sets from, to, turn, still and bounds of one solid. The caller sets travel, which belongs to the collider.
void place(Solid& solid, const Pose& from, const Pose& to);

// [m] How far the fastest corner of the solid's box goes from `from` to `to`. A plane has a box of 1 m to each side of
// its origin.
double travelOf(const Solid& solid);

}  // namespace taut::collision
