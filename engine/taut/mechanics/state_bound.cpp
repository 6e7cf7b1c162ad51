#include "taut/mechanics/private/state_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/vectorise.h"
#include "taut/mechanics/private/cell_shape.h"

namespace taut::mechanics {
namespace {

constexpr int slice = 128;  // springs at once, so that data between two loops stays in the first-level cache
constexpr int lanes = 16;   // partial maxima

template <class Real>
struct Entries {
    alignas(64) Real of[6][slice];
};

// The entries of k [(1 - t) nnᵀ + t I] for n springs, t = max(0, 1 - L/l).
template <class Real>
inline void springEntries(int n, const Real* const from[3], const Real* const to[3], const Real* k, const Real* rest,
                          Entries<Real>& g) {
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const Real dx = to[0][i] - from[0][i], dy = to[1][i] - from[1][i], dz = to[2][i] - from[2][i];
        const Real l = std::sqrt(dx * dx + dy * dy + dz * dz);
        const Real inverse = l > Real(0) ? Real(1) / l : Real(0);
        const Real stretched = Real(1) - rest[i] * inverse;
        const Real across = stretched > Real(0) ? stretched : Real(0);
        const Real same = k[i] * across, along = k[i] * (Real(1) - across) * inverse * inverse;
        const Real ax = along * dx, ay = along * dy, az = along * dz;
        g.of[0][i] = ax * dx + same;
        g.of[1][i] = ax * dy;
        g.of[2][i] = ax * dz;
        g.of[3][i] = ay * dy + same;
        g.of[4][i] = ay * dz;
        g.of[5][i] = az * dz + same;
    }
}

// The largest root x of x³ - 3x - 2r, 2 cos(acos(r)/3), by a polynomial in √((1 + r)/2). The polynomial is nowhere
// below the root, exact at both ends, and at most 1.3e-4 above. It comes from the root's values and slopes at the ends
// and its curvature at 0.
template <class Real>
inline Real largestRoot(Real r) {
    const Real half = Real(0.5) * (Real(1) + r);
    const Real y = std::sqrt(half > Real(0) ? (half < Real(1) ? half : Real(1)) : Real(0));
    return (Real(1) + Real(0.001) * y * (Real(1) - y)) *
           (Real(1) + y * (Real(1.15470054) + y * (Real(-0.22222222) + y * (Real(0.09145394) - y * Real(0.02393226)))));
}

// λ_max of a symmetric 3×3 matrix: the mean of its eigenvalues, plus their spread p times the root for their skewness
// (Smith 1961).
template <class Real>
inline Real largestEigenvalue(Real xx, Real xy, Real xz, Real yy, Real yz, Real zz) {
    const Real mean = (xx + yy + zz) * Real(1.0 / 3.0), scale = mean > Real(0) ? Real(1) / mean : Real(0);
    xx = xx * scale - Real(1);  // relative to the mean, so that no power is too large for single precision
    yy = yy * scale - Real(1);
    zz = zz * scale - Real(1);
    xy *= scale;
    xz *= scale;
    yz *= scale;
    const Real square = (xx * xx + yy * yy + zz * zz + Real(2) * (xy * xy + xz * xz + yz * yz)) * Real(1.0 / 6.0);
    const Real spread = std::sqrt(square);
    const Real determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    const Real cube = square * spread;
    const Real skewness = cube > Real(0) ? Real(0.5) * determinant / cube : Real(1);
    return mean * (Real(1) + spread * largestRoot(skewness));
}

}  // namespace

template <class Real>
StateBound<Real>::StateBound(int points, int stride)
    : points_(points),
      stride_(stride),
      sum_(6 * static_cast<std::size_t>(stride)),
      a_(static_cast<std::size_t>(stride)) {}

