// Corners and edges of colliders among the surfaces that touch: rigid ones, which go where the colliders go. It knows
// no bodies.
#pragma once

#include <span>
#include <vector>

#include "taut/collision/outline.h"
#include "taut/contact/elements.h"
#include "taut/island/island.h"

namespace taut::world {

// What of a collider bodies meet between their points, in the order of the colliders.
struct TouchedCollider {
    std::vector<collision::Outline> outlines;
    double friction = 0;   // Coulomb's μ [-]
    collision::Pose pose;  // now
};

class ColliderSurfaces {
  public:
    ColliderSurfaces() = default;
    // Appends their surfaces and points to those of a group (points) [m]; of what is round only what is thinner than
    // some cells of the surfaces that meet it.
    ColliderSurfaces(const std::vector<TouchedCollider>& colliders, std::vector<contact::Surface>& surfaces,
                     std::vector<dvec3>& rest);

    bool isEmpty() const { return rigids_.empty(); }
    // Their ways in a tick, and the velocities of their points in it (points) [m/s]. Returns whether any jumps: as in
    // Colliders::move it is at its end then.
    bool lead(std::span<const ColliderMotion> moving, double tickSeconds, contact::Elements& elements,
              std::span<dvec3> v);
    // Points (points) [m] of those that move, at a share of the tick; and of all, at its end.
    void place(double share, std::span<dvec3> x) const;
    void placeAll(std::span<dvec3> x) const;

  private:
    struct Rigid {
        int collider;
        std::vector<dvec3> vertices;    // [m] of the collider at the origin
        int firstPoint;                 // of the group
        int firstSurface, lastSurface;  // of the group
        collision::Pose from, to;       // in this tick
        bool moves = false;
    };
    std::vector<Rigid> rigids_;
};

}  // namespace taut::world
