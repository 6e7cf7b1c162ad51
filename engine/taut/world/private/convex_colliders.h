// The convex shapes of colliders, and where they are in a block of a tick.
#pragma once

#include <span>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/collision/convex.h"
#include "taut/island/private/island.h"

namespace taut::world {

// A convex shape in a block.
struct ShapeInMotion {
    const collision::Convex* convex;
    int surface, collider;      // of a group's solid, or of a collider; the other is -1
    collision::Frame from, to;  // at both ends of the block
    double thickness;           // [m] that a solid keeps
    double travel;              // [m] of its fastest place
    core::Aabb box;             // [m] of the whole block, and as much again; of a half-space nothing
    bool isStill;
};
// Expects from and to; makes the rest.
ShapeInMotion inMotion(ShapeInMotion shape);

class ConvexColliders {
  public:
    void add(int number, const collision::ConvexParts& parts, const collision::Pose& pose);
    bool isEmpty() const { return colliders_.empty(); }
    bool isAllOf(int collider) const;  // it has no other shapes
    // Starts a tick in which these colliders move. One that jumps is at the end of its motion at once.
    void move(std::span<const ColliderMotion> moving, double tickSeconds);
    // Appends the shapes in a block from one share of the tick to another.
    void addTo(std::vector<ShapeInMotion>& shapes, double from, double to) const;

  private:
    struct Collider {
        int number;
        collision::ConvexParts parts;
        collision::Pose from, to;  // in this tick
    };
    std::vector<Collider> colliders_;
};

}  // namespace taut::world
