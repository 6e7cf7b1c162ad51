// Cells that resist a change of their signed volume. So a block that was squashed flat or turned inside out comes back.
// Independent of the lattice of the cells.
//
// The lengths of its springs cannot tell a cell from its mirror image; V can:
//   E = ½ K V0 (V/V0 - 1)²,   F_i = -K (V/V0 - 1) ∂V/∂p_i.
// A cell has one pressure, by the mean of its dilatation: with one for each of its tetrahedra a block is too stiff when
// it bends (locking), the more the larger K is. The springs resist changes that keep V. They cannot tell a fold, so
// each of the six tetrahedra (cellTetrahedra) that is turned inside out resists by itself, from V_t = 0 on:
//   E = ½ K V0_t (V_t/V0_t)² while V_t < 0,   V0_t = V0/6.
// If a cell collapses to a line or a point, ∂V vanishes and nothing brings it back. inspect() reports that.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/model.h"
#include "taut/mechanics/private/index_runs.h"
#include "taut/mechanics/private/volume_kernel.h"

namespace taut::mechanics {

// The condition of all cells.
struct VolumeReport {
    double smallestRatio = 1.0;  // smallest V/V0 [-]
    int smallestCell = -1;       // the cell with the smallest ratio
    int collapsed = 0;           // cells with V/V0 < 0.1, inverted ones included
    int inverted = 0;            // cells with V/V0 <= 0
    int overstretched = 0;       // cells beyond the working stretch, where a step chosen for it may be too long
};

template <class Real>
class VolumePreservation final : public ForceGenerator<Real> {
  public:
    // Rest positions (points) [m] give the areas and distances by which inspect() finds a stretch. The volumes come
    // with the cells. Uses the kernel of the current instruction set. Expects V0 > 0, K >= 0, workingStretch >= 1.
    VolumePreservation(std::span<const VolumeCell> cells, std::span<const glm::dvec3> restPositions,
                       double workingStretch = 1.5);

    double workingStretch() const { return workingStretch_; }
    // Takes the bulk moduli of the cells. Expects the cells of the constructor.
    void setBulkModuli(std::span<const VolumeCell> cells);
    // Without `stretches` it counts no cells as overstretched.
    VolumeReport inspect(const Motion<Real>& motion, bool stretches = true) const;

    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;
    // The exact product. It is indefinite where a cell is compressed.
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override;
    // (K/V0) g gᵀ of each cell and fold, g = ∂V/∂p: the part that is never negative.
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;

    // Adds nothing, because the bounds of stability.h count cells themselves. These bounds hold, and inspect() finds
    // nothing overstretched, while
    //   |g| <= s² |g| at rest,   edges and diagonals of faces <= s those at rest,   |V/V0 - 1| <= max(1 + s, s³ - 1),
    // s the working stretch.
    void addStability(const Motion<Real>&, StabilityShare&) const override {}

  private:
    std::vector<VolumeCell> cells_;
    std::vector<std::array<glm::dvec3, 8>> rest_;  // (cells) corners at rest [m]
    double workingStretch_;
    IndexRuns<8> runs_;
    core::AlignedArray<Real> twelfthOfBulk_, inverseRestTwelvefold_;  // (lanes)
    mutable core::AlignedArray<Real> packed_;                         // scratch of the kernel
    void (*addBatch_)(const VolumeBatch<Real>&);
    struct Slope {
        std::array<int, 8> points;
        std::size_t count;        // of points: 8 of a cell, 4 of a fold
        std::array<Real, 24> of;  // √(s K/V0) g, point by point
    };
    std::vector<Slope> slopes_;  // of the cells and of their folds as linearise() found them
};

extern template class VolumePreservation<float>;
extern template class VolumePreservation<double>;

}  // namespace taut::mechanics
