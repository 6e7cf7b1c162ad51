// Bounding volume hierarchy over all surfaces: leaves of some fifteen triangles (or edges, where there are no
// triangles), and a binary tree of boxes over them. It says which leaves come close in a block, and how each leaf
// moves.
//
// The tree is built once, from the surfaces at rest. It never depends on where points are, so a restored world has the
// same tree. Boxes are refitted; the tree is searched only when leaves left their fat boxes (broad_phase.h).
//
// Leaf motion. Points of a leaf move nearly alike. The motion is stored as the mean way of its points and the largest
// deviation from it, so that two leaves need one subtraction to bound how distances between them change.
//
// Flatness certificate. A sheet's neighbouring leaves always overlap in space. They would fill the broad phase, though
// a sheet that is nearly flat cannot touch itself. Let the sheet be flat and convex at rest, F the deformation gradient
// of its triangles and R one rotation. For two places p, q at rest, integrate along the straight line between them,
// unit t:
//
//     |f(p) - f(q)|  >=  R t · (f(p) - f(q))  =  ∫ t·RᵀF t ds  >=  least |p - q|         least = min t·RᵀF t over F, t
//
// (the line stays inside, since the sheet is convex). So no two places come closer than `least` times their distance at
// rest. If that is no less than what is asked of parts of one body, no pair of these leaves touches. It is tested at x0
// and at x1; F is linear in time on straight ways, so the bound holds in between.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "taut/contact/elements.h"
#include "taut/contact/flatness_kernel.h"
#include "taut/core/aabb.h"

namespace taut::contact {

inline constexpr std::size_t leafSize = 36;  // triangles, or edges, at most

using Axes = std::array<dvec3, 3>;

struct BvhLeaf {
    int surface = 0;
    // Each element belongs to one leaf; an edge or a point to the first leaf that has it.
    std::vector<int> triangles, edges, points;
    std::vector<int> corners;  // all points of these elements, shared ones too
};

// How a leaf moves in a block.
struct LeafMotion {
    core::Aabb before, box;  // of its points at x0; at x0 and x1
    dvec3 centre{0.0};       // [m] mean of its points at x0
    dvec3 way{0.0};          // [m] mean of their ways
    double deviation = 0.0;  // [m] largest difference of a point's way from that mean
    // [m] Largest difference of a point from the reference shape, both relative to the centre, at x0 and x1. The
    // reference shape is the leaf at some block before; it is taken anew when the leaf has deformed too much.
    double deformation = 0.0;
    int reference = 0;  // number of the reference shape
};

// Bounds over the triangles of a flat leaf, at x0 and at x1; F the deformation gradient, R its mean made a rotation.
struct Flatness {
    dvec3 right{0.0}, up{0.0}, normal{0.0};  // columns of R
    double least = -1.0;                     // t·RᵀF t is no less for any unit t in the plane
    double most = 0.0;                       // |F t| is no more
};

// Two leaves in one number, the lower one in the high bits: sorted by the lower leaf, then by the higher.
using LeafPair = std::uint64_t;
inline LeafPair leafPair(int a, int b) {
    const auto low = static_cast<LeafPair>(a < b ? a : b), high = static_cast<LeafPair>(a < b ? b : a);
    return low << 32U | high;
}
inline int lowOf(LeafPair pair) {
    return static_cast<int>(pair >> 32U);
}
inline int highOf(LeafPair pair) {
    return static_cast<int>(pair & 0xffffffffU);
}

class Bvh {
  public:
    explicit Bvh(const Elements& elements);

    int count() const { return static_cast<int>(leaves_.size()); }
    const BvhLeaf& operator[](int i) const { return leaves_[static_cast<std::size_t>(i)]; }

    // Takes over the balls of the elements. Call it when they have changed.
    void takeBalls();
    // Surfaces that stand still may have moved in between: their leaves are followed once more.
    void forgetStill() { std::fill(isStillFollowed_.begin(), isStillFollowed_.end(), 0); }

    // A block from x0 to x1 (points) [m] begins. Finds travel() of all leaves, and nothing else.
    void start(std::span<const dvec3> x0, std::span<const dvec3> x1);
    double travel(int leaf) const { return travel_[static_cast<std::size_t>(leaf)]; }  // [m] furthest way of a point
    // Finds the motion of these leaves, unless it was found in this block already. A leaf that has deformed more than
    // mostDeformed [m] takes a new reference shape; 0: none does.
    void follow(std::span<const int> leaves, std::span<const dvec3> x0, std::span<const dvec3> x1, double mostDeformed);
    void followAll(std::span<const dvec3> x0, std::span<const dvec3> x1, double mostDeformed = 0.0);
    // How far these points are from `from` -> shifts (leaves) [m], where they are further than that.
    void addShifts(std::span<const int> points, std::span<const dvec3> from, std::span<const dvec3> to,
                   std::span<double> shifts) const;
    bool isFollowed(int leaf) const { return isFollowed_[static_cast<std::size_t>(leaf)] != 0; }
    const LeafMotion& motion(int leaf) const { return motions_[static_cast<std::size_t>(leaf)]; }  // if it is followed
    // x1 of these points has changed in this block. Recomputes the motion of the leaves that contain them.
    void correct(std::span<const int> points, std::span<const dvec3> x0, std::span<const dvec3> x1);

