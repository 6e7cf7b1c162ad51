// Tetrahedra that resist a change of their signed volume, so that a block squashed flat or turned inside out comes
// back. Knows only tetrahedra, not the lattice they come from.
//
// A tetrahedron's edges cannot tell it from its mirror image; V = det[e1 e2 e3]/6 can:
//   E = ½ K V0 (V/V0 - 1)²,   F_i = -K (V/V0 - 1) ∂V/∂p_i.
// Collapsed to a line or a point ∂V vanishes and nothing brings it back: inspect() tells.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mechanics/force_generator.h"
#include "mechanics/index_runs.h"
#include "mechanics/model.h"
#include "mechanics/volume_kernel.h"

namespace taut::mechanics {

// How tetrahedra fare.
struct VolumeReport {
    double smallestRatio = 1.0;  // smallest V/V0 [-]
    int smallestCell = -1;       // the cell that has it
    int collapsed = 0;           // cells with V/V0 < 0.1, inverted ones included
    int inverted = 0;            // cells with V/V0 <= 0
    int overstretched = 0;       // cells beyond the working stretch: there the stability share does not hold
};

template <class Real>
class VolumePreservation final : public ForceGenerator<Real> {
  public:
    // Rest positions (points) [m] give the areas and edges of the stability share; the volumes come with the cells.
    // Uses the kernel of the instruction set in use now. Expects V0 > 0, K >= 0, workingStretch >= 1.
    VolumePreservation(std::span<const VolumeCell> cells, std::span<const glm::dvec3> restPositions,
                       double workingStretch = 1.5);

    double workingStretch() const { return workingStretch_; }
    VolumeReport inspect(const Motion<Real>& motion) const;

    std::string_view name() const override { return "volume"; }
    bool isLocal() const override { return false; }
    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>& motion) const override;
    // The exact product; indefinite where a cell is compressed.
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override;

    // Row bound of K = ∂²E. With g_i = ∂V/∂p_i, and H_ij = ∂²V/∂p_i∂p_j, a cross product with a sixth of the edge
    // between the other two corners, so that |H_ij| = |edge|/6:
    //
    //   K_ij = (K/V0) g_i g_jᵀ + K (V/V0 - 1) H_ij
    //   Σ_j |K_ij| <= (K/V0) |g_i| Σ_j |g_j| + K |V/V0 - 1| (edges of the face opposite i)/6
    //
    // and |g_i| is a third of the area of that face. In every state in which no edge is longer than s times its rest
    // length, no face larger than s² times, and -1 <= V/V0 <= s³, that is at most
    //
    //   (K/V0) s⁴ |g_i0| Σ_j |g_j0| + K max(2, s³ - 1) s (rest edges)/6,     s the working stretch,
    //
    // mirrored cells included. A cell that has left this range counts with the motion's own values if they are more.
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    std::vector<VolumeCell> cells_;
    std::vector<std::array<glm::dvec3, 4>> rest_;  // (cells) corners at rest [m]
    double workingStretch_;
    IndexRuns<4> runs_;
    core::AlignedArray<Real> sixthOfBulk_, inverseRestSixth_;  // (lanes)
    void (*addBatch_)(const VolumeBatch<Real>&);
};

extern template class VolumePreservation<float>;
extern template class VolumePreservation<double>;

}  // namespace taut::mechanics
