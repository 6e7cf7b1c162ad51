// One instant of contact: it keeps surfaces that were moved from x0 to x1 from going through themselves and each other.
//
//     x0, x1, v                                                                                   x1, v, impulses
//       |                                                                                               ^
//   broad phase ---> narrow phase ---> active constraints ---> solver ---> untangle ---> islands        |
//   pairs of         distance,         those that would        impulses,   crossings     place their    |
//   elements in      normal, gap       close their gap         friction,   are pulled    points         |
//   reach            of each pair      in this instant         positions   apart           |            |
//                        ^                                                                 v            |
//                        |                        slide apart,              no       certificate   yes  |
//                        +----------------------- impact zones, islands <----------- for all pairs? ----+
//
// The group knows places, velocities and inverse masses of points. It does not know why the points move.
//
// No stiffness. A penalty spring k would limit the step of the islands by sqrt(m / k). Here the impulses solve a
// complementarity problem for the instant alone, so contact limits no step. The gap at x0 is speculative: two sides may
// approach by it in one instant, and no root of a cubic is sought (compare Bridson, Fedkiw and Anderson 2002, which
// finds the time of impact).
//
// No memory beyond a tick. The solver starts from the impulses of the last instant of the same tick, and a tick's first
// instant from 0: begin() and rewind() forget them. The broad phase keeps lists from instant to instant, but a list
// only says what to measure, and never leaves out what matters (broad_phase.h). So the result of a tick depends on its
// start alone. A restored world that has no lists yet goes on with the same bits.
//
// The certificate has the last word. Every pair in reach needs an axis that proves that it did not pass through itself
// (certificate.h). Pairs without one are slid apart (Harmon et al. 2008), and after some rounds moved as impact zones
// (Provot 1997). Islands may change what they are handed, so the pairs are tested again after every round.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "taut/contact/broad_phase.h"
#include "taut/contact/closest_kernel.h"
#include "taut/contact/crossings.h"
#include "taut/contact/solver.h"

namespace taut::contact {

struct ContactOptions {
    double friction = 0.3;     // Coulomb's μ between two surfaces, times the factors of both [-]
    double restitution = 0.0;  // likewise
    SolverOptions solver{};
    // Tests switch these off to show what each is for.
    bool certifies = true, slides = true, untangles = true;
};

// All arrays (points).
struct Instant {
    double h = 0;                                 // [s] since the last instant
    std::span<const dvec3> x0;                    // [m] at the last instant
    std::span<dvec3> x1;                          // [m] now
    std::span<dvec3> v;                           // [m/s] as the integrator of each island stores them
    std::span<const double> inverseMass;          // [1/kg]; 0: pinned or kinematic, contact does not move it
    std::span<const KinematicContact> kinematic;  // contacts of points with colliders, ascending by point
    std::span<const ContactConstraint> rigid{};   // pairs of convex solids, each with a point of both and a place
    double deepestTouch = 0;                      // largest penetration of shapes, as InstantResult::deepest
    double restSpeed = 0;                         // [m/s] what closes more slowly does not bounce
    // The group calls it with the points (ascending) whose x1 and v it has changed. Their island places them, and may
    // change both again: by rounding, or at a collider. May be empty.
    std::function<void(std::span<const int> points)> place;
};

struct InstantResult {
    std::vector<int> moved;     // points of which x1 or v has changed, ascending
    int impulses = 0;           // pairs with an impulse, and contacts of whole bodies with colliders
    double deepest = 0;         // largest penetration that the motion alone would have led to, over the thickness [-]
    std::vector<int> surfaces;  // that have a movable point in one of these, ascending
    int sweeps = 0;             // of the solver, in the cluster that took most
    int slides = 0;             // pairs slid apart, in all rounds
    int zones = 0;              // rounds in which pairs were moved as impact zones
    int uncertified = 0;        // pairs that have no certificate in the end
};

// What happens if all points fly on straight.
struct Forecast {
    bool isInContact = false;    // a pair is active, or surfaces cross already
    double closing = 0.0;        // [m/s] largest closing speed of an active pair
    double leastThickness = 0;   // [m] smallest thickness of an active pair
    double deformationRate = 0;  // [1/s] mean over the leaves: speed of points against their leaf, over thickness / 2
    std::vector<int> surfaces;   // that have a movable point in an active pair, ascending
};

// A pair with an impulse, for pictures.
struct ContactPoint {
    dvec3 place, normal;  // [m] midpoint; unit, towards surface A
    double impulse;       // [N s] in the last instant
    int surfaceA, surfaceB;
};

class ContactGroup {
  public:
    // rest (points) [m].
    ContactGroup(std::vector<ContactSurface> surfaces, std::vector<dvec3> rest, const ContactOptions& options);
    ContactGroup(const ContactGroup&) = delete;
    ContactGroup& operator=(const ContactGroup&) = delete;

