// The force of Bending (model.h) on the points of a grid. It does not know whether the grid is a cloth or a rope.
//
// Momentum and angular momentum are exact, because every combination of places has weights that sum to 0 and pulls
// along itself. On an even grid the bound of its stiffness is exact too: rows of fourth differences sum to their
// largest eigenvalue.
#pragma once

#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/model.h"
#include "taut/mechanics/private/bending_kernel.h"

namespace taut::mechanics {

template <class Real>
class GridBending final : public ForceGenerator<Real> {
  public:
    // How the arms of the clamps are turned at t [s]; null: not at all.
    using Turn = std::function<glm::dquat(double t)>;

    // `points` (columns · rows): the grid's points in the island. Uses the kernel of the current instruction set.
    // Expects a bending that is not empty, with coefficients for each point.
    GridBending(Bending bending, std::span<const int> points, Turn turn = {});

    // Takes new coefficients and clamps, for a grid of the same size.
    void set(Bending bending);

    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override;
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    using Array = core::AlignedArray<Real>;
    struct Coefficients {     // in the precision of the kernel
        Array along, across;  // (points) [N/m]
        Array both, twist;    // (points) [N/m], or empty: see BendingBatch
        Real evenTwist = 0;   // [N/m]
    };
    // Places of the grid's points, in planes `stride` apart.
    struct Planes {
        const Real* x;
        int stride;
    };

    Coefficients scaled(double factor) const;
    // Adds -C D x to f, where x and f are planes of the island.
    void apply(const Coefficients& coefficients, Planes x, int stride, Real* f) const;
    Planes gathered(const Real* x, const Real* v, double dampingTime, int stride) const;
    glm::dvec3 armAt(const Bending::Clamp& clamp, double t) const;
    int size() const { return bending_.columns * bending_.rows; }

    Bending bending_;
    std::vector<int> points_;
    bool isInOrder_;  // the points follow each other in the island
    Turn turn_;
    Coefficients forces_, products_, stiffness_;
    double productFactor_ = 0;
    mutable Array places_, sums_;  // (3 · size) scratch
    mutable std::vector<Array> rooms_;
    void (*add_)(const BendingBatch<Real>&);
};

extern template class GridBending<float>;
extern template class GridBending<double>;

}  // namespace taut::mechanics
