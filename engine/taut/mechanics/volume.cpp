#include "taut/mechanics/private/volume.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/instruction_set.h"
#include "taut/mechanics/private/cell_shape.h"

namespace taut::mechanics {

TAUT_KERNELS(template <class Real> void addVolume(const VolumeBatch<Real>&);)

namespace {

using glm::dvec3;
using Corners = CellCorners;

std::vector<std::array<int, 8>> pointsOf(std::span<const VolumeCell> cells) {
    std::vector<std::array<int, 8>> points;
    for (const VolumeCell& cell : cells) points.push_back(cell.points);
    return points;
}

// The largest |V/V0 - 1| within the working stretch s, from mirrored cells to cells stretched along all three axes.
double largestChange(double s) {
    return std::max(1.0 + s, s * s * s - 1.0);
}

bool isBeyond(const Corners& rest, const Corners& now, double ratio, double s) {
    if (std::abs(ratio - 1.0) > largestChange(s)) return true;
    for (const CellPair& pair : cellPairs)
        if (glm::length(now[pair.j] - now[pair.i]) > s * glm::length(rest[pair.j] - rest[pair.i])) return true;
    const Corners g0 = gradientsOf(rest), g = gradientsOf(now);
    for (std::size_t i = 0; i < 8; ++i)
        if (glm::length(g[i]) > s * s * glm::length(g0[i])) return true;
    return false;
}

}  // namespace

template <class Real>
VolumePreservation<Real>::VolumePreservation(std::span<const VolumeCell> cells,
                                             std::span<const glm::dvec3> restPositions, double workingStretch)
    : cells_(cells.begin(), cells.end()),
      workingStretch_(workingStretch),
      runs_(pointsOf(cells)),
      twelfthOfBulk_(runs_.sources().size()),
      inverseRestTwelvefold_(runs_.sources().size()),
      packed_(8 * static_cast<std::size_t>(runs_.lanes().loosePointCount)),
      addBatch_(TAUT_IN_USE(addVolume<Real>)) {
    TAUT_EXPECTS(workingStretch >= 1.0);
    for (const VolumeCell& cell : cells_) {
        TAUT_EXPECTS(cell.restVolume > 0.0);
        rest_.push_back(cornersOf(cell, restPositions));
    }
    setBulkModuli(cells);
}

template <class Real>
void VolumePreservation<Real>::setBulkModuli(std::span<const VolumeCell> cells) {
    TAUT_EXPECTS(cells.size() == cells_.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
        TAUT_EXPECTS(cells[c].bulkModulus >= 0.0);
        cells_[c].bulkModulus = cells[c].bulkModulus;
    }
    for (std::size_t lane = 0; lane < runs_.sources().size(); ++lane) {
        const int source = runs_.sources()[lane];
        if (source < 0) continue;
        const VolumeCell& cell = cells_[source];
        twelfthOfBulk_[lane] = static_cast<Real>(cell.bulkModulus / 12.0);
        inverseRestTwelvefold_[lane] = static_cast<Real>(1.0 / (12.0 * cell.restVolume));
    }
}

template <class Real>
VolumeReport VolumePreservation<Real>::inspect(const Motion<Real>& motion, bool stretches) const {
    VolumeReport report;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        const Corners now = cornersOf(cells_[c], motion.x, motion.stride);
        const double ratio = volumeOf(now) / cells_[c].restVolume;
        if (report.smallestCell < 0 || ratio < report.smallestRatio) {
            report.smallestRatio = ratio;
            report.smallestCell = static_cast<int>(c);
        }
        if (ratio < 0.1) ++report.collapsed;
        if (ratio <= 0.0) ++report.inverted;
        // Rounding of the positions must not count as a stretch.
        if (stretches && isBeyond(rest_[c], now, ratio, workingStretch_ * (1.0 + 1e-4))) ++report.overstretched;
    }
    return report;
}

template <class Real>
void VolumePreservation<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    TAUT_EXPECTS(first == 0 && last == motion.count);
    VolumeBatch<Real> batch{};
    batch.lanes = runs_.lanes();
    batch.twelfthOfBulk = twelfthOfBulk_.data();
    batch.inverseRestTwelvefold = inverseRestTwelvefold_.data();
    batch.stride = motion.stride;
    batch.x = motion.x;
    batch.f = f;
    batch.packed = packed_.data();
    addBatch_(batch);
}