template <class Real>
void StateBound<Real>::setCells(std::span<const VolumeCell> cells, std::span<const glm::dvec3> restPositions) {
    TAUT_EXPECTS(restPositions.size() == static_cast<std::size_t>(points_));
    areWeightsKnown_ = false;
    rest_ = core::AlignedArray<Real>(3 * static_cast<std::size_t>(stride_));
    weights_ = core::AlignedArray<Real>(static_cast<std::size_t>(stride_));
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < points_; ++i) rest_[axis * stride_ + i] = static_cast<Real>(restPositions[i][axis]);
    cells_.assign(cells.begin(), cells.end());
    looks_.resize(cells_.size());
    pairs_.clear();
    pairsOf_.clear();
    std::map<std::pair<int, int>, int> numbers;
    for (const VolumeCell& cell : cells_) {
        pairsOf_.emplace_back();
        for (std::size_t e = 0; e < cellPairs.size(); ++e) {
            const auto ends = std::minmax(cell.points[cellPairs[e].i], cell.points[cellPairs[e].j]);
            const auto [entry, isNew] = numbers.try_emplace(ends, static_cast<int>(pairs_.size()));
            if (isNew) pairs_.push_back({ends.first, ends.second});
            pairsOf_.back()[e] = entry->second;
        }
    }
    pressed_.resize(pairs_.size());
    rows_.resize(points_);
}

template <class Real>
void StateBound<Real>::sumSprings(const SpringNetwork<Real>& network, const Real* x, Of what, const Real* weights) {
    Entries<Real> g;
    alignas(64) Real k[slice], rest[slice];
    for (const SpringRun<Real>& run : network.runs) {
        const Real* rests = run.mixed < 0 ? nullptr : network.mixed.data() + run.mixed;
        for (int first = 0; first < run.count; first += slice) {
            const int n = std::min(slice, run.count - first), a = run.a + first, b = a + run.offset;
            const Real* stiffness = network.stiffness.data() + run.table + first;
            for (int i = 0; i < n; ++i) {
                k[i] = stiffness[i];
                rest[i] = rests == nullptr ? run.restLength : rests[first + i];
                if (what != Of::dashpots) continue;
                k[i] *= rests == nullptr ? run.tau : rests[run.count + first + i];
                rest[i] = std::numeric_limits<Real>::max();
            }
            if (weights != nullptr)
                for (int i = 0; i < n; ++i) k[i] *= weights[a + i] + weights[b + i];
            const Real *const from[3] = {x + a, x + stride_ + a, x + 2 * stride_ + a}, *const to[3] = {
                                                                                           x + b, x + stride_ + b,
                                                                                           x + 2 * stride_ + b};
            springEntries(n, from, to, k, rest, g);
            for (int p = 0; p < 6; ++p) {
                const Real* entry = g.of[p];
                Real *atA = plane(p) + a, *atB = plane(p) + b;
                TAUT_INDEPENDENT
                for (int i = 0; i < n; ++i) atA[i] += entry[i];
                TAUT_INDEPENDENT
                for (int i = 0; i < n; ++i) atB[i] += entry[i];
            }
        }
    }
    sumSingles(network.singles, x, what, weights);
}

template <class Real>
void StateBound<Real>::sumSingles(const SpringSingles<Real>& s, const Real* x, Of what, const Real* weights) {
    Entries<Real> g;
    alignas(64) Real k[slice], rest[slice], ends[2][3][slice];
    for (int first = 0; first < s.size(); first += slice) {
        const int n = std::min(slice, s.size() - first);
        const int *a = s.a.data() + first, *b = s.b.data() + first;
        for (int p = 0; p < 3; ++p) {
            const Real* at = x + static_cast<std::ptrdiff_t>(p) * stride_;
            for (int i = 0; i < n; ++i) {
                ends[0][p][i] = at[a[i]];
                ends[1][p][i] = at[b[i]];
            }
        }
        for (int i = 0; i < n; ++i) {
            k[i] = s.k[first + i];
            rest[i] = s.restLength[first + i];
            if (weights != nullptr) k[i] *= weights[a[i]] + weights[b[i]];
            if (what != Of::dashpots) continue;
            k[i] *= s.tau[first + i];
            rest[i] = std::numeric_limits<Real>::max();
        }
        const Real *const from[3] = {ends[0][0], ends[0][1], ends[0][2]}, *const to[3] = {ends[1][0], ends[1][1],
                                                                                          ends[1][2]};
        springEntries(n, from, to, k, rest, g);
        for (int p = 0; p < 6; ++p) {
            Real* at = plane(p);
            for (int i = 0; i < n; ++i) {
                at[a[i]] += g.of[p][i];
                at[b[i]] += g.of[p][i];
            }
        }
    }
}

