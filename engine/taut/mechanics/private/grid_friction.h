// Friction between the threads of a bent grid, BendingFriction (model.h): it makes cloth keep a crease. Independent
// of the bending resistance of the grid.
//
//        q         normal  n = u × w/|u × w|,  u = r - p,  w = s - q      of the point c itself
//     p--c--r      folds   κ_u = n·(p - 2c + r)/a²,  κ_v = n·(q - 2c + s)/b²
//        s         force   -M ∂κ/∂x,  M = A K_p clamp(κ - κ_s, ± yield)
//
// The state is a slider κ_s for each fold. It is a number in the cloth's own frame: κ does not change when the sheet
// goes or turns, so that its slope, taken with that of n, has neither a sum nor a torque. A slider kept as a vector in
// space would turn the sheet. Towards a fold that is closed |u × w| vanishes and n with it; below half of its value
// at rest it is divided by that half, so that forces stay bounded and end with n.
//
// Between two slide() the force has a potential, and is that after slide() at the same places: when sliders follow
// makes no difference to a force, as long as they follow every step that stands.
#pragma once

#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/model.h"
#include "taut/mechanics/private/grid_bending.h"

namespace taut::mechanics {

template <class Real>
class GridFriction final : public ForceGenerator<Real> {
  public:
    using Turn = typename GridBending<Real>::Turn;

    // How many sliders a grid needs: one a point along and one across; where directions are held (clamps), as many
    // more, as a clamp has a fold on each side.
    static std::size_t sliderCount(const BendingFriction& friction, bool mayClamp);

    // `points` (columns · rows): the grid's points in the island. `sliders` [m] κ_s a² and κ_s b², 0 for cloth that was
    // never bent; they outlive it. Expects a friction that is not empty.
    GridFriction(BendingFriction friction, std::span<const int> points, std::span<Real> sliders, Turn turn = {});

    // Takes other coefficients and clamps, for a grid of the same size.
    void set(BendingFriction friction);

    // Sliders follow folds beyond the limit of friction, to the motion's places. Call once in every step.
    void slide(const Motion<Real>& motion);

    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    // The stored energy of stuck folds. Slip dissipates its energy.
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;

    // As if nothing slipped, and without the turning of n: the bending of K_p. For implicit methods this bounds the
    // slope from above, so that no step goes past where friction turns back, and keeps it positive. It is also the
    // share of the stability bound; the turning of n is a part κ_y a/4 of it, some thousandths.
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override {
        stuck_.addStiffnessProduct(motion, u, out);
    }
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override {
        stuck_.linearise(motion, stiffness, damping);
    }
    void addProduct(int stride, const Real* u, Real* out) const override { stuck_.addProduct(stride, u, out); }
    void addDiagonal(int stride, Real* out) const override { stuck_.addDiagonal(stride, out); }
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override {
        stuck_.addStability(motion, share);
    }

  private:
    // The points of a part of a row, all with their neighbours at the same distance in the arrays; 0 where there is
    // none.
    struct Part {
        int first, last, left, right, up, down;
        Real least;  // [m²] of |u × w|
    };
    struct Fold;
    // Places of the grid's points, in planes `stride` apart.
    struct Planes {
        const Real* of;
        int stride;
    };

    // The slider of a clamp, and the fold at which it slips [m].
    struct Slot {
        std::size_t slider;
        Real most;
    };

    int size() const { return friction_.stuck.columns * friction_.stuck.rows; }
    int numberOf(int point) const { return points_[point]; }  // in the island
    void gather(const Motion<Real>& motion) const;
    // Calls each(part) for all points, several rows at a time.
    template <class Each>
    void forEachPart(const Each& each) const;
    Fold foldAt(const Part& part, int i) const;
    void findPulls(const Part& part) const;
    void addPulls(const Part& part, int stride, Real* f) const;
    Slot slotOf(const Bending::Clamp& clamp) const;
    // n at a clamp, which turns with its carrier, and n times its fold as that of an entire fold [m].
    glm::dvec3 normalAt(double t) const;
    Real foldAt(const Bending::Clamp& clamp, const Motion<Real>& motion) const;
    // Plane `axis` of the pulls on p, r, q, s (0 to 3), from the first point on.
    Real* pullsOn(int which, int axis) const {
        return pulls_.data() + (3 * which + axis) * (size() + 2 * friction_.stuck.columns) + friction_.stuck.columns;
    }

    BendingFriction friction_;
    GridBending<Real> stuck_;
    std::vector<int> points_;
    std::span<Real> sliders_;
    Turn turn_;
    core::AlignedArray<Real> along_, across_;  // (points) [N/m]
    Real mostAlong_ = 0, mostAcross_ = 0;      // [m] yield a², yield b²
    bool isInOrder_ = true;                    // the points follow each other in the island
    mutable Planes x_{};                       // of the present call
    mutable core::AlignedArray<Real> places_;  // (3 · points) scratch
    mutable core::AlignedArray<Real> pulls_;   // (12 planes) scratch, each with a row of 0 around
};

extern template class GridFriction<float>;
extern template class GridFriction<double>;

}  // namespace taut::mechanics
