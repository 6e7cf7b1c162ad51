// Broad phase: which points may touch which triangles in a block, and which edges which.
//
//     the tree of leaves         (bvh.h)         boxes of ways overlap
//       |
//     pairs of leaves                            boxes of their elements overlap (leaf_boxes.h)
//       |
//     candidate pairs            --->            narrow phase
//
// All boxes hold straight ways from x0 to x1. Elements of one leaf move nearly alike, so their boxes are those of their
// ways beside the leaf's mean way, and one side's boxes are drawn out by the difference of the two leaves' ways. A pair
// whose boxes are apart has an axis that separates it on the whole way, by more than nearShare of its thickness.
//
// Nothing is remembered from block to block. All pairs of leaves in reach are gone through anew in each block: with the
// vectors of the kernels that is faster than lists with margins, which cloth that swings uses up at once, and a
// restored world has nothing to catch up with.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/bvh.h"
#include "taut/contact/leaf_boxes.h"

namespace taut::contact {

// A point and a triangle, or two edges, that may come into contact.
struct CandidatePair {
    int a, b;                   // point and triangle; or edges, the lower first
    std::array<int, 4> points;  // the point and the triangle's corners; or the ends of both edges
};

class BroadPhase {
  public:
    explicit BroadPhase(const Elements& elements);

    // Call it when points have jumped, or elements were removed.
    void refresh();

    // Finds the pairs of leaves that may come into reach on the way from x0 to x1 (points) [m] -> near().
    void find(std::span<const dvec3> x0, std::span<const dvec3> x1);
    // Likewise, but only pairs of which points have left the ways to `expected` by more than they may.
    void findAstray(std::span<const dvec3> expected, std::span<const dvec3> x0, std::span<const dvec3> x1);
    std::span<const LeafPair> near() const { return near_; }  // ascending
    double thickness(LeafPair pair) const {                   // [m] that their surfaces keep
        return elements_.surface(bvh_[lowOf(pair)].surface).thickness +
               elements_.surface(bvh_[highOf(pair)].surface).thickness;
    }
    // [m] No point of one leaf goes further from one of the other, on the ways that were searched.
    double motionBetween(LeafPair pair) const;
    // [m] By which the points of both leaves together may leave their expected ways. Pairs that are further apart than
    // they move, by more than that, need no certificate.
    double leeway(LeafPair pair) const;
    // Appends the candidates of a near pair, of points and triangles or of edges.
    void addPoints(LeafPair pair, BoxQuery& query, std::vector<CandidatePair>& candidates) const;
    void addEdges(LeafPair pair, BoxQuery& query, std::vector<CandidatePair>& candidates) const;

    Bvh& bvh() { return bvh_; }
    const Bvh& bvh() const { return bvh_; }
    std::uint64_t bytes() const { return near_.capacity() * sizeof(LeafPair); }

  private:
    void findBoxes(std::span<const dvec3> x0, std::span<const dvec3> x1);

    const Elements& elements_;
    Bvh bvh_;
    std::vector<LeafPair> near_;
    std::vector<LeafBoxes> boxes_;  // (leaves) of those in near pairs
    std::vector<char> hasBoxes_;    // (leaves) of the last fit
    std::vector<int> toBox_;        // leaves, scratch
    double shortest_ = 1e300;       // [m] edge of a surface that is not rigid
    std::vector<double> astray_;    // (leaves) [m] of the point that is furthest from where it was expected
};

}  // namespace taut::contact
