// Contact solver: impulses λ [N s] that keep the active pairs apart, with Coulomb friction, cluster by cluster.
//
//     0 <= λ  ⊥  n·Σ w u + max(g, 0) / h >= 0        u  mean velocity of a point in the instant, (x1 - x0) / h
//                                                    g  gap at x0: distance - thickness; h length of the instant
//
// Complementarity: either the pair may still approach and has no impulse, or it pushes and uses up exactly its gap.
// That is the optimality condition of
//
//     E(λ) = ½ λᵀ A λ + λᵀ (W u0 + g⁺/h),  λ >= 0,       A = W M⁻¹ Wᵀ,  u = u0 + M⁻¹ Wᵀ λ
//
// Energy. Projected Gauss-Seidel visits one λ after the other and minimises E over it, so E only descends from 0.
// The kinetic energy is ½ u0ᵀMu0 + E(λ) - λᵀ g⁺/h, and the last term only lowers it. So contact without restitution
// adds none, converged or not. Between sweeps gauss_seidel.h extrapolates, which may raise E; but a sweep is always
// last.
//
// Two velocity fields. u decides where points are, v is what the integrator stores: leap-frog has it half a step later,
// and the mean velocity of an accelerated point is not the one at its end. Impulses that are right for u would make v
// bounce, and the other way round. So u is solved first, for all pairs; then v by the same rule, for the pairs that
// got an impulse.
//
// Position correction. A pair that overlaps at x0 (g < 0) is moved apart by a share of the overlap, as a shift of
// places. The shift is no velocity, so it adds no energy of motion (split impulses, as in Bullet).
//
// Clusters are sets of pairs that share movable points. They are solved in parallel, each in the order of its pairs:
// the bits do not depend on threads. Large clusters are coloured: rows of one colour share no velocity
// (gauss_seidel.h).
//
// Solids. Points of a rigid body have its two velocities, of the centre and the spin. An impulse acts where the sides
// meet, a thickness off the points, so that balls roll. Its points get what the body got. Several near rest that some
// sweeps do not settle are solved all at once (rigid_step.h). Gaps through which one would fall from rest in an instant
// count as closed, so that a pile rests on the same places in every instant, with the same impulses.
//
// Carried points have no velocity of their own: rows know those of their movers, of which one may be in several places.
//
// A collider that holds a point is one more row, between the point and a velocity that nothing changes. So is each
// fixed point of a pair: it has a slot of its own, and passes nothing on.
//
// Driven surfaces may close upon a body from two sides, and nothing keeps both away. Their pairs are a little soft:
// they yield by a hundredth of the velocity that they take, which the position correction makes up for.
//
// The impulses of the last instant are where the next one starts, as most contacts last longer than an instant. They
// are forgotten as a tick begins, so that what outlives a tick is the state of the islands alone.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "taut/contact/carried_points.h"
#include "taut/contact/contact_constraint.h"
#include "taut/contact/gauss_seidel.h"
#include "taut/contact/rigid_step.h"
#include "taut/core/rigid_motion.h"

namespace taut::contact {

struct SolverOptions {
    int sweeps = 20;         // at most
    double settled = 1e-5;   // sweeps end when they change less than this share of the thickness per instant [-]
    double recovery = 0.2;   // share of an overlap that is corrected in an instant [-]
    double restSpeed = 0.0;  // [m/s] what closes slower does not bounce
};

// Points that keep their distances.
struct Solid {
    std::vector<int> points;     // ascending
    std::vector<double> masses;  // (points) [kg]; of a held one far more than of all others
    bool moves = true;           // else its points are as any that nothing moves
};

// A point in contact with a collider, or a place of an edge or a face. It does not go into the collider, and the
// impulses of pairs that press it there raise the limit of its friction.
struct KinematicContact {
    std::array<int, 3> points{-1, -1, -1};  // the first always; they are not alike
    std::array<double, 3> weights{1.0, 0.0, 0.0};
    dvec3 normal{0.0};      // unit, out of the collider
    double speed = 0.0;     // [m/s] of the collider's surface along the normal
    dvec3 carried{0.0};     // [m/s] velocity of the collider's surface
    double friction = 0.0;  // Coulomb's μ of point and surface [-]
    // The solver resolves it like a pair's: of a point of a solid, or a carried one.
    bool isWhole = false;
    double gap = 0.0;          // [m] at x0
    double thickness = 0.0;    // [m] of the point's surface
    dvec3 arm{0.0};            // [m] from the first point to where the impulse acts, at x0
    double restitution = 0.0;  // [-]
    int point() const { return points[0]; }
    std::span<const int> used() const { return std::span(points).first(points[2] >= 0 ? 3 : points[1] >= 0 ? 2 : 1); }
    // Calls each(point, weight).
    template <class Each>
    void forEachPoint(Each&& each) const {
        for (std::size_t k = 0; k < used().size(); ++k) each(points[k], weights[k]);
    }
};

class ContactSolver {
  public:
    // Changes u and v (points) [m/s] by the impulses. shift (points) [m] gets the position correction; expects 0. h
    // [s]: length of the instant. kinematic: ascending by point. x (points) [m]: at x0, needed where there are solids.
    void solve(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> kinematic,
               std::span<const double> inverseMass, double h, const SolverOptions& options, std::span<dvec3> u,
               std::span<dvec3> v, std::span<dvec3> shift, std::span<const dvec3> x = {});
    // Which points keep their distances. Keeps the span.
    void setSolids(std::span<const Solid> solids, std::size_t pointCount);
    // Which go with others. u, v and shift of these stay: their movers' change. Keeps a reference.
    void setCarried(const CarriedPoints& carried) { carried_ = &carried; }
    // The next instant does not follow on the last.
    void forget() { last_.clear(); }
    // Nothing presses.
    void clear() {
        impulses_.clear();
        frictions_.clear();
    }

