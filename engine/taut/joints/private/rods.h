// The rods of an island: distances that stay, between two places on bodies, or one on a collider; and leashes, whose
// ends may be nearer. A leash is a rod while it would be too long.
//
//        n₁          n₂
//    a ──────▶ b ──────────▶ c      g = (|d|² - L²)/2L,  ∇g = n along the rod, at either end
//
// Positions as in SHAKE (Ryckaert, Ciccotti and Berendsen 1977): impulses act along the rods' directions at the start
// of the step. They are equal and opposite, so momentum and angular momentum stay. Velocities as in RATTLE (Andersen
// 1983). One Newton method solves for all rods of an island. Its matrix J M⁻¹ Jᵀ at the old directions is symmetric and
// made once a step (Barth, Kuczera, Leimkuhler and Skeel 1995). It couples rods whose ends have a point in common. In
// the order of Cuthill and McKee its envelope is narrow, two diagonals for a chain. It is factored as L D Lᵀ. A
// redundant rod, as in a truss with more bars than it needs, has no pivot and gets no impulse.
#pragma once

#include "taut/plan/constraint.h"
#include "taut/plan/private/envelope_matrix.h"
#include "taut/plan/private/tie_ends.h"
#include "taut/spec/source.h"

namespace taut::world {

class Rods final : public ConstraintOf<Rods> {
  public:
    // Ties two spots of the plan, or a spot and a place on a collider. [m]
    void tie(const Spot& a, const Spot& b, double length, const Source& source, bool isMost = false);
    void tie(const Spot& a, const Place& b, double length, const Source& source, bool isMost = false);

    std::span<const int> points() const override { return ends_.points; }
    std::span<const Place> places() const override { return ends_.places; }
    bool projectPositions(const Moment& moment) override;
    bool projectVelocities(const Moment& moment) override;
    int size() const override { return static_cast<int>(rods_.size()); }
    double strain(std::span<const dvec3> x, const std::vector<bool>& counts) const override;
    double turning(std::span<const dvec3> x, std::span<const double> inverseMass,
                   std::span<const dvec3> forces) const override;
    std::span<const Pair> pairs(double t) override;
    void check() const override;

  private:
    struct Rod {
        Spot a, b;      // numbers as in Moment
        double length;  // [m]
        Source source;
        bool isMost;  // of the length
    };
    // Two rods whose ends have a point in common: the matrix has weight · w n_i·n_j in row i and column j < i.
    struct Coupling {
        int i, j, point;
        double weight;
    };

    static dvec3 between(const Rod& rod, std::span<const dvec3> x) { return rod.b.of(x) - rod.a.of(x); }
    void layOut();
    void tiesChanged() override { pairs_.clear(); }
    bool slacken();
    void findTaut(const Moment& moment, bool ofPlaces);
    bool mayPull(int rod) const { return holds(rod) && isTaut_[static_cast<std::size_t>(rod)]; }
    void factor(std::span<const dvec3> x, std::span<const double> inverseMass);
    void pull(std::span<dvec3> to, const Moment& moment) const;

    TieEnds ends_;
    std::vector<Rod> rods_;
    std::vector<Pair> pairs_;  // made when first asked for

    // Made when first asked for.
    std::vector<int> order_;           // (rows) rods
    std::vector<Coupling> couplings_;  // by row
    EnvelopeMatrix matrix_;
    std::vector<bool> isTaut_;      // (rods) whether it counts, in a projection
    std::vector<double> diagonal_;  // (rows)
    std::vector<dvec3> direction_;  // (rows) n, unit; 0 for broken rods
    std::vector<double> impulse_;   // (rows) g, then the impulse that pulls the ends together
};

}  // namespace taut::world
