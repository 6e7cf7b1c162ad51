// Contact solver: impulses λ [N s] that keep the active pairs apart, with Coulomb friction, cluster by cluster. Rows
// are made once for a block of steps, and swept in each of them, between forces and drift:
//
//     0 <= λ  ⊥  n·Σ w u + max(g, 0) / h >= 0        u  mean velocity of a point in the step, (x1 - x0) / h
//                                                    g  gap before the step, carried on along the normal of the row
//
// Complementarity: either the pair may still approach and has no impulse, or it pushes and uses up exactly its gap.
// That is the optimality condition of
//
//     E(λ) = ½ λᵀ A λ + λᵀ (W u0 + g⁺/h),  λ >= 0,       A = W M⁻¹ Wᵀ,  u = u0 + M⁻¹ Wᵀ λ
//
// Energy. Projected Gauss-Seidel visits one λ after the other and minimises E over it, so a sweep only lowers E. The
// kinetic energy is ½ u0ᵀMu0 + E(λ) - λᵀ g⁺/h, and the last term only lowers it. Under leap-frog u is what the
// integrator stores, and the impulses are one more force of the step's kick: nothing is pumped into springs, however
// stiff. For other methods the stored velocity is changed as u is.
//
// Deformable bodies need two sweeps per step, because each step starts from the impulses of the last one, also across
// ticks. This start may raise E for one step. Solids have no springs that absorb the rest, so they are swept until
// nothing changes. Several near rest are solved at once (rigid_step.h).
//
// Position correction. A pair that overlaps (g < 0) is moved apart by a share of the overlap in a block, as a shift of
// places, in equal parts in all its steps. The shift is no velocity, so it adds no energy of motion (split impulses, as
// in Bullet). In one part it would strain springs at once. Deformable bodies may overlap by a fifth of their thickness:
// a heap of towels that is moved until its layers barely touch never rests (2e-4 J in place of 2e-6 J). Corrections are
// soft, so two that contradict each other, as in a fold that is pressed flat, cancel out. Else they would stretch its
// springs in every block, for ever (2e-5 J).
//
// Clusters are sets of pairs that share movable points. They are solved in parallel, each in the order of its pairs:
// the bits do not depend on threads. Large clusters are coloured: rows of one colour share no velocity
// (gauss_seidel.h).
//
// Solids. Points of a rigid body have its two velocities, of the centre and the spin. An impulse acts where the sides
// meet, a thickness off the points, so that balls roll. Its points move with the body. Gaps through which one would
// fall from rest in a block count as closed, so that a pile rests on the same places in every block.
//
// Joints of solids are rows too, of all clusters that have contacts. The island has made the motion of the step such
// that joints hold, so their rows keep the speeds that they find. Without them a heavy load on the joints of a light
// solid would sink by g h M/m in each step.
//
// Carried points have no velocity of their own: rows know those of their movers, of which one may be in several places.
//
// A collider that holds a point is one more row, between the point and a velocity that nothing changes. So is each
// fixed point of a pair: it has a slot of its own, and passes nothing on.
//
// Driven surfaces may close upon a body from two sides, and nothing keeps both away. Their pairs are a little soft:
// they yield by a hundredth of the velocity that they take, which the position correction makes up for.
//
// A block starts from the contact forces of the previous one, as most contacts last longer than a block. Forces between
// deformable bodies are kept across ticks. Without them, each tick would begin with a small fall, and bodies at rest
// would sink by 2 um per tick. With them, two sheets on the ground come to rest to the last bit. Solids are swept until
// they settle, and start each tick without forces.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
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
    int sweeps = 2;          // of a step, at most; without solids
    double settled = 1e-5;   // sweeps end when they change less than this share of the thickness per step [-]
    double recovery = 0.1;   // share of an overlap that is corrected in a block [-]
    double restSpeed = 0.0;  // [m/s] slower rows do not bounce
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
    core::TurnFriction turnFriction{};
    dvec3 spin{0.0};  // [rad/s] of the collider
    int point() const { return points[0]; }
    std::span<const int> used() const { return std::span(points).first(points[2] >= 0 ? 3 : points[1] >= 0 ? 2 : 1); }
    // Calls each(point, weight).
    template <class Each>
    void forEachPoint(Each&& each) const {
        for (std::size_t k = 0; k < used().size(); ++k) each(points[k], weights[k]);
    }
};