    // Points that keep their distances, in the coming instants.
    void setSolids(std::vector<Solid> solids);
    // Points that go with others. Their places and velocities have to do so; resolve() sees to that for those of which
    // it moved others. What moves none of them has no inverse mass.
    void setCarried(CarriedPoints carried);
    const CarriedPoints& carried() const { return carried_; }

    Elements& elements() { return elements_; }
    const Elements& elements() const { return elements_; }

    // Forgets all lists. Call it when points have jumped, or elements were removed.
    void drop();
    // Call it before instants of the tick are repeated: the points went back from `from` to `to`, without contact.
    void rewind(std::span<const dvec3> from, std::span<const dvec3> to);
    // Call it before the instants of a tick. It finds the edges that pierce triangles; their pairs are untangled in
    // this tick, not solved. Where the last tick began without any and was certified, there are none while the points
    // are where it left them.
    void begin(std::span<const dvec3> x);
    // Expects that all points fly on at v for `seconds` [s].
    Forecast forecast(std::span<const dvec3> x, std::span<const dvec3> v, std::span<const double> inverseMass,
                      double seconds);
    // One instant, see above.
    const InstantResult& resolve(const Instant& instant);

    const std::vector<Crossing>& crossings() const { return crossings_; }  // at the start of the tick
    std::vector<Crossing> crossingsAt(std::span<const dvec3> x);
    // Of the last instant.
    std::vector<ContactPoint> contactPoints(std::span<const dvec3> x) const;
    // Calls each(pair, normal impulse, friction) of all pairs that pressed in the last instant [N s].
    template <class Each>
    void forEachPressing(Each&& each) const {
        for (std::size_t p = 0; p < active_.size() && p < solver_.impulses().size(); ++p)
            if (solver_.impulses()[p] > 0) each(active_[p], solver_.impulses()[p], solver_.frictions()[p]);
    }
    // Likewise each(number of Instant::kinematic, normal impulse, friction).
    template <class Each>
    void forEachOnCollider(Each&& each) const {
        for (std::size_t p = active_.size(); p < solver_.impulses().size(); ++p)
            if (solver_.impulses()[p] > 0) each(p - active_.size(), solver_.impulses()[p], solver_.frictions()[p]);
    }
    // Points that parts of driven surfaces closed upon in the last instant, ascending; with them what still presses.
    const std::map<int, int>& squeezed() const { return squeezed_; }
    std::size_t testedCount() const { return tested_.size(); }  // pairs that needed a certificate
    std::size_t activeCount() const { return active_.size(); }  // pairs that went to the solver
    std::size_t listsMade() const { return broadPhase_.listsMade(); }
    std::uint64_t bytes() const;