template <class Real>
double VolumePreservation<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    double energy = 0.0;
    for (const VolumeCell& cell : cells_) {
        const auto isLeftOut = [&](int point) { return !only.empty() && !only[point]; };
        if (std::any_of(cell.points.begin(), cell.points.end(), isLeftOut)) continue;
        energy += volumeEnergy(cell, cornersOf(cell, motion.x, motion.stride));
    }
    return energy;
}

template <class Real>
void VolumePreservation<Real>::addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const {
    const std::ptrdiff_t stride = motion.stride;
    for (const VolumeCell& cell : cells_) {
        const Corners w = cornersOf(cell, u, stride);
        if (std::all_of(w.begin(), w.end(), [](const dvec3& own) { return own == dvec3(0.0); })) continue;
        const Corners p = cornersOf(cell, motion.x, stride);
        const Corners g = gradientsOf(p);
        const double change = volumeOf(p) / cell.restVolume - 1.0;
        double along = 0;
        for (std::size_t c = 0; c < 8; ++c) along += glm::dot(g[c], w[c]) / cell.restVolume;
        const Corners h = gradientsChange(p, w);
        Corners product;
        for (std::size_t c = 0; c < 8; ++c) product[c] = along * g[c] + change * h[c];
        forEachFold(p, cell.restVolume, [&](const Fold& fold) {
            const auto [at, a, b, c] = fold.corners;
            double rise = 0;
            for (std::size_t i = 0; i < 4; ++i)
                rise += 6.0 / cell.restVolume * glm::dot(fold.gradients[i], w[fold.corners[i]]);
            const dvec3 ofA = p[a] - p[at], ofB = p[b] - p[at], ofC = p[c] - p[at];
            const dvec3 wA = w[a] - w[at], wB = w[b] - w[at], wC = w[c] - w[at];
            const dvec3 hA = (glm::cross(wB, ofC) + glm::cross(ofB, wC)) / 6.0,
                        hB = (glm::cross(wC, ofA) + glm::cross(ofC, wA)) / 6.0,
                        hC = (glm::cross(wA, ofB) + glm::cross(ofA, wB)) / 6.0;
            const std::array<dvec3, 4> changes{-(hA + hB + hC), hA, hB, hC};
            for (std::size_t i = 0; i < 4; ++i)
                product[fold.corners[i]] += rise * fold.gradients[i] + fold.ratio * changes[i];
        });
        for (std::size_t c = 0; c < 8; ++c)
            for (int axis = 0; axis < 3; ++axis)
                out[axis * stride + cell.points[c]] += static_cast<Real>(cell.bulkModulus * product[c][axis]);
    }
}

template <class Real>
void VolumePreservation<Real>::linearise(const Motion<Real>& motion, double stiffness, double) {
    slopes_.clear();
    const auto add = [&](const VolumeCell& cell, double volume, auto corners, auto gradients) {
        Slope slope{{}, corners.size(), {}};
        const double root = std::sqrt(stiffness * cell.bulkModulus / volume);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            slope.points[i] = cell.points[corners[i]];
            for (std::size_t axis = 0; axis < 3; ++axis)
                slope.of[3 * i + axis] = static_cast<Real>(root * gradients[i][static_cast<int>(axis)]);
        }
        slopes_.push_back(slope);
    };
    for (const VolumeCell& cell : cells_) {
        const Corners p = cornersOf(cell, motion.x, motion.stride);
        add(cell, cell.restVolume, cellCorners, gradientsOf(p));
        forEachFold(p, cell.restVolume,
                    [&](const Fold& fold) { add(cell, cell.restVolume / 6.0, fold.corners, fold.gradients); });
    }
}

template <class Real>
void VolumePreservation<Real>::addProduct(int stride, const Real* u, Real* out) const {
    for (const Slope& slope : slopes_) {
        Real along = 0;
        for (std::size_t i = 0; i < slope.count; ++i)
            for (int axis = 0; axis < 3; ++axis)
                along += slope.of[3 * i + static_cast<std::size_t>(axis)] * u[axis * stride + slope.points[i]];
        for (std::size_t i = 0; i < slope.count; ++i)
            for (int axis = 0; axis < 3; ++axis)
                out[axis * stride + slope.points[i]] += along * slope.of[3 * i + static_cast<std::size_t>(axis)];
    }
}

template <class Real>
void VolumePreservation<Real>::addDiagonal(int stride, Real* out) const {
    for (const Slope& slope : slopes_)
        for (std::size_t i = 0; i < slope.count; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const Real of = slope.of[3 * i + static_cast<std::size_t>(axis)];
                out[axis * stride + slope.points[i]] += of * of;
            }
}

template class VolumePreservation<float>;
template class VolumePreservation<double>;

}  // namespace taut::mechanics
