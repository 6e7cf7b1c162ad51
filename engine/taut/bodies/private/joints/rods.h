// The rods of an island: distances that stay, between two points or a point and a place on a collider.
//
//        n₁          n₂
//    a ──────▶ b ──────────▶ c      g = (|d|² - L²)/2L,  ∇g = n along the rod, at either end
//
// Positions as in SHAKE (Ryckaert, Ciccotti and Berendsen 1977): impulses act along the rods' directions at the start
// of the step. They are equal and opposite, so momentum and angular momentum stay. Velocities as in RATTLE (Andersen
// 1983). One Newton method solves for all rods of an island. Its matrix J M⁻¹ Jᵀ at the old directions is symmetric and
// made once a step (Barth, Kuczera, Leimkuhler and Skeel 1995). It couples rods that share a point. In the order of
// Cuthill and McKee its envelope is narrow, two diagonals for a chain. It is factored as L D Lᵀ. A redundant rod, as in
// a truss with more bars than it needs, has no pivot and gets no impulse.
#pragma once

#include "taut/bodies/joints/constraint.h"
#include "taut/spec/source.h"

namespace taut::world {

class Rods final : public ConstraintOf<Rods> {
  public:
    // Ties two points of the plan, or a point and a place. [m]
    void tie(int a, int b, double length, const Source& source);
    void tie(int a, const Place& b, double length, const Source& source);

    std::span<const int> points() const override { return points_; }
    std::span<const Place> places() const override { return places_; }
    bool projectPositions(const Moment& moment) override;
    bool projectVelocities(const Moment& moment) override;
    int size() const override { return static_cast<int>(rods_.size()); }
    double strain(std::span<const dvec3> x, const std::vector<bool>& counts) const override;
    double turning(std::span<const dvec3> x, std::span<const double> inverseMass,
                   std::span<const dvec3> forces) const override;
    std::vector<Pair> pairs(double t) override;
    void check() const override;

  private:
    struct Rod {
        int a, b;       // of points_; below 0: -1 - place
        double length;  // [m]
        Source source;
    };
    // Two rods that share an end: the matrix has sign · w n_i·n_j in row i and column j < i.
    struct Coupling {
        int i, j, end;
        double sign;
    };

    int numberOf(int point);
    int end(int number) const { return number >= 0 ? number : static_cast<int>(points_.size()) - 1 - number; }
    dvec3 between(const Rod& rod, std::span<const dvec3> x) const {
        return x[static_cast<std::size_t>(end(rod.b))] - x[static_cast<std::size_t>(end(rod.a))];
    }
    void layOut();
    void factor(std::span<const dvec3> x, std::span<const double> inverseMass);
    void solve();
    void pull(std::span<dvec3> to, const Moment& moment) const;
    double& at(int row, int column) {
        return lower_[start_[static_cast<std::size_t>(row)] +
                      static_cast<std::size_t>(column - first_[static_cast<std::size_t>(row)])];
    }

    std::vector<int> points_;
    std::vector<Place> places_;
    std::vector<Rod> rods_;

    // The matrix, made when first asked for.
    std::vector<int> order_;            // (rows) rods
    std::vector<int> first_;            // (rows) first column of the envelope
    std::vector<std::size_t> start_;    // (rows) start in lower_
    std::vector<Coupling> couplings_;   // by row
    std::vector<double> lower_;         // L, row by row, without its diagonal
    std::vector<double> inversePivot_;  // (rows) 1/D; 0 without a pivot
    std::vector<dvec3> direction_;      // (rows) n, unit; 0 for broken rods
    std::vector<double> impulse_;       // (rows) g, then the impulse that pulls the ends together
};

}  // namespace taut::world