// The force of a contact in the last step of a block.
struct KeptForce {
    std::uint64_t key = 0;   // of the contact
    Four force{}, torque{};  // [N], [N m] as Row::impulse and Roll::impulse
};

// A block of steps as it begins. Its spans have to last until it ends.
struct SolverBlock {
    std::span<const ContactConstraint> pairs;
    std::span<const KinematicContact> kinematic;  // ascending by point
    std::span<const double> inverseMass;          // (points) [1/kg]
    std::span<const dvec3> x;                     // (points) [m]
    double h = 0;                                 // [s] of a step
    int steps = 1;
    SolverOptions options{};
    double seconds() const { return steps * h; }
};

class ContactSolver {
  public:
    // Makes the rows of a block.
    void begin(const SolverBlock& block);
    // Changes u and v (points) [m/s] of a step that starts at x (points) [m] by the impulses. start (points) [m/s]: the
    // velocities at its start.
    void step(std::span<const dvec3> x, std::span<const dvec3> start, std::span<dvec3> u, std::span<dvec3> v);
    // shift (points) [m] gets the position correction of the block; expects 0.
    void findShift(std::span<dvec3> shift);
    void end();
    // Which points keep their distances. Keeps the span.
    void setSolids(std::span<const Solid> solids, std::size_t pointCount);
    // Which go with others. u, v and shift of these stay: their movers' change. Keeps a reference.
    void setCarried(const CarriedPoints& carried) { carried_ = &carried; }
    // Forces that the next block starts from, and those at the end of the last block. Starting begins a tick.
    void startFrom(std::span<const KeptForce> kept) {
        last_.assign(kept.begin(), kept.end());
        beginsTick_ = true;
    }
    std::span<const KeptForce> keptForces() const { return last_; }
    // Nothing presses.
    void clear() {
        impulses_.clear();
        frictions_.clear();
        areTold_ = true;
    }

    // After begin().
    std::span<const int> points() const { return touched_; }  // that pairs move, and of their solids, ascending
    int clusters() const { return static_cast<int>(clusters_.size()); }
    // After step().
    // (pairs, then contacts with colliders) [N s] along the normal, and tangential, on the first side or the point.
    std::span<const double> impulses() const {
        tellImpulses();
        return impulses_;
    }
    std::span<const dvec3> frictions() const {
        tellImpulses();
        return frictions_;
    }
    int countImpulses() const;  // of pairs, and of contacts of whole bodies with colliders
    bool hasBounced() const {
        return std::any_of(
            bounces_.begin(), bounces_.end(), [](double size) { return size > 0; });
    }

