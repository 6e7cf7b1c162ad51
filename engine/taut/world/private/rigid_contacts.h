// The places where convex solids touch, or nearly touch, each other and convex colliders in a block.
//
//     swept boxes, sorted along an axis  -->  pairs  -->  collision::manifoldOf() of each  -->  touches
//
// A touch is measured at the start of the block, so that its gap is speculative (contact_group.h). Where two shapes
// that are apart meet within the block, the normal is that of the moment when they do: balls that meet aslant fly
// apart as they lie then. All of it is a function of the poses at both ends of the block.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "taut/bodies/private/rigid_marks.h"
#include "taut/world/private/convex_colliders.h"

namespace taut::world {

// One place of two shapes.
struct RigidTouch {
    int surface;              // of the group, of the first shape
    int other;                // the same of the second shape; -1: a collider's
    int collider;             // else -1
    int first, second;        // numbers of the shapes, for a name of the pair
    int number;               // among the places of the pair
    dvec3 normal;             // unit, towards the first
    dvec3 onFirst, onSecond;  // [m] where they press each other, at the start of the block
    double gap, thickness;    // [m] then; sum of the two
    dvec3 velocity;           // [m/s] of the collider's surface there
    dvec3 spin;               // [rad/s] of the collider
};

class RigidContacts {
  public:
    // A shape of a solid that is a surface of a group.
    struct Solid {
        int surface;
        collision::PlacedConvex piece;
        RigidMarks marks;  // points of the group
        double thickness;  // [m]
    };
    void addSolid(const Solid& solid) { solids_.push_back(solid); }
    bool isEmpty() const { return solids_.empty(); }

    // Touches in a block of `seconds` [s], of solids whose points go from x0 to x1 (points) [m], with each other and
    // with shapes of colliders. `mayTouch` says which surfaces, and which surface and collider, may.
    using MayTouch = std::function<bool(int surface, int other, int collider)>;
    std::span<const RigidTouch> find(std::span<const dvec3> x0, std::span<const dvec3> x1, double seconds,
                                     std::span<const ShapeInMotion> colliders, const MayTouch& mayTouch);

    // Of the last find(): of solids, in their order, then of colliders.
    std::span<const ShapeInMotion> shapes() const { return shapes_; }

  private:
    void takeShapes(std::span<const dvec3> x0, std::span<const dvec3> x1, std::span<const ShapeInMotion> colliders);
    void findPairs(const MayTouch& mayTouch);
    void touch(const ShapeInMotion& a, const ShapeInMotion& b, double seconds, std::vector<RigidTouch>& touches) const;

    std::vector<Solid> solids_;
    std::vector<ShapeInMotion> shapes_;       // of solids, then of colliders
    std::vector<std::pair<int, int>> pairs_;  // of shapes, ascending
    struct Swept {
        core::Aabb box;
        int shape;
    };
    std::vector<Swept> swept_;  // scratch: boxes one after another, as the sweep reads them
    std::vector<std::vector<RigidTouch>> perTask_;
    std::vector<RigidTouch> touches_;
};

}  // namespace taut::world