    // After solve().
    std::span<const int> points() const { return touched_; }  // that pairs move, and of their solids, ascending
    // (pairs, then contacts with colliders) [N s] along the normal, and tangential, on the first side or the point.
    std::span<const double> impulses() const { return impulses_; }
    std::span<const dvec3> frictions() const { return frictions_; }
    int sweeps() const { return mostSweeps_; }  // of the cluster that took most
    int clusters() const { return static_cast<int>(clusters_.size()); }

  private:
    struct Problem {
        std::span<const ContactConstraint> pairs;
        std::span<const KinematicContact> kinematic;
        std::span<const double> inverseMass;
        double h;
        const SolverOptions& options;
        std::span<const dvec3> x;
        std::span<dvec3> u, v, shift;
    };
    // A solid in this instant.
    struct Body {
        core::RigidMotion u, v;
        int slot;  // of its velocity; then comes that of its spin
    };
    struct Cluster {
        std::size_t first, last;         // of rows_
        double tolerance;                // [m/s] smaller changes end the sweeps
        int sweeps;                      // at most
        std::vector<RigidSlots> solids;  // that are solved at once: several, near rest
    };
    struct LastImpulse {
        std::uint64_t key;
        Four impulse;
    };
    const Solid* solidOf(int point) const;  // that moves; null: none
    bool isTouched(const Solid& solid) const;
    bool isFixed(int point, const Problem& problem) const;
    int leaderOf(int point) const;  // the lowest point of its solid, or itself
    void loadSolids(const Problem& problem);
    void storeSolids(const Problem& problem);
    void addTerm(int point, double weight, const dvec3& place, const Problem& problem);
    void putTerms(Row& row);
    void weigh(Row& row) const;
    void joinPoints(const Problem& problem);
    void findClusters(const Problem& problem);
    static bool isLikePair(const Row& row, const Problem& problem);
    bool isNearRest(const Cluster& cluster, const Problem& problem) const;
    void colour(std::span<int> sources, const Problem& problem);
    void addRow(int source, const Problem& problem);
    int slotOf(int point, const Problem& problem);
    int addSlot(const dvec3& u, const dvec3& v);
    int solveCluster(const Cluster& cluster, const Problem& problem);
    bool areOfOneImpact(const Row& a, const Row& b) const;
    struct Bouncing {
        const Row* row;
        double restitution, gap;  // [-], [m]
        double drift;             // [m/s] by which v closes faster than u
        double closing;           // [m/s] now
    };
    void bounce(std::span<const Row> rows, const Problem& problem, std::span<double> sizes);
    void bounceIn(std::span<Four> velocities, std::vector<Bouncing>& all, std::span<const Row> rows,
                  const Problem& problem, std::span<double> sizes,
                  const std::function<double(const Bouncing&)>& target) const;
    int solveRows(std::span<Row> rows, const Cluster& cluster, double tolerance, std::span<Four> velocities) const;
    void solveStored(std::span<const Row> rows, const Cluster& cluster, const Problem& problem);
    void correctPositions(std::span<const Row> rows, const Cluster& cluster, const Problem& problem);
    void remember(std::size_t sourceCount);
    int root(int point);
    Levers levers() const { return {turns_, shares_}; }

    // A source is a pair, or after all pairs a contact with a collider.
    std::vector<Row> rows_;            // cluster by cluster, contacts with colliders after the pairs
    std::vector<std::uint64_t> keys_;  // (rows) the same for the same contact in every instant
    std::vector<Cluster> clusters_;
    std::vector<int> parent_;          // (points) union-find; -1: in no pair
    std::vector<int> touched_;         // points that move those of pairs, ascending
    std::vector<int> slots_;           // (points) of those touched that move
    std::vector<Four> u_, v_, shift_;  // (slots)
    std::span<const Solid> solids_;
    std::vector<int> solidAt_;  // (points) empty where there are none; -1: of none
    std::vector<Body> bodies_;  // (solids) of those that are touched
    CarriedPoints none_;
    const CarriedPoints* carried_ = &none_;
    std::vector<Turn> turns_;    // of rows
    std::vector<Share> shares_;  // likewise
    // Of the row that is being made: what moves its points, and its solids.
    struct Term {
        int slot;
        double weight, inverseMass;  // [-], [1/kg]
        const Body* body = nullptr;  // of a solid
    };
    struct SolidTerm {
        const Body* body = nullptr;
        double weight = 0;
        dvec3 arm{0.0};  // [m] sum of weight × (place of the impulse - centre)
    };
    std::vector<Term> terms_;
    std::vector<SolidTerm> solidTerms_;
    std::vector<std::pair<int, int>> order_;  // cluster, source
    std::vector<std::uint64_t> taken_;        // (slots) scratch: colours
    std::vector<LastImpulse> last_;           // ascending by key
    std::vector<double> bounces_;             // (rows) [N s]; empty: nothing bounces
    std::vector<double> impulses_;            // (pairs, contacts with colliders)
    std::vector<dvec3> frictions_;            // likewise
    int mostSweeps_ = 0;
};

}  // namespace taut::contact