  private:
    // A solid in this block.
    struct Body {
        core::RigidMotion start, u, v;  // as the block began; in this step
        int slot;                       // of its velocity; then comes that of its spin
    };
    struct Cluster {
        std::size_t first, last;         // of rows_
        double tolerance;                // [m/s] smaller changes end the sweeps
        std::vector<RigidSlots> solids;  // ascending by slot
        RowPacks* packs = nullptr;       // of one without solids
        bool hasJoints = false;
    };
    const Solid* solidOf(int point) const;  // that moves; null: none
    bool isTouched(const Solid& solid) const;
    bool isFixed(int point) const;
    int leaderOf(int point) const;  // the lowest point of its solid, or itself
    void takeSolids();
    void load(std::span<const dvec3> x, std::span<const dvec3> u, std::span<const dvec3> v);
    void store(std::span<const dvec3> x, std::span<dvec3> u, std::span<dvec3> v);
    void addTerm(int point, double weight, const dvec3& place);
    void putTerms(Row& row);
    void weigh(Row& row) const;
    void addRoll(Row& row, const core::TurnFriction& friction, const dvec3& driven);
    void joinPoints();
    void findClusters();
    bool isLikePair(const Row& row) const;
    ContactConstraint::Kind kindOf(const Row& row) const;
    bool isJoint(const Row& row) const { return kindOf(row) != ContactConstraint::Kind::contact; }
    double closingOfJoint(const Row& row, std::span<const Four> velocities) const;
    void keepJoints();
    bool isNearRest(const Cluster& cluster) const;
    void colour(std::span<int> sources);
    void addRow(int source);
    int slotOf(int point);
    int addSlot();
    double gapNow(std::size_t row) const;
    double openGap(std::size_t row) const;
    bool areOfOneImpact(const Row& a, const Row& b) const;
    struct Bouncing {
        const Row* row;
        double restitution, gap;  // [-], [m]
        // [m/s] By which it closes faster than at the start of the step; 0 without springs. By which v closes faster
        // than u.
        double gained, drift;
        double closing;  // [m/s] now
        bool isRigid;
    };
    bool isRigid(const Row& row) const;
    void bounce(const Cluster& cluster);
    void bounceIn(std::span<Four> velocities, std::vector<Bouncing>& all, std::span<const Row> rows,
                  std::span<double> sizes, const std::function<double(const Bouncing&)>& target) const;
    void sweep(Cluster& cluster);
    void sweepSolids(const Cluster& cluster);
    void correctPositions(const Cluster& cluster);
    template <class Each>
    void forEachCluster(const Each& each);
    void tellImpulses() const;
    int root(int point);
    std::span<Row> rowsOf(const Cluster& cluster) {
        return {rows_.data() + cluster.first, cluster.last - cluster.first};
    }
    Levers levers() const { return {turns_, shares_, rolls_}; }

    SolverBlock block_;
    // A source is a pair, or after all pairs a contact with a collider.
    std::vector<Row> rows_;             // cluster by cluster, contacts with colliders after the pairs
    std::vector<std::uint64_t> keys_;   // (rows) the same for the same contact in every block
    std::vector<double> gaps_, bases_;  // (rows) [m] as the block began; [m/s] closing without them
    std::vector<Cluster> clusters_;
    std::deque<RowPacks> packs_;  // (clusters) they keep their memory from block to block
    std::vector<int> parent_;     // (points) union-find; -1: in no pair
    std::vector<int> touched_;    // points that move those of pairs, ascending
    std::vector<int> slots_;      // (points) of those touched that move
    std::vector<std::pair<int, int>> moving_,
        fixed_;                                  // slot and point, of what moves and is of no solid; that does not
    std::vector<std::pair<int, dvec3>> driven_;  // slot and velocity of colliders
    std::vector<Four> u_, v_, start_;            // (slots) [m/s]
    std::vector<Four> before_, gone_;            // (slots) u_ before sweeps; [m] since the block began
    std::span<const Solid> solids_;
    std::vector<int> solidAt_;  // (points) empty where there are none; -1: of none
    std::vector<Body> bodies_;  // (solids) of those that are touched
    CarriedPoints none_;
    const CarriedPoints* carried_ = &none_;
    std::vector<Turn> turns_;          // of all rows
    std::vector<Share> shares_;        // of all rows
    mutable std::vector<Roll> rolls_;  // of all rows; sweeps change their impulses
    // Movers and solids of the row that is being made.
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
    std::vector<KeptForce> last_;             // ascending by key
    bool beginsTick_ = true;
    bool anyBounces_ = false;
    std::vector<double> bounces_;  // (rows) [N s]
    // (pairs, contacts with colliders) Of the last step; found when somebody asks.
    mutable std::vector<double> impulses_;
    mutable std::vector<dvec3> frictions_;
    mutable bool areTold_ = true;
};

}  // namespace taut::contact