    // Pairs a <= b of leaves that may touch, and whose boxes (leaves) are closer than near plus `more` [m]; ascending.
    void findNear(std::span<const core::Aabb> boxes, double more, std::vector<LeafPair>& pairs);

    // The flatness certificate of leaves of one surface: `least` above; negative where there is none. Expects that they
    // were measured in this block.
    double flatness(std::span<const int> leaves) const;
    void measureFlatness(std::span<const int> leaves, std::span<const dvec3> x0, std::span<const dvec3> x1);
    // The least flatness at which parts of a surface are not in contact.
    double requiredFlatness(int surface) const { return requiredFlatness_[static_cast<std::size_t>(surface)]; }
    bool isPlane(int surface) const { return planes_[static_cast<std::size_t>(surface)].has_value(); }
    // [m] Smallest altitude of a triangle at rest: elements of the surface that share no point are no closer at rest.
    double leastAltitude(int surface) const { return altitudes_[static_cast<std::size_t>(surface)]; }
    // The leaves that every straight line at rest between leaves a and b stays in: all that overlap the box of both.
    // Empty where they have no common plane, or there are too many.
    std::vector<int> leavesBetween(int a, int b) const;

  private:
    struct Node {
        int left = -1, right = -1;  // nodes
        int leaf = -1;              // -1: has children
        int surface = -1;           // -1: several
        double thickness = 0;       // [m] largest in it
    };
    // The plane of a surface that is flat and convex at rest.
    struct Plane {
        dvec3 right, up;
    };
    using Rest2 = glm::dvec2;
    struct RestBox {
        Rest2 low{1e300}, high{-1e300};
        bool overlaps(const RestBox& other) const {
            return low.x <= other.high.x && low.y <= other.high.y && other.low.x <= high.x && other.low.y <= high.y;
        }
        RestBox joined(const RestBox& other) const { return {glm::min(low, other.low), glm::max(high, other.high)}; }
    };

    int addTree(std::vector<int> items, const std::vector<dvec3>& centres, int surface, const Axes& axes,
                bool areTriangles);
    int addLeaf(const std::vector<int>& items, int surface, bool areTriangles);
    int joinRoots(std::span<const int> roots);
    void shareOut();
    void takeReference(std::size_t leaf, std::span<const dvec3> x);
    void findTravel(std::size_t leaf);
    void findWay(std::size_t leaf, std::span<const dvec3> x0, std::span<const dvec3> x1);
    void findPlane(int surface, const dvec3& along);
    void prepareFlatness();
    void measureOne(std::size_t leaf, std::span<const dvec3> x0, std::span<const dvec3> x1);
    GradientRows gradientsOf(std::size_t leaf) const;
    RestBox restBoxOf(int leaf) const;
    void findLeavesIn(const RestBox& box, int node, std::vector<int>& leaves) const;
    void findPairsWithin(int node, double more, std::vector<LeafPair>& pairs) const;
    void findPairsBetween(int a, int b, double more, std::vector<LeafPair>& pairs) const;

    const Elements& elements_;
    std::vector<BvhLeaf> leaves_;
    std::vector<int> all_;  // 0, 1, 2, … (leaves)
    std::vector<int> leafOfPoint_, leafOfEdge_;
    std::vector<int> leavesAt_;         // leaves that a point is a corner of, point by point
    std::vector<std::size_t> firstAt_;  // (points + 1) in leavesAt_
    std::vector<char> isCorrected_;     // (leaves) scratch
    std::vector<int> toFollow_;         // leaves, scratch
    std::vector<Node> nodes_;           // children before parents
    int root_ = -1;
    std::vector<double> ways_;                 // (points) [m²] of the block, squared
    std::vector<double> travel_;               // (leaves) [m]
    std::vector<char> isFollowed_;             // (leaves) in this block
    std::vector<LeafMotion> motions_;          // (leaves)
    std::vector<dvec3> referenceShape_;        // [m] corners of all leaves, from the centre
    std::vector<std::size_t> firstReference_;  // (leaves) in referenceShape_
    std::vector<int> references_;              // (leaves) reference shapes so far
    std::vector<core::Aabb> boxes_;            // (nodes) scratch
    std::vector<char> isStillFollowed_;        // (leaves) of surfaces that stand still: the motion is known for good

    // Flatness.
    std::vector<std::optional<Plane>> planes_;  // (surfaces)
    std::vector<double> altitudes_;             // (surfaces) [m] see leastAltitude()
    std::vector<double> requiredFlatness_;      // (surfaces)
    std::vector<RestBox> restBoxes_;            // (nodes) of triangles in planes
    std::vector<int> planeRoots_;               // (surfaces) node of all triangles; -1: it has none
    std::vector<Flatness> flatness_;            // (leaves)
    // Of the triangles of leaves in planes, leaf by leaf in rows: see EdgeRows, and GradientRows at x0 and then at x1.
    std::vector<double> inverses_, gradients_;
    std::vector<std::size_t> firstInPlanes_;  // (leaves + 1) number of such triangles in leaves before
    std::vector<char> isMeasured_;            // (leaves) in this block
    std::vector<int> toMeasure_;              // leaves, scratch
};

}  // namespace taut::contact
