// Colliders as surfaces of a ContactGroup, with which they move. Corners and edges of rigid ones catch elements
// that the points of bodies miss, such as a cloth over a corner between two of its points. A figure is stopped by
// nothing else: its faces, edges and corners move evenly from where they are at the start of a tick to where they are
// at its end. Knows no bodies.
#pragma once

#include <span>
#include <vector>

#include "taut/collision/convex.h"
#include "taut/collision/outline.h"
#include "taut/contact/elements.h"
#include "taut/drawing/collider_figure.h"
#include "taut/island/private/island.h"

namespace taut::world {

struct TouchedCollider {
    std::string name;
    std::vector<collision::Outline> outlines;        // corners and edges
    std::shared_ptr<const ColliderFigure> figure{};  // null: it is rigid
    collision::ConvexParts convex;
    collision::Material material;
    collision::Pose pose;  // at present
};

class ColliderSurfaces {
  public:
    ColliderSurfaces() = default;
    // Expects colliders in their order; seconds: the present time. Appends their surfaces and points (points) [m] to
    // those of a group.
    ColliderSurfaces(const std::vector<TouchedCollider>& colliders, double seconds,
                     std::vector<contact::ContactSurface>& surfaces, std::vector<dvec3>& rest);

    bool isEmpty() const { return colliders_.empty(); }
    bool hasFigures() const;
    const std::string& nameOf(int surface) const;  // of a collider
    std::vector<int> surfacesOf(const std::string& collider) const;
    // Starts a tick that ends at `end` [s], in which these colliders move, and figures besides. Sets the velocities of
    // their points (points) [m/s]. Returns whether a collider jumps; as in Colliders::move, it is then at the end of
    // its motion at once.
    bool move(std::span<const ColliderMotion> moving, double end, double tickSeconds, contact::Elements& elements,
              std::span<dvec3> v);
    // Sets the places (points) [m] of colliders that move or have just stopped, at a share of the tick.
    // placeAll: those of all, at its end.
    void place(double share, std::span<dvec3> x) const;
    void placeAll(std::span<dvec3> x) const;

  private:
    struct Collider {
        int collider;
        std::string name;
        std::shared_ptr<const ColliderFigure> figure;
        std::vector<dvec3> vertices;    // [m] with the collider at the origin
        int firstPoint;                 // of the group
        int firstSurface, lastSurface;  // of the group
        collision::Pose from, to;       // in this tick
        bool moves = false, hasMoved = false;  // in this tick, in the last
        std::vector<dvec3> xFrom, xTo;  // [m] vertices of a figure in this tick
    };
    static void setEnds(Collider& own, double end);
    std::vector<Collider> colliders_;
};

}  // namespace taut::world
