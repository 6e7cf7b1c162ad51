// A block of steps of contact: it keeps surfaces from going through themselves and each other while they move.
//
//     open()                                     step(), in each step                  close()
//     where points are, and where they may       impulses that let no row close        certificate for all pairs
//     come to: broad and narrow phase find       more than its gap, before the         that came into reach
//     the pairs that may meet --> rows           points have gone anywhere
//       |________________________________________|____|____|____|____|____|________________|
//                                  rows are frozen: pair, weights, normal
//
// Detection is expensive, and its pairs stay valid for several steps. Impulses are cheap, and springs need them in
// every step. So pairs are found once per block and solved in every step (solver.h).
//
// The group knows places, velocities and inverse masses of points. It does not know why the points move.
//
// No stiffness. A penalty spring k would limit the step of the islands by sqrt(m / k). Here the impulses solve a
// complementarity problem for the step alone, so contact limits no step. Gaps are speculative: two sides may approach
// by the rest of their gap in one step, and no root of a cubic is sought (compare Bridson, Fedkiw and Anderson 2002,
// which finds the time of impact).
//
// Memory. Each block starts from the contact forces of the previous one. begin() takes the forces for the first block
// of a tick, which are part of the state. Nothing else is remembered, so the result of a tick depends on its start
// alone, and a restored world goes on with the same bits.
//
// The certificate has the last word. Every pair in reach needs an axis that proves that it did not pass through itself
// in the block (certificate.h). Pairs without one are slid apart (Harmon et al. 2008), and after some rounds moved as
// impact zones (Provot 1997). Islands may change these places, so the pairs are tested again after every round.
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
    // Tests switch these off to show their effect.
    bool certifies = true, slides = true, untangles = true;
};

// A block as it begins. All arrays (points); they have to last until it is closed.
struct Block {
    double h = 0;  // [s] of a step
    int steps = 1;
    std::span<const dvec3> x0;                    // [m] at its start
    std::span<const dvec3> ahead;                 // [m] where they may come to in it
    std::span<const double> inverseMass;          // [1/kg]; 0: pinned or kinematic, contact does not move it
    std::span<const KinematicContact> kinematic;  // contacts of points with colliders, ascending by point
    std::span<const ContactConstraint> rigid{};   // pairs of convex solids, each with a point of both and a place
    double restSpeed = 0;                         // [m/s] slower pairs do not bounce
    double mostWay = 1e300;  // of the sides of a pair from one another, over its thickness: else the block is shorter
    // The group calls it with the points (ascending) whose x and v it has changed. Their island places them, and may
    // change both again: by rounding, or at a collider. May be empty.
    std::function<void(std::span<const int> points)> place;
};
// A step from x0 to x1 [m], with v [m/s] as the integrator of each island stores it (points).
struct Step {
    std::span<const dvec3> x0;
    std::span<dvec3> x1, v;
    std::span<const dvec3> before;  // [m/s] stored as the step began; only bounces need it
};

struct BlockResult {
    std::vector<int> moved;  // points of which x1 or v has changed in the last step or at the end, ascending
    int impulses = 0;  // pairs with an impulse, and contacts of whole bodies with colliders, in the step that has most
    int slides = 0;    // pairs slid apart, in all rounds
    int zones = 0;     // rounds in which pairs were moved as impact zones
    int uncertified = 0;  // pairs that have no certificate in the end
};

// A pair with an impulse, for pictures.
struct ContactPoint {
    dvec3 place, normal;  // [m] midpoint; unit, towards surface A
    double impulse;       // [N s] in the last step
    int surfaceA, surfaceB;
};

class ContactGroup {
  public:
    // rest (points) [m].
    ContactGroup(std::vector<ContactSurface> surfaces, std::vector<dvec3> rest, const ContactOptions& options);
    ContactGroup(const ContactGroup&) = delete;
    ContactGroup& operator=(const ContactGroup&) = delete;

    // Points that keep their distances, in the coming blocks.
    void setSolids(std::vector<Solid> solids);
    // Points that go with others. Their places and velocities have to do so; the group sees to that for those of which
    // it moved others. Points that move none of them have no inverse mass.
    void setCarried(CarriedPoints carried);
    const CarriedPoints& carried() const { return carried_; }

    Elements& elements() { return elements_; }
    const Elements& elements() const { return elements_; }

    // Call it when points have jumped, or elements were removed.
    void drop();
    // Call it before the tick is repeated: the points went back to x, without contact.
    void rewind(std::span<const dvec3> x, std::span<const KeptForce> kept = {});
    // Call it before the blocks of a tick. It finds the edges that pierce triangles; their pairs are untangled in
    // this tick, not solved. Where the last tick began without any and was certified, there are none while the points
    // are where it left them.
    void begin(std::span<const dvec3> x, std::span<const KeptForce> kept = {});
    // At the end of the last block, for begin().
    std::span<const KeptForce> keptForces() const { return solver_.keptForces(); }
    // A block, see above. A block without rows needs no step().
    // Returns the number of steps of the block, from one to the requested number.
    int open(const Block& block);
    bool hasRows() const;
    void step(const Step& step);
    bool hasBounced() const { return solver_.hasBounced(); }  // in the last step
    // The whole block, from its x0: gives all pairs a certificate. certify() does so again, where something else has
    // moved points since. Both return whether they moved any.
    bool close(std::span<dvec3> x, std::span<dvec3> v);
    bool certify(std::span<dvec3> x, std::span<dvec3> v);
    // After both.
    void finish(std::span<const dvec3> x);
    const BlockResult& result() const { return result_; }
    // How far the sides of a row go from one another or past in a step, at most, over their thickness; as it was
    // opened.
    double wayOfStep() const { return wayOfStep_; }

