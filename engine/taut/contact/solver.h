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
// the bits do not depend on threads.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/gauss_seidel.h"

namespace taut::contact {

struct SolverOptions {
    int sweeps = 20;           // at most
    double recovery = 0.2;     // share of an overlap that is corrected in an instant [-]
    double restitution = 0.0;  // of pairs that close faster than restSpeed [-]
    double restSpeed = 0.0;    // [m/s]
};

class ContactSolver {
  public:
    // Changes u and v (points) [m/s] by the impulses. shift (points) [m] gets the position correction; expects 0. h
    // [s]: length of the instant. kinematic: ascending by point.
    void solve(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> kinematic,
               std::span<const double> inverseMass, double h, const SolverOptions& options, std::span<dvec3> u,
               std::span<dvec3> v, std::span<dvec3> shift);

    // After solve().
    std::span<const int> points() const { return touched_; }        // of the pairs, ascending
    std::span<const double> impulses() const { return impulses_; }  // (pairs) [N s] along the normal
    std::span<const dvec3> frictions() const { return frictions_; }  // (pairs) [N s] tangential, on the first side
    int sweeps() const { return mostSweeps_; }                      // of the cluster that took most
    int clusters() const { return static_cast<int>(clusterStart_.size()) - 1; }

  private:
    // A pair in the position correction.
    struct PositionRow {
        int pair;
        std::array<double, 4> gains;  // [1/kg] as of a row
        double mass;                  // [kg] likewise
        double target;                // [m] to be moved apart by at least
        double multiplier = 0;        // [kg m]
    };
    struct Cluster {
        std::span<Row> rows;
        std::span<KinematicRow> kinematicRows;
        double tolerance;  // [m/s] smaller changes end the sweeps
    };
    void findClusters(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> kinematic,
                      std::size_t pointCount, std::span<const double> inverseMass);
    void joinPoints(std::span<const ContactConstraint> pairs, std::size_t pointCount,
                    std::span<const double> inverseMass);
    void prepareRows(std::span<const ContactConstraint> pairs, std::span<const double> inverseMass, double h,
                     const SolverOptions& options, std::span<const dvec3> u);
    Cluster clusterAt(std::size_t number, std::span<const ContactConstraint> pairs, double h);
    int solveCluster(const Cluster& cluster, std::span<const ContactConstraint> pairs, double h,
                     const SolverOptions& options, std::span<dvec3> u, std::span<dvec3> v, std::span<dvec3> shift);
    void correctPositions(const Cluster& cluster, std::span<const ContactConstraint> pairs, double h,
                          const SolverOptions& options, std::span<dvec3> shift) const;
    int root(int point);

    std::vector<Row> rows_;                    // cluster by cluster, in the order of the pairs
    std::vector<std::size_t> clusterStart_;    // (clusters + 1) of rows_
    std::vector<KinematicRow> kinematicRows_;  // cluster by cluster
    std::vector<std::size_t> kinematicStart_;  // (clusters + 1)
    std::vector<int> parent_;                  // (points) union-find; -1: in no pair
    std::vector<int> touched_;                 // points of pairs, ascending
    std::vector<double> impulses_;             // (pairs)
    std::vector<dvec3> frictions_;             // (pairs)
    int mostSweeps_ = 0;
};

}  // namespace taut::contact
