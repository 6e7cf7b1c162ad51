// Corners and edges of colliders as rigid surfaces of a ContactGroup; they move with the colliders. They catch what the
// points of bodies miss, such as a cloth over a corner between two of its points. Knows no bodies.
#pragma once

#include <span>
#include <vector>

#include "taut/collision/outline.h"
#include "taut/contact/elements.h"
#include "taut/island/private/island.h"

namespace taut::world {

// Corners and edges of one collider.
struct TouchedCollider {
    std::vector<collision::Outline> outlines;
    double friction = 0;   // Coulomb's μ [-]
    collision::Pose pose;  // at present
};

class ColliderSurfaces {
  public:
    ColliderSurfaces() = default;
    // Expects colliders in their order. Appends their surfaces and points (points) [m] to those of a group. A ball or a
    // capsule is included only if it is thin enough to slip through the cells of the touching surfaces.
    ColliderSurfaces(const std::vector<TouchedCollider>& colliders, std::vector<contact::ContactSurface>& surfaces,
                     std::vector<dvec3>& rest);

    bool isEmpty() const { return colliders_.empty(); }
    // Starts a tick in which these colliders move. Sets the velocities of their points (points) [m/s]. Returns whether
    // a collider jumps; as in Colliders::move, it is then at the end of its motion at once.
    bool move(std::span<const ColliderMotion> moving, double tickSeconds, contact::Elements& elements,
              std::span<dvec3> v);
    // Sets the places (points) [m] of moving colliders at a share of the tick; at its end those of all colliders.
    void place(double share, std::span<dvec3> x) const;
    void placeAll(std::span<dvec3> x) const;

  private:
    struct Collider {
        int collider;
        std::vector<dvec3> vertices;    // [m] with the collider at the origin
        int firstPoint;                 // of the group
        int firstSurface, lastSurface;  // of the group
        collision::Pose from, to;       // in this tick
        bool moves = false;
    };
    std::vector<Collider> colliders_;
};

}  // namespace taut::world