    const std::vector<Crossing>& crossings() const { return crossings_; }  // at the start of the tick
    std::vector<Crossing> crossingsAt(std::span<const dvec3> x);
    // Of the last step.
    std::vector<ContactPoint> contactPoints(std::span<const dvec3> x) const;
    // Calls each(pair, normal impulse, friction) of all pairs that pressed in the last step [N s].
    template <class Each>
    void forEachPressing(Each&& each) const {
        for (std::size_t p = 0; p < active_.size() && p < solver_.impulses().size(); ++p)
            if (solver_.impulses()[p] > 0) each(active_[p], solver_.impulses()[p], solver_.frictions()[p]);
    }
    // Likewise each(number of Block::kinematic, normal impulse, friction).
    template <class Each>
    void forEachOnCollider(Each&& each) const {
        for (std::size_t p = active_.size(); p < solver_.impulses().size(); ++p)
            if (solver_.impulses()[p] > 0) each(p - active_.size(), solver_.impulses()[p], solver_.frictions()[p]);
    }
    // Points that parts of driven surfaces closed upon in the last block, ascending; with them the rank that still
    // presses.
    const std::map<int, int>& squeezed() const { return squeezed_; }
    std::size_t testedCount() const { return tested_.size(); }  // pairs that needed a certificate
    std::size_t activeCount() const { return active_.size(); }  // pairs that went to the solver
    std::uint64_t bytes() const;

  private:
    // Each part passes its result to the next in the member that it names.
    void setExpected(double share);
    void detect();        // broad and narrow phase -> tested_
    void selectActive();  // tested_ -> active_
    int measureWays();
    void beginRows();                    // active_ -> rows of solver_
    void load(const Step& step);         // -> u0_, u_, start_
    void solveActive(const Step& step);  // -> u_, v_
    bool findSqueezed();                 // active_ -> squeezed_
    int rankOf(const ContactConstraint& pair) const;
    bool isLetThrough(const ContactConstraint& pair) const;
    void untangle();                                           // crossings_ -> u_, v_
    std::vector<int> applyVelocities(const Step& step) const;  // u_, v_ -> x1, v; the moved points
    std::vector<int> changeAsBodies(std::span<const dvec3> x, std::span<dvec3> a, std::span<dvec3> b,
                                    const std::function<void()>& change) const;
    std::vector<int> movedBy(std::span<const int> points) const;
    void handOver(const Step& step, std::span<const int> points);
    void detectAgain(std::span<const dvec3> x);  // pairs that points astray may have brought into reach -> tested_
    std::vector<const ContactConstraint*> uncertified(std::span<const dvec3> x) const;
    std::vector<int> separate(const Step& step, std::span<const ContactConstraint* const> pairs, int round);

    // narrow_phase.cpp
    struct Ways {
        std::span<const dvec3> x0, x1;  // (points) [m]
        bool mayPress;                  // pairs may become active
    };
    struct Measured;
    void runNarrowPhase(const Ways& ways);
    void measure(LeafPair leaves, std::span<const CandidatePair> candidates, bool isPoint, const Ways& ways,
                 const ClosestKernels& kernels, std::vector<ContactConstraint>& pairs) const;
    void classify(Measured& measured, const Ways& ways, std::vector<ContactConstraint>& pairs) const;
    static double motionOf(const Measured& measured, const Ways& ways);
    double openWay() const;
    static ContactConstraint constraintOf(const Measured& measured, std::span<const dvec3> x0);
    double convexity(const ContactConstraint& pair, std::int64_t where, std::span<const dvec3> x) const;
    bool meetInside(const CandidatePair& pair, bool isPoint, const std::array<double, 4>& weights,
                    std::int64_t where) const;
    bool isFeatureNearest(const ContactConstraint& pair, int feature, std::span<const dvec3> x) const;
    bool isTangled(const ContactConstraint& pair) const;
    static double slackOf(const ContactConstraint& pair, const dvec3& way, std::span<const dvec3> x1);

    ContactOptions options_;
    Elements elements_;
    BroadPhase broadPhase_;
    std::vector<Crossing> crossings_;
    // They spare a search, and change no result: see begin().
    bool isCertified_ = false;       // since begin(), which found no crossings
    std::vector<dvec3> xCertified_;  // (points) [m] at the end of the last block
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
    Block block_;
    // (points) [m/s] mean velocity in the step before and after the solver; [m/s] velocity at its start; [m/s] stored
    // velocity after it; [m] position correction. Set where active pairs or crossings have points.
    std::vector<dvec3> u0_, u_, start_, v_, shift_;
    std::vector<int> moved_;       // points that were handed over in this step
    std::vector<dvec3> expected_;  // (points) [m] at the end of the block; before, twice as far ahead
    double wayOfStep_ = 0;
    BlockResult result_;
};

// The least distance [m] at places x (points) [m] between surfaces of two kinds; infinite where one kind has none.
double distanceBetween(const Elements& elements, Bvh& leaves, std::span<const dvec3> x,
                       const std::function<bool(int surface)>& isFirst,
                       const std::function<bool(int surface)>& isSecond);

}  // namespace taut::contact