template <class Real>
void StateBound<Real>::lookAtCells(const Real* x) {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        looks_[c].corners = cornersOf(cells_[c], x, stride_);
        looks_[c].gradients = gradientsOf(looks_[c].corners);
    }
}

template <class Real>
void StateBound<Real>::sumCells(const Real* weights) {
    for (std::size_t number = 0; number < cells_.size(); ++number) {
        const VolumeCell& cell = cells_[number];
        const auto add = [&](const auto& corners, const auto& gradients, double volume) {
            double factor = cell.bulkModulus / volume;
            if (weights != nullptr) {
                double weight = 0;
                for (std::size_t c : corners) weight += static_cast<double>(weights[cell.points[c]]);
                factor *= weight;
            }
            for (std::size_t c = 0; c < corners.size(); ++c) {
                const int i = cell.points[corners[c]];
                const glm::dvec3 n = gradients[c], f = factor * n;
                plane(0)[i] += static_cast<Real>(f.x * n.x);
                plane(1)[i] += static_cast<Real>(f.x * n.y);
                plane(2)[i] += static_cast<Real>(f.x * n.z);
                plane(3)[i] += static_cast<Real>(f.y * n.y);
                plane(4)[i] += static_cast<Real>(f.y * n.z);
                plane(5)[i] += static_cast<Real>(f.z * n.z);
            }
        };
        add(cellCorners, looks_[number].gradients, cell.restVolume);
        forEachFold(looks_[number].corners, cell.restVolume,
                    [&](const Fold& fold) { add(fold.corners, fold.gradients, cell.restVolume / 6.0); });
    }
}

template <class Real>
void StateBound<Real>::takeRates(const Real* inverseMass, core::AlignedArray<Real>& a) const {
    const Real *xx = sum_.data(), *xy = xx + stride_, *xz = xy + stride_, *yy = xz + stride_, *yz = yy + stride_,
               *zz = yz + stride_;
    Real* rates = a.data();
    TAUT_INDEPENDENT
    for (int i = 0; i < points_; ++i)
        rates[i] = inverseMass[i] * largestEigenvalue(xx[i], xy[i], xz[i], yy[i], yz[i], zz[i]);
}

template <class Real>
double StateBound<Real>::largestOfSprings(const SpringNetwork<Real>& network, const Real* a) const {
    Real most[lanes] = {};
    for (const SpringRun<Real>& run : network.runs) {
        const Real *k = network.stiffness.data() + run.table, *from = a + run.a, *to = from + run.offset;
        const auto look = [&](int i, int lane) {
            const Real sum = k[i] > Real(0) ? from[i] + to[i] : Real(0);
            most[lane] = sum > most[lane] ? sum : most[lane];
        };
        int i = 0;
        for (; i + lanes <= run.count; i += lanes)
            for (int lane = 0; lane < lanes; ++lane) look(i + lane, lane);
        for (; i < run.count; ++i) look(i, 0);
    }
    const SpringSingles<Real>& s = network.singles;
    for (std::size_t i = 0; i < s.a.size(); ++i)
        if (s.k[i] > Real(0)) most[0] = std::max(most[0], a[s.a[i]] + a[s.b[i]]);
    return static_cast<double>(*std::max_element(most, most + lanes));
}

