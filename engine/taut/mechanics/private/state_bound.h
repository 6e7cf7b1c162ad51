// The bound of a state's frequencies, over a network that is laid out for speed. It is cheap enough for every tick.
//
// With springs alone it is B2 of stability.h. With cells, and any weights w_i > 0 of free points (0 of held points),
//
//   λ <= max over points i of λ_max(Σ over the elements e at i of (Σ over the points j of e of w_j) K_e,ii) / (m_i w_i)
//
// by Cauchy and Schwarz, plus the part of the cells' pressures. The weights are the a_i of B2 at rest. They are nearly
// as tight as those of the state itself, which would cost another sweep.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/mechanics/model.h"
#include "taut/mechanics/private/cell_shape.h"
#include "taut/mechanics/spring_network.h"

namespace taut::mechanics {

// Bounds of the two largest eigenvalues that limit a step.
struct FastestNow {
    double omega2 = 0;   // [1/s²] of M⁻¹K, springs and cells
    double damping = 0;  // [1/s] of M⁻¹C, dashpots
    double pairs = 0;    // [1/s] DashpotSweep::largestPairRate(), the same in every state
};

template <class Real>
class StateBound {
  public:
    // For points in planes of `stride`.
    StateBound(int points, int stride);

    // Cells name points of the network. restPositions (points) [m], up to a rigid motion of each body.
    void setCells(std::span<const VolumeCell> cells, std::span<const glm::dvec3> restPositions);
    // Call it when masses or springs have changed, so that the weights are computed again.
    void forgetWeights() { areWeightsKnown_ = false; }

    // x (3 · stride) [m], inverseMass (stride) [1/kg], 0 if held. Every machine gives the same bits. In single
    // precision the bound may be too low by a ten-thousandth.
    FastestNow operator()(const SpringNetwork<Real>& network, const Real* x, const Real* inverseMass);

  private:
    enum class Of { stiffness, dashpots };

    void findWeights(const SpringNetwork<Real>& network, const Real* inverseMass);
    double largestShare() const;
    void sumSprings(const SpringNetwork<Real>& network, const Real* x, Of what, const Real* weights);
    void sumSingles(const SpringSingles<Real>& s, const Real* x, Of what, const Real* weights);
    void lookAtCells(const Real* x);
    void sumCells(const Real* weights);
    // Computes a (points) from the sums: w λ_max.
    void takeRates(const Real* inverseMass, core::AlignedArray<Real>& a) const;
    double largestOfSprings(const SpringNetwork<Real>& network, const Real* a) const;
    double largestRow(const Real* inverseMass);
    Real* plane(int p) { return sum_.data() + static_cast<std::ptrdiff_t>(p) * stride_; }

    int points_, stride_;
    core::AlignedArray<Real> sum_;             // (6 · stride) xx xy xz yy yz zz
    core::AlignedArray<Real> a_;               // (stride)
    core::AlignedArray<Real> rest_, weights_;  // (3 · stride) [m], (stride) [1/s²]; of networks with cells
    bool areWeightsKnown_ = false;
    std::vector<VolumeCell> cells_;
    struct Look {
        CellCorners corners, gradients;
    };
    std::vector<Look> looks_;  // (cells) as they are now
    struct Pair {
        int a, b;
    };
    std::vector<Pair> pairs_;                                 // of points that cells couple, the lower one first
    std::vector<std::array<int, cellPairs.size()>> pairsOf_;  // (cells) their numbers, in the order of cell_shape.h
    std::vector<glm::dvec3> pressed_;                         // (pairs) [N/m]
    std::vector<double> rows_;                                // (points)
};

extern template class StateBound<float>;
extern template class StateBound<double>;

}  // namespace taut::mechanics
