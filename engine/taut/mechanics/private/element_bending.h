// The force of bending elements (bending_elements.h) on the points of a body. Independent of their origin.
//
//   E = Σ ½ κᵀ M κ - Σ n·y + const      with y = Σ_j β_j x_j, β_j = Σ_kl w_jk M_kl rest_l, for elements curved at rest
//
// The first sum is one symmetric matrix for all elements, whose rows sum to 0: f_i = Σ_j g_ij (x_j - x_i). The second
// gives f_j = β_j n, and as δn = -Σ g_i (n·δx_i) with the gradients g_i of a triangle's hat functions, -(g_i·y) n to
// its corner i. Both go point by point in a fixed order. Momentum and angular momentum are exact.
#pragma once

#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "taut/mechanics/bending_elements.h"
#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/private/element_kernel.h"

namespace taut::mechanics {

// x y z 0, which is one or two registers.
template <class Real>
struct alignas(4 * sizeof(Real)) PackedVector {
    Real of[4] = {};

    Real operator[](std::ptrdiff_t axis) const { return of[axis]; }
    PackedVector& operator+=(const PackedVector& b) { return *this = *this + b; }
    PackedVector& operator-=(const PackedVector& b) { return *this = *this - b; }
    friend PackedVector operator+(const PackedVector& a, const PackedVector& b) {
        return {{a.of[0] + b.of[0], a.of[1] + b.of[1], a.of[2] + b.of[2], a.of[3] + b.of[3]}};
    }
    friend PackedVector operator-(const PackedVector& a, const PackedVector& b) {
        return {{a.of[0] - b.of[0], a.of[1] - b.of[1], a.of[2] - b.of[2], a.of[3] - b.of[3]}};
    }
    friend PackedVector operator*(Real s, const PackedVector& a) {
        return {{s * a.of[0], s * a.of[1], s * a.of[2], s * a.of[3]}};
    }
};

template <class Real>
class ElementBending final : public ForceGenerator<Real> {
  public:
    // How held directions are turned at t [s]; null: not at all.
    using Turn = std::function<glm::dquat(double t)>;

    // `points`: the body's points in the island.
    ElementBending(std::vector<BendingElement> elements, double dampingTime, std::span<const int> points,
                   Turn turn = {});

    // Takes other elements of the same body.
    void set(std::vector<BendingElement> elements, double dampingTime);

    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override;
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    using Four = PackedVector<Real>;
    using Fours = std::vector<Four>;
    using Entry = WeightedPoint<Real>;
    // For WeightedRows.
    struct Rows {
        std::vector<int> first;  // (rows + 1)
        std::vector<Entry> entries;
    };
    // Of an element that is curved at rest.
    struct Curved {
        glm::dvec3 held;  // the part of y that is held, unturned [N]
        Real square;      // restᵀ M rest [N m]
    };
    struct Frame {
        Four normal, toB, toC;  // n, g_b, g_c
        Real length = 0;        // of y, of a rope
    };

    static glm::dvec3 vectorOf(const Four& v) { return {v[0], v[1], v[2]}; }
    static Four four(const glm::dvec3& v) {
        return {{static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z), 0}};
    }
    std::size_t slotOf(int point) const { return slots_[point]; }
    static Rows rowsOf(const std::vector<std::vector<Entry>>& lists);
    // x + τ v of the points by slots.
    void gather(const Real* x, const Real* v, double dampingTime, int stride) const;
    void findSums() const;                                   // y of all curved elements, of the gathered points
    Frame frameOf(const int* corners, const Four& y) const;  // of the gathered points
    // The effect of elements that are curved at rest on their points: of places, and of displacements from `frames`.
    void findPulls(double t) const;
    void findPulls(const std::vector<Frame>& frames) const;
    std::vector<Frame> framesAt(double t) const;
    bool turnHeld(double t) const;
    // Adds `scale` times the forces of the gathered points and the pulls.
    void addSums(Real scale, int stride, Real* out) const;
    static WeightedRows<Real> weighted(const Rows& rows, const Fours& of) {
        return {rows.first.data(), rows.entries.data(), of.empty() ? nullptr : of[0].of};
    }
    glm::dmat3 curvatureOf(const BendingElement& element, const Motion<Real>& motion) const;
    glm::dquat turnAt(double t) const { return turn_ ? turn_(t) : glm::dquat(1, 0, 0, 0); }

    std::vector<BendingElement> elements_;  // with points of the island
    double dampingTime_ = 0;
    std::vector<int> points_;         // (slots) in the island, ascending
    std::vector<std::size_t> slots_;  // (points of the body)
    Turn turn_;
    Rows matrix_;  // rows by slot, g_ij from slot j
    Rows pulls_;   // rows by slot, from four pulls of each curved element: of n, of its corners
    Rows sums_;    // rows by curved element, β from slots
    std::vector<Curved> curved_;
    std::vector<std::array<int, 3>> corners_;  // (curved) slots; -1: of a rope
    bool hasHeldSums_ = false;
    std::vector<std::pair<std::size_t, glm::dvec3>> held_;  // slots and the force of held directions, unturned [N]
    std::vector<Frame> frames_;                             // (curved) of linearise()
    double productFactor_ = 0;
    ElementKernels<Real> kernels_{};
    mutable Fours places_, pull_, y_, heldSums_;  // (slots), (4 · curved), (curved), (curved): scratch
};

extern template class ElementBending<float>;
extern template class ElementBending<double>;

}  // namespace taut::mechanics