// The a_i of the first sweep of stability.h, at rest.
template <class Real>
void StateBound<Real>::findWeights(const SpringNetwork<Real>& network, const Real* inverseMass) {
    std::fill(sum_.begin(), sum_.end(), Real(0));
    sumSprings(network, rest_.data(), Of::stiffness, nullptr);
    lookAtCells(rest_.data());
    sumCells(nullptr);
    takeRates(inverseMass, weights_);
    areWeightsKnown_ = true;
}

// The largest rate of a point in the weighted sums, over the point's weight.
template <class Real>
double StateBound<Real>::largestShare() const {
    Real most = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(points_); ++i)
        if (weights_[i] > Real(0)) most = std::max(most, a_[i] / weights_[i]);
    return static_cast<double>(most);
}

// The largest row sum of the share of the cells' pressures, see B2 in stability.h.
template <class Real>
double StateBound<Real>::largestRow(const Real* inverseMass) {
    std::fill(pressed_.begin(), pressed_.end(), glm::dvec3(0.0));
    std::fill(rows_.begin(), rows_.end(), 0.0);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        const VolumeCell& cell = cells_[c];
        const CellCorners& p = looks_[c].corners;
        const double pressure = cell.bulkModulus * (volumeOf(p) / cell.restVolume - 1.0);
        for (std::size_t e = 0; e < cellPairs.size(); ++e) {
            const CellPair& pair = cellPairs[e];
            pressed_[pairsOf_[c][e]] +=
                (cell.points[pair.i] < cell.points[pair.j] ? pressure : -pressure) * pair.coupling(p);
        }
    }
    const auto add = [&](int i, int j, const glm::dvec3& h) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        const double entry =
            std::sqrt(static_cast<double>(inverseMass[a]) * static_cast<double>(inverseMass[b]) * glm::dot(h, h));
        rows_[a] += entry;
        rows_[b] += entry;
    };
    for (std::size_t e = 0; e < pairs_.size(); ++e) add(pairs_[e].a, pairs_[e].b, pressed_[e]);
    for (std::size_t c = 0; c < cells_.size(); ++c)
        forEachFold(looks_[c].corners, cells_[c].restVolume, [&](const Fold& fold) {
            for (const auto& [i, j, h] : couplingsOf(fold, looks_[c].corners))
                add(cells_[c].points[i], cells_[c].points[j], cells_[c].bulkModulus * h);
        });
    return rows_.empty() ? 0.0 : *std::max_element(rows_.begin(), rows_.end());
}

// If all springs have the same damping time, C is at most that time times their K.
template <class Real>
FastestNow StateBound<Real>::operator()(const SpringNetwork<Real>& network, const Real* x, const Real* inverseMass) {
    FastestNow now;
    const auto clear = [&] { std::fill(sum_.begin(), sum_.end(), Real(0)); };
    if (network.largestTau > Real(0) && !network.isTauUniform) {
        clear();
        sumSprings(network, x, Of::dashpots, nullptr);
        takeRates(inverseMass, a_);
        now.damping = largestOfSprings(network, a_.data());
    }
    const bool isWeighted = !cells_.empty();
    if (isWeighted && !areWeightsKnown_) findWeights(network, inverseMass);
    clear();
    sumSprings(network, x, Of::stiffness, isWeighted ? weights_.data() : nullptr);
    if (network.isTauUniform || !isWeighted) {
        takeRates(inverseMass, a_);
        now.omega2 = isWeighted ? largestShare() : largestOfSprings(network, a_.data());
        if (network.isTauUniform) now.damping = static_cast<double>(network.largestTau) * now.omega2;
    }
    if (!isWeighted) return now;
    lookAtCells(x);
    sumCells(weights_.data());
    takeRates(inverseMass, a_);
    now.omega2 = largestShare() + largestRow(inverseMass);
    return now;
}

template class StateBound<float>;
template class StateBound<double>;

}  // namespace taut::mechanics
