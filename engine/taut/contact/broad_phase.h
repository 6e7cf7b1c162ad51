// Broad phase: which points may touch which triangles in a block, and which edges which.
//
//     leaves of the tree                          (bvh.h: some fifteen triangles each)
//       |   fat boxes overlap                     valid while all leaves stay in their fat boxes
//     tracked pairs of leaves
//       |   the leaves have used up a budget      until then no look at their motion is needed
//     checked pairs
//       |   a candidate has used up its budgets   until then no distance is measured
//     lists that are due  --->  narrow phase      a list that has expired is made anew first
//
// All of it rests on one bound. The points of a leaf move by the mean way of the leaf, but for a deviation. So between
// two leaves no distance changes in a block by more than
//
//     relative motion = |way A - way B| + deviation A + deviation B
//
// The sum of these over blocks is `travelled`. `approached` bounds the same change as a net displacement: it does not
// grow when leaves swing to and fro. The smaller one counts. As with the skin of a Verlet list in molecular dynamics:
// - A list is made with a margin. It names all pairs closer than near (nearShare of their thickness) plus the margin.
//   While approached <= margin, any pair that is near is in the list. Then the list expires.
// - Each pair in it has the distance that was measured last, less near, as a budget. It is not near before the leaves
//   have used it up, and is not measured again until then.
// - Two leaves whose boxes are apart, or which a separating axis holds apart for this block, need no list. Neither do
//   leaves of a flat surface that is still nearly flat (bvh_flatness.cpp).
//
// So a list may have too many pairs, never too few. The narrow phase drops the extra pairs, by a test that depends on
// this block alone. Pairs come in the order of their leaves and elements. That is why the result of a block does
// not depend on when lists were made: after a restored state, or drop(), the same bits come out.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "taut/contact/bvh.h"
#include "taut/contact/leaf_boxes.h"

namespace taut::contact {

// A point and a triangle, or two edges, that may come into contact.
struct CandidatePair {
    int a, b;                   // point and triangle; or edges, the lower first
    std::array<int, 4> points;  // the point and the triangle's corners; or the ends of both edges
    double thickness;           // [m] distance that they keep
};

// A pair needs a certificate if its distance is below the relative motion of its leaves plus this share of its
// thickness. The share is for the motion that contact adds: see TrackedPair::freeShift.
inline constexpr double watchShare = 0.5;

class BroadPhase {
  public:
    explicit BroadPhase(const Elements& elements) : elements_(elements), bvh_(elements) {}

    // Forgets all lists. Call it when points have jumped, or elements were removed.
    void drop();

    // Finds the lists that are due on the way from x0 to x1 (points) [m].
    void find(std::span<const dvec3> x0, std::span<const dvec3> x1);
    // x1 of these points has changed since find(). Finds the lists that are due with the new x1, where points
    // were moved so far that it matters. Returns false if that is not enough: then all have to be found again.
    bool findAgain(std::span<const int> moved, std::span<const dvec3> x0, std::span<const dvec3> x1);
    // Ends the block. x1 of these points has changed since the last call.
    void finish(std::span<const int> moved, std::span<const dvec3> x0, std::span<const dvec3> x1);
    // Points moved from x0 to x1, and pairs on the way are not wanted.
    void advance(std::span<const dvec3> x0, std::span<const dvec3> x1);

    Bvh& bvh() { return bvh_; }

    // The candidates of two leaves.
    struct CandidateList {
        int a = 0, b = 0;  // leaves
        std::vector<CandidatePair> pairs;
        std::size_t pointPairs = 0;  // so many pairs of points and triangles come first, then pairs of edges
        // (pairs) [m] The pair is near only when travelled and approached have both reached these.
        std::vector<double> travelBudget, approachBudget;
        double leastTravelBudget = 0,
               leastApproachBudget = 0;  // [m] of all pairs: the list is due when both are reached
        double thickness = 0;            // [m] sum of the two surfaces' thicknesses
        double margin = -1;              // [m] the list expires when approached exceeds it
        std::vector<int> between;        // leaves at rest between a and b: see Bvh::leavesBetween()

        // Of this block.
        double relativeMotion = 0;  // [m] bound above
        double travelled = 0;       // [m] since the list was made, this block included: sum of relative motions
        double approached = 0;      // [m] likewise, net
        bool isExpired = false;     // has to be made anew
        bool isSeparated = false;   // expired, but a separating axis spares it in this block