  private:
    // Steps of resolve(), in its order. What a step gives to the next is a member that it names.
    void detect(std::span<const dvec3> x0, std::span<const dvec3> x1);  // broad and narrow phase -> tested_
    void selectActive(const Instant& instant);                          // tested_ -> active_
    void solveActive(const Instant& instant);                           // active_ -> u_, v_, shift_
    bool findSqueezed(const Instant& instant);                          // active_ -> squeezed_
    int rankOf(const ContactConstraint& pair) const;
    bool isLetThrough(const ContactConstraint& pair) const;
    void untangle(const Instant& instant);                           // crossings_ -> u_, v_
    std::vector<int> applyVelocities(const Instant& instant) const;  // u_, v_, shift_ -> x1, v; the moved points
    std::vector<int> changeAsBodies(const Instant& instant, std::span<dvec3> a, std::span<dvec3> b,
                                    const std::function<void()>& change) const;
    std::vector<int> movedBy(std::span<const int> points) const;
    void handOver(const Instant& instant, std::span<const int> points);
    void detectAgain(const Instant& instant);  // pairs that pending_ may have brought into reach -> tested_
    std::vector<const ContactConstraint*> uncertified(const Instant& instant) const;
    std::vector<int> separate(const Instant& instant, std::span<const ContactConstraint* const> pairs, int round);

    // narrow_phase.cpp
    void runNarrowPhase(std::span<const dvec3> x0, std::span<const dvec3> x1, bool mayPress);
    struct Measured;
    struct NarrowPhaseScratch;
    void gather(BroadPhase::CandidateList& list, std::span<const dvec3> x0, const ClosestKernels& kernels,
                NarrowPhaseScratch& scratch) const;
    void classify(const Measured& measured, std::span<const dvec3> x0, std::span<const dvec3> x1,
                  const NarrowPhaseScratch& scratch, bool mayPress, std::vector<ContactConstraint>& pairs) const;
    ContactConstraint constraintOf(const Measured& measured, const NarrowPhaseScratch& scratch,
                                   std::span<const dvec3> x0) const;
    double convexity(const ContactConstraint& pair, std::int64_t where, std::span<const dvec3> x) const;
    bool meetInside(const ContactConstraint& pair, std::int64_t where) const;
    bool isFeatureNearest(const ContactConstraint& pair, int feature, std::span<const dvec3> x) const;
    bool isTangled(const ContactConstraint& pair) const;

    ContactOptions options_;
    Elements elements_;
    BroadPhase broadPhase_;
    std::vector<Crossing> crossings_;
    // They spare a search, and change no result: see begin().
    bool isCertified_ = false;       // since begin(), which found no crossings
    std::vector<dvec3> xCertified_;  // (points) [m] at the last instant
    enum Mark : char { unmarked, anySide, wrongSide };
    std::vector<char> marks_;                              // (points) of crossings_
    std::vector<ContactConstraint> tested_;                // pairs that need a certificate, in their order
    std::vector<ContactConstraint> found_, merged_;        // scratch
    std::vector<ContactConstraint> active_;                // pairs of tested_ that the solver gets
    std::vector<std::vector<ContactConstraint>> perTask_;  // (tasks) scratch
    std::vector<Solid> solids_;
    CarriedPoints carried_;
    ContactSolver solver_;
    struct Pressed {
        dvec3 sum{0.0};   // [N s] of impulses
        double size = 0;  // [N s] sum of their sizes
        bool yields = false;
        int lowest = 1 << 30, highest = -1;  // rank
    };
    std::vector<Pressed> pressed_;  // (points) scratch, as new between uses
    std::map<int, int> squeezed_;   // points; the rank of the driven surface that still presses, -1: none
    // (points) [m/s] mean velocity in the instant before and after the solver; [m/s] stored velocity after it; [m]
    // position correction. Set where active pairs or crossings have points.
    std::vector<dvec3> u0_, u_, v_, shift_;
    std::vector<dvec3> ahead_;          // (points) [m] of a forecast
    std::vector<int> moved_, pending_;  // points that were handed over in this instant; since tested_ was found
    InstantResult result_;
};

// The least distance [m] at places x (points) [m] between surfaces of two kinds; infinite where one kind has none.
double distanceBetween(const Elements& elements, Bvh& leaves, std::span<const dvec3> x,
                       const std::function<bool(int surface)>& isFirst,
                       const std::function<bool(int surface)>& isSecond);

}  // namespace taut::contact
