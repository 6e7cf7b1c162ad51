// Impulses that keep pairs apart, with Coulomb's friction, cluster by cluster.
//
//   0 <= λ  ⊥  n·Σ w u + max(g, 0) / h >= 0          u mean velocity of the points in the instant, g gap at its start
//
// From λ = 0 on sweeps projectedGaussSeidel ½ λᵀ A λ + λᵀ (u_n + g⁺/h), A = W M⁻¹ Wᵀ, below 0 of which the kinetic
// energy ½ Σ m u² has not grown; the steps on between them need not, but a sweep is always the last. The velocities v
// that a method stores get impulses of their own, of the pairs that press, by the same rule and from those on: what the
// points' mean motion needs is not what they need at its end. Overlaps are taken back as a shift without speed.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/gauss_seidel.h"

namespace taut::contact {

struct SolverOptions {
    int sweeps = 20;           // at most
    double recovery = 0.2;     // share of an overlap that is taken back an instant
    double restitution = 0.0;  // of arrivals faster than restSpeed [-]
    double restSpeed = 0.0;    // [m/s]
};

class ContactSolver {
  public:
    // Points (points) that a pair presses: u and v [m/s] become what they are after it, shift [m] what their place is
    // moved by besides. h [s]: length of the instant.
    void solve(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> held,
               std::span<const double> inverseMass, double h, const SolverOptions& options, std::span<dvec3> u,
               std::span<dvec3> v, std::span<dvec3> shift);

    // After that: points of the pairs, ascending; which of the pairs pressed, and how much [N s].
    std::span<const int> points() const { return touched_; }
    std::span<const double> impulses() const { return impulses_; }  // (pairs)
    int sweeps() const { return mostSweeps_; }                      // of the cluster that took most
    int clusters() const { return static_cast<int>(clusterStart_.size()) - 1; }

  private:
    struct Push {
        int pair;
        std::array<double, 4> gains;  // as of a row
        double mass;
        double recover, way = 0;  // [m] to be, and so far
    };
    void takeBack(std::span<const ContactConstraint> pairs, std::span<const Row> rows,
                  std::span<const KinematicRow> kinematicRows, double h, const SolverOptions& options, double little,
                  std::span<dvec3> shift) const;
    void findClusters(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> held,
                      std::size_t pointCount, std::span<const double> inverseMass);
    int root(int point);

    std::vector<Row> rows_;                  // cluster by cluster, in the order of the pairs
    std::vector<std::size_t> clusterStart_;  // of rows
    std::vector<KinematicRow> kinematicRows_;
    std::vector<std::size_t> kinematicStart_;  // (clusters + 1)
    std::vector<int> parent_, touched_;        // (points), points
    std::vector<double> impulses_;
    int mostSweeps_ = 0;
};

}  // namespace taut::contact