        // When the list was made, and since.
        double travelledBefore = 0;                 // [m] travelled, without this block
        dvec3 offset{0.0};                          // [m] from centre to centre
        double deviationA = 0, deviationB = 0;      // [m] sums of the leaves' deviations until then
        double deformationA = 0, deformationB = 0;  // [m] of the leaves from their reference shapes
        int referenceA = -1, referenceB = -1;       // numbers of these reference shapes
    };
    // Lists to be measured in this block, in the order of the leaves.
    std::size_t dueCount() const { return due_.size(); }
    CandidateList& due(std::size_t i) { return *due_[i]; }

    std::size_t listsMade() const { return listsMade_; }
    std::uint64_t bytes() const;

  private:
    // Two leaves whose fat boxes overlap.
    struct TrackedPair {
        LeafPair pair;
        CandidateList* list;
        // [m] The pair is not checked until the travel of its leaves has grown from budgetStart by motionBudget.
        double motionBudget = -1, budgetStart = 0;
        double countedTravel = 0;  // [m] travel of its leaves that list->travelledBefore includes
        // [m] Contact may move the points of both leaves by this sum without need to look again: what find() left out
        // is further apart than it moves, by watchShare of the least thickness.
        double freeShift = 0;
        bool isChecked = false;  // in this block
    };

    // Steps of find().
    bool areInFatBoxes(std::span<const dvec3> x0, std::span<const dvec3> x1);
    void searchTree(double boxMargin);
    template <class MayHaveMoved>
    void selectForCheck(const MayHaveMoved& mayHaveMoved);
    void checkSelected(std::span<const dvec3> x0, std::span<const dvec3> x1);
    bool mayUseUpBudget(const TrackedPair& tracked) const;
    void check(TrackedPair& tracked, std::span<const dvec3> x0, std::span<const dvec3> x1) const;
    void selectDue();
    void findBoxes(std::span<const dvec3> x0);  // candidate_list.cpp
    void refreshDue(std::span<const dvec3> x0);

    double relativeMotionOf(const CandidateList& list) const;
    void measureMotion(CandidateList& list) const;
    bool isSeparatedOnTheWay(const CandidateList& list, std::span<const dvec3> x0, std::span<const dvec3> x1) const;
    CandidateList* newList(LeafPair pair);
    static void clear(CandidateList& list);
    void restart(CandidateList& list, double margin) const;
    void makeList(CandidateList& list, std::span<const dvec3> x0) const;  // candidate_list.cpp
    double travelOf(LeafPair pair) const;
    double freeShiftOf(LeafPair pair) const;
    void accumulateTravel();
    void forgetChecked();

    const Elements& elements_;
    Bvh bvh_;
    std::deque<CandidateList> lists_;            // in no order
    std::vector<CandidateList*> unused_;         // of lists_
    std::vector<TrackedPair> tracked_, merged_;  // ascending; scratch
    std::vector<TrackedPair*> checked_;          // in this block
    std::vector<TrackedPair*> selected_;         // to be checked
    std::vector<CandidateList*> due_;
    std::vector<FloatBox> pointBoxes_;     // (points) at x0; empty where none was needed in this block
    std::vector<LeafBoxes> boxes_;         // (leaves) at x0
    std::vector<char> hasBoxes_;           // (leaves) in this block
    std::vector<double> deviation_;        // (leaves) [m] sum over all blocks
    std::vector<double> travel_;           // (leaves) [m] sum over all blocks of the furthest way of a point
    std::vector<core::Aabb> fatBoxes_;     // (leaves) of the last search of the tree
    std::vector<double> travelAtSearch_;   // (leaves) [m]
    double freeTravel_ = 0;                // [m] a leaf that went less since the search is in its fat box
    std::vector<dvec3> xFound_;            // (points) [m] the x1 of find()
    std::vector<double> shift_;            // (leaves) [m] largest distance of a point from there
    double mostDeformed_ = 0;              // [m] a leaf that has deformed further takes a new reference shape
    std::vector<int> between_, leafList_;  // leaves, scratch
    std::vector<LeafPair> found_;
    std::size_t listsMade_ = 0;
};

}  // namespace taut::contact
