// The bound of a state's frequencies over a network as it is laid out for speed: cheap enough to be asked for every
// tick.
//
// Springs alone: B2 of stability.h. With cells, and any weights w_i > 0 of the points that move (0 of held ones),
//
//   λ <= max over points i of λ_max(Σ over the elements e at i of (Σ over the points j of e of w_j) K_e,ii) / (m_i w_i)
//
// by Cauchy and Schwarz, and what the pressures of the cells add. The weights are the a_i of B2 at rest: nearly as
// tight as those of the state itself, which would cost a sweep of their own.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/mechanics/private/cell_shape.h"
#include "taut/mechanics/model.h"
#include "taut/mechanics/spring_network.h"

namespace taut::mechanics {

// Bounds of the two largest eigenvalues that limit a step.
struct FastestNow {
    double omega2 = 0;   // [1/s²] of M⁻¹K, springs and cells
    double damping = 0;  // [1/s] of M⁻¹C, dashpots
    double pairs = 0;    // [1/s] DashpotSweep::largestPairRate(), which no state changes
};

template <class Real>
class StateBound {
  public:
    // Of points in planes of `stride`.
    StateBound(int points, int stride);

    // Cells by the points of the network; restPositions (points) [m], up to a rigid motion of each body.
    void setCells(std::span<const VolumeCell> cells, std::span<const glm::dvec3> restPositions);
    // To be called when masses or springs have changed: the weights are found again.
    void forgetWeights() { areWeightsKnown_ = false; }

    // x (3 · stride) [m], inverseMass (stride) [1/kg], 0 if held. Same bits on every machine; single precision may come
    // out low by a ten-thousandth.
    FastestNow operator()(const SpringNetwork<Real>& network, const Real* x, const Real* inverseMass);

  private:
    enum class Of { stiffness, dashpots };

    void findWeights(const SpringNetwork<Real>& network, const Real* inverseMass);
    double largestShare() const;
    void sumSprings(const SpringNetwork<Real>& network, const Real* x, Of what, const Real* weights);
    void sumSingles(const SpringSingles<Real>& s, const Real* x, Of what, const Real* weights);
    void lookAtCells(const Real* x);
    void sumCells(const Real* weights);
    // a (points) from the sums: w λ_max.
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
    struct Edge {
        int a, b;
    };
    std::vector<Edge> edges_;                  // of the cells, the lower point first
    std::vector<std::array<int, 6>> edgesOf_;  // (cells) numbers of their edges, in the order of cell_shape.h
    std::vector<glm::dvec3> pressed_;          // (edges) [N/m]
    std::vector<double> rows_;                 // (points)
};

extern template class StateBound<float>;
extern template class StateBound<double>;

}  // namespace taut::mechanics
