// Surfaces that may touch: at instants a few milliseconds apart, what has been moved from x0 to x1 is kept from going
// through itself and others. It knows places and velocities of points, nothing of why they move; no stiffness and no
// memory is in it, so that it limits no step, and what comes out depends on the instant alone.
//
//   find near pairs -> locate -> press, push -> colliders again -> certify -> slide apart, zones
//
// After Bridson, Fedkiw and Anderson 2002 and Harmon et al. 2008, with speculative gaps instead of the roots of cubics.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "taut/contact/broad_phase.h"
#include "taut/contact/closest_kernel.h"
#include "taut/contact/crossings.h"
#include "taut/contact/solver.h"

namespace taut::contact {

struct ContactOptions {
    double friction = 0.3;  // Coulomb's μ between two surfaces, times the factors of both [-]
    SolverOptions solver{};
    // For tests of what each is for.
    bool certifies = true, slides = true, untangles = true;
};

// All arrays (points).
struct Instant {
    double h = 0;                            // [s] since the last instant
    std::span<const dvec3> x0;               // [m] at the last
    std::span<dvec3> x1;                     // [m] now
    std::span<dvec3> v;                      // [m/s] as their method stores them
    std::span<const double> inverseMass;     // [1/kg]; 0 of points that go their way whatever they meet
    std::span<const char> isSingle;          // whether x1 is kept in single precision; empty: none
    std::span<const KinematicContact> held;  // ascending by point
    // Points (ascending) of which x1 and v have changed: their owner takes them over, and may change both once more, by
    // rounding or where a collider is. May be empty.
    std::function<void(std::span<const int> points)> take;
};

// What an instant found.
struct InstantResult {
    std::vector<int> moved;     // points of which x1 or v has changed, ascending
    int active = 0;             // pairs with an impulse
    double deepest = 0;         // how far a pair would have gone beyond touching, over the distance it keeps
    std::vector<int> surfaces;  // of which points that may yield were pressed, ascending
    int sweeps = 0, slides = 0, zones = 0, uncertified = 0;
};

// What comes in a time, if all go on as they are.
struct Forecast {
    bool meets = false;         // something is or comes in contact
    double closing = 0.0;       // [m/s] of what does, at most
    double leastThickness = 0;  // [m] that it keeps, at least
    double stir = 0;  // [1/s] speed of points against their leaves, over a quarter of the distance kept, in the mean
    std::vector<int> surfaces;  // with points that may yield, of what does; ascending
};

// Two surfaces in contact, for pictures.
struct ContactPoint {
    dvec3 place, normal;  // [m] in the middle between both; towards the first
    double impulse;       // [N s] of the last instant
    int surfaceA, surfaceB;
};

class ContactGroup {
  public:
    // rest (points) [m].
    ContactGroup(std::vector<Surface> surfaces, std::vector<dvec3> rest, const ContactOptions& options);
    ContactGroup(const ContactGroup&) = delete;
    ContactGroup& operator=(const ContactGroup&) = delete;

    Elements& elements() { return elements_; }
    const Elements& elements() const { return elements_; }

    // Points have jumped, or something is gone: what was known of them is not true any more.
    void drop();
    // Points that went from `from` to `to` without contact, back where they were before some instants of this tick.
    void goBack(std::span<const dvec3> from, std::span<const dvec3> to);
    // Before the instants of a tick: looks for crossings if there may be any. Their pairs are not pressed until the
    // next tick, but led apart.
    void begin(std::span<const dvec3> x);
    Forecast forecast(std::span<const dvec3> x, std::span<const dvec3> v, std::span<const double> inverseMass,
                      double seconds);
    const InstantResult& resolve(const Instant& instant);

    const std::vector<Crossing>& crossings() const { return crossings_; }  // at the start of the tick
    // Of the last instant.
    std::vector<ContactPoint> contactPoints(std::span<const dvec3> x) const;
    std::vector<Crossing> crossingsAt(std::span<const dvec3> x);
    // Pairs that the last instant looked at, and those of them that came near enough to be pressed.
    std::size_t located() const { return contacts_.size(); }
    std::size_t near() const { return active_.size(); }
    std::size_t listed() const { return broadPhase_.listed(); }
    std::uint64_t bytes() const;

  private:
    void runNarrowPhase(std::span<const dvec3> x0, std::span<const dvec3> x1);
    struct Measured;
    struct NarrowPhaseScratch;
    void gather(BroadPhase::CandidateList& list, std::span<const dvec3> x0, const ClosestKernels& kernels,
                NarrowPhaseScratch& scratch) const;
    void classify(const Measured& measured, std::span<const dvec3> x0, std::span<const dvec3> x1,
                  const NarrowPhaseScratch& scratch, std::vector<ContactConstraint>& pairs) const;
    bool isFeatureNearest(const ContactConstraint& pair, int feature, std::span<const dvec3> x) const;
    double ridge(const Edge& edge, const dvec3& on, const dvec3& outward, std::span<const dvec3> x) const;
    bool isTangled(const ContactConstraint& pair) const;
    void press(const Instant& instant);
    void untangle(const Instant& instant);
    void certify(const Instant& instant);
    std::vector<const ContactConstraint*> uncertified(const Instant& instant) const;
    void handOver(const Instant& instant, std::span<const int> points);
    void findAgain(const Instant& instant, std::span<const int> moved);

    ContactOptions options_;
    Elements elements_;
    BroadPhase broadPhase_;
    std::vector<Crossing> crossings_;
    enum Mark : char { unmarked, anySide, wrongSide };
    std::vector<char> marks_;                            // (points) of crossings
    std::vector<ContactConstraint> contacts_;            // all that were located
    std::vector<ContactConstraint> active_;              // of them those that press
    std::vector<std::vector<ContactConstraint>> found_;  // (tasks) scratch
    ContactSolver solver_;
    std::vector<dvec3> u0_, u_, v_, shift_;  // (points)
    std::vector<dvec3> xIs_;                 // (points) [m] that near pairs were found for
    std::vector<int> moved_;
    InstantResult result_;
};

// The least distance between two of the surfaces of elements at places x [m]; infinite where one has nothing.
double distanceBetween(const Elements& elements, Bvh& leaves, std::span<const dvec3> x,
                       const std::function<bool(int surface)>& isFirst,
                       const std::function<bool(int surface)>& isSecond);

}  // namespace taut::contact
