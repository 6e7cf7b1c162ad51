// Deformable bodies against convex shapes whose distance is a formula: points, edges and faces of theirs near solids,
// and near colliders the edges and faces, since islands, or entire bodies, bring out points only.
// Found at the start of a block, like the contacts of rigid shapes (rigid_contacts.h).
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "taut/collision/element_distance.h"
#include "taut/contact/elements.h"
#include "taut/world/private/convex_colliders.h"

namespace taut::world {

struct ElementTouch {
    int surface;                // of the body
    int solid, collider;        // a surface, or a collider; the other is -1
    int shape, element;         // numbers, for a name of the pair
    std::array<int, 3> points;  // of the group; of an edge the third is -1, of a point the second too
    std::array<double, 3> weights;
    dvec3 normal, place;  // unit, out of the shape; [m] of the element
    double gap, closing;  // [m] beyond the thickness; by which it shrinks in the block
    double speed;         // [m/s] of the element past the shape
    double thickness;     // [m] that element and shape keep between them
    dvec3 velocity;       // [m/s] of the shape there
    dvec3 spin;           // [rad/s] of the shape
};

// Touches in a block of `seconds` [s], in which points go from x0 to x1 (points) [m]. `mayTouch` says which
// surfaces, and which surface and collider, may.
class ElementContacts {
  public:
    using MayTouch = std::function<bool(int surface, int solid, int collider)>;
    std::span<const ElementTouch> find(const contact::Elements& elements, std::span<const dvec3> x0,
                                       std::span<const dvec3> x1, double seconds, std::span<const ShapeInMotion> shapes,
                                       const MayTouch& mayTouch);

  private:
    struct Query;
    bool measurePoints(const Query& query);
    void addPoints(const Query& query);
    void addEdges(const Query& query);
    void addFaces(const Query& query);
    static collision::ElementNear nearestOf(const Query& query, const std::array<int, 3>& points,
                                            const std::array<dvec3, 3>& x);
    void add(const Query& query, int element, const std::array<int, 3>& points, const collision::ElementNear& near);

    // Of one surface and one shape, (points).
    std::vector<dvec3> local_;              // [m] at the start of the block, in the axes of the shape
    std::vector<collision::Nearest> near_;  // to the shape
    std::vector<double> ways_;              // [m] how far they go
    std::vector<char> isNear_;              // an element of theirs may touch
    std::vector<ElementTouch> touches_;
};

}  // namespace taut::world
