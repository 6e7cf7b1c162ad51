// Bounding volume hierarchy over all surfaces: leaves of some thirty triangles (or edges, where there are no
// triangles), and a binary tree of boxes over them.
//
// The tree is built once, from the surfaces at rest. It never depends on where points are, so a restored world has the
// same tree. Its boxes are refitted to the straight ways of the points in a block.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "taut/contact/elements.h"
#include "taut/core/aabb.h"

namespace taut::contact {

inline constexpr std::size_t leafSize = 48;  // triangles, or edges, at most

using Axes = std::array<dvec3, 3>;

struct BvhLeaf {
    int surface = 0;
    // Each element belongs to one leaf; an edge or a point to the first leaf that has it.
    std::vector<int> triangles, edges, points;
    std::vector<int> corners;  // all points of these elements, shared ones too
};

// How a leaf moves in a block.
struct LeafMotion {
    core::Aabb box;        // of its points at x0 and x1
    dvec3 way{0.0};        // [m] mean of their ways
    double deviation = 0;  // [m] largest difference of a point's way from that
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

    // Takes over the balls of the elements, and fits leaves of surfaces that stand still once more. Call it when
    // elements have changed, or points have jumped.
    void refresh();

    // Finds the motion of all leaves on straight ways from x0 to x1 (points) [m].
    void fit(std::span<const dvec3> x0, std::span<const dvec3> x1);
    const LeafMotion& motion(int leaf) const { return motions_[static_cast<std::size_t>(leaf)]; }
    // Whether the last fit() computed the motion of the leaf. It skips leaves that stand still, and stood still before.
    bool isRefitted(int leaf) const { return isRefitted_[static_cast<std::size_t>(leaf)] != 0; }
    // Pairs a <= b of leaves that may meet, and whose boxes come within reach of each other; ascending.
    void findNear(std::vector<LeafPair>& pairs);

    // The leaves that the point is a corner of.
    std::span<const int> leavesAt(int point) const {
        const auto i = static_cast<std::size_t>(point);
        return {leavesAt_.data() + firstAt_[i], leavesAt_.data() + firstAt_[i + 1]};
    }

  private:
    struct Node {
        int left = -1, right = -1;  // nodes
        int leaf = -1;              // -1: has children
        int surface = -1;           // -1: several
        double thickness = 0;       // [m] largest in it
    };

    int addTree(std::vector<int> items, const std::vector<dvec3>& centres, int surface, const Axes& axes,
                bool areTriangles);
    int addLeaf(const std::vector<int>& items, int surface, bool areTriangles);
    int addNode(BvhLeaf leaf);
    int joinRoots(std::span<const int> roots);
    void findPairsWithin(int node, std::vector<LeafPair>& pairs) const;
    void findPairsBetween(int a, int b, std::vector<LeafPair>& pairs) const;

    const Elements& elements_;
    std::vector<BvhLeaf> leaves_;
    std::vector<int> leafOfPoint_, leafOfEdge_;
    std::vector<int> leavesAt_;         // point by point
    std::vector<std::size_t> firstAt_;  // (points + 1) in leavesAt_
    std::vector<Node> nodes_;           // children before parents
    int root_ = -1;
    std::vector<LeafMotion> motions_;          // (leaves)
    std::vector<core::Aabb> boxes_;            // (nodes) scratch
    std::vector<char> wasStill_, isRefitted_;  // (leaves) in the last fit()
};

}  // namespace taut::contact
