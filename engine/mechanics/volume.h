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

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/index_runs.h"
#include "taut/mechanics/model.h"
#include "taut/mechanics/volume_kernel.h"

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
    // Takes the bulk moduli of the cells, which are those that it was made with.
    void setBulkModuli(std::span<const VolumeCell> cells);
    VolumeReport inspect(const Motion<Real>& motion) const;

    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;
    // The exact product; indefinite where a cell is compressed.
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override;
    // (K/V0) g gᵀ of each cell, g = ∂V/∂p: the part that is never negative.
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;

    // A bound λ of ω² that holds in the whole working range, given to every point that it acts on as λ/w.
    //
    // With g_i = ∂V/∂p_i, a third of the area of the face opposite i, and H_ij = ∂²V/∂p_i∂p_j, a cross product with a
    // sixth of the edge between the other two corners,
    //
    //   ∂²E = Σ_cells (K/V0) g gᵀ + K (V/V0 - 1) H.
    //
    // The first sum is GᵀG with rows √(K/V0) gᵀ; its largest eigenvalue over the masses is that of G w Gᵀ, whose rows
    // (Gershgorin) sum to at most √(K/V0) Σ_i w_i |g_i| T_i, T_i the sum of √(K/V0) |g_i| over the cells at point i.
    // In the second the row of point i sums to at most Σ_cells K |V/V0 - 1| Σ_j √(w_i w_j) |edge|/6. While no edge is
    // longer than s, no face larger than s² times at rest, and V/V0 lies within its bounds, mirrored cells included,
    //
    //   |g_i| <= s² |g_i| at rest,   edge <= s edge at rest,   |V/V0 - 1| <= max(1 + s, s³ - 1).
    //
    // Where a cell has left this range the motion's own values count if they are more.
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    std::vector<VolumeCell> cells_;
    std::vector<std::array<glm::dvec3, 4>> rest_;  // (cells) corners at rest [m]
    double workingStretch_;
    IndexRuns<4> runs_;
    core::AlignedArray<Real> sixthOfBulk_, inverseRestSixth_;  // (lanes)
    void (*addBatch_)(const VolumeBatch<Real>&);
    std::vector<std::array<Real, 12>> slopes_;  // (cells) √(s K/V0) g, corner by corner
};

extern template class VolumePreservation<float>;
extern template class VolumePreservation<double>;

}  // namespace taut::mechanics
