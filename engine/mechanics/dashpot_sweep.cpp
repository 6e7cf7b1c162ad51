#include "taut/mechanics/dashpot_sweep.h"

#include <algorithm>

#include "taut/core/instruction_set.h"
#include "taut/core/parallel.h"

namespace taut::mechanics {
namespace {

constexpr int chainOffset = 1;  // of dashpots of a run that are joined each to the next: a rope, a row of a sheet

// ½ c (w_a + w_b) [1/s]
template <class Real>
double pairRate(Real k, Real tau, Real wa, Real wb) {
    return 0.5 * static_cast<double>(k) * static_cast<double>(tau) *
           (static_cast<double>(wa) + static_cast<double>(wb));
}

// Calls each(k, τ, w_a, w_b) for every spring of a run.
template <class Real, class Each>
void forEachOf(const SpringNetwork<Real>& network, const SpringRun<Real>& run, const Real* w, Each&& each) {
    for (int i = 0; i < run.count; ++i)
        each(network.stiffness[static_cast<std::size_t>(run.table + i)],
             run.mixed < 0 ? run.tau : network.mixed[static_cast<std::size_t>(run.mixed + run.count + i)], w[run.a + i],
             w[run.a + i + run.offset]);
}

}  // namespace

template <class Real>
DashpotSweep<Real>::DashpotSweep() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            run_ = avx512::dampRun;
            list_ = avx512::dampList;
            break;
        case core::InstructionSet::avx2:
            run_ = avx2::dampRun;
            list_ = avx2::dampList;
            break;
        case core::InstructionSet::sse2:
            run_ = sse2::dampRun;
            list_ = sse2::dampList;
            break;
    }
}

template <class Real>
void DashpotSweep<Real>::prepare(const SpringNetwork<Real>& network, const Real* w, double h) {
    constexpr double strong = 0.5;  // y of half a step
    h_ = h;
    g_.clear();
    firstOf_.clear();
    isStiff_.clear();
    isBetween_.clear();
    hasBetween_ = false;
    double step = 0.5 * h;
    const auto add = [&](Real k, Real tau, Real wa, Real wb) {
        g_.push_back(static_cast<Real>(step * static_cast<double>(k) * static_cast<double>(tau) /
                                       (1.0 + step * pairRate(k, tau, wa, wb))));
    };
    for (const SpringRun<Real>& run : network.runs) {
        double most = 0;
        forEachOf(network, run, w,
                  [&](Real k, Real tau, Real wa, Real wb) { most = std::max(most, pairRate(k, tau, wa, wb)); });
        isStiff_.push_back(0.5 * h * most > strong);
        isBetween_.push_back(isStiff_.back() && run.offset == chainOffset);
        hasBetween_ = hasBetween_ || isBetween_.back();
        step = isBetween_.back() ? h : 0.5 * h;
        firstOf_.push_back(static_cast<int>(g_.size()));
        forEachOf(network, run, w, add);
    }
    step = 0.5 * h;
    firstSingle_ = g_.size();
    const SpringSingles<Real>& s = network.singles;
    for (std::size_t i = 0; i < s.a.size(); ++i) add(s.k[i], s.tau[i], w[s.a[i]], w[s.b[i]]);
}

template <class Real>
double DashpotSweep<Real>::largestPairRate(const SpringNetwork<Real>& network, const Real* w) {
    if (pairRate_ >= 0) return pairRate_;
    pairRate_ = 0;
    const auto look = [&](Real k, Real tau, Real wa, Real wb) {
        pairRate_ = std::max(pairRate_, pairRate(k, tau, wa, wb));
    };
    for (const SpringRun<Real>& run : network.runs)
        if (run.offset != chainOffset) forEachOf(network, run, w, look);
    const SpringSingles<Real>& s = network.singles;
    for (std::size_t i = 0; i < s.a.size(); ++i) look(s.k[i], s.tau[i], w[s.a[i]], w[s.b[i]]);
    return pairRate_;
}

template <class Real>
void DashpotSweep<Real>::before(const SpringNetwork<Real>& network, const Points& points, double h) {
    if (h != h_) prepare(network, points.w, h);
    damp(network, points, Part::before);
    if (!hasBetween_) return;
    const std::size_t size = 3 * static_cast<std::size_t>(points.stride);
    if (earlier_.size() != size) earlier_ = core::AlignedArray<Real>(size);
    std::copy_n(points.v, size, earlier_.data());
}

template <class Real>
void DashpotSweep<Real>::between(const SpringNetwork<Real>& network, const Points& points, double) {
    if (!hasBetween_) return;
    for (std::size_t i = 0; i < earlier_.size(); ++i) earlier_[i] = Real(0.5) * (earlier_[i] + points.v[i]);
    damp(network, points, Part::between);
}

template <class Real>
void DashpotSweep<Real>::after(const SpringNetwork<Real>& network, const Points& points, double) {
    damp(network, points, Part::after);
}

// Chunks touch points of the next one, so that every other chunk runs side by side.
template <class Real>
void DashpotSweep<Real>::damp(const SpringNetwork<Real>& network, const Points& points, Part part) {
    const int stride = points.stride;
    const Real *w = points.w, *x = points.x;
    Real* v = points.v;
    const bool isForwards = part != Part::after, isBetween = part == Part::between;
    const Real* felt = isBetween ? earlier_.data() : v;
    const auto dampRuns = [&](const SpringBlock& block) {
        for (int i = block.firstRun; i < block.lastRun; ++i) {
            const auto r = static_cast<std::size_t>(isForwards ? i : block.lastRun - 1 - (i - block.firstRun));
            const SpringRun<Real>& run = network.runs[r];
            if (isBetween_[r] != isBetween) continue;
            run_({run.count, run.offset, stride, x + run.a, felt + run.a, v + run.a, w + run.a, g_.data() + firstOf_[r],
                  isForwards, isStiff_[r]});
        }
    };
    const auto dampSingles = [&](const SpringBlock& block) {
        if (block.firstSingle == block.lastSingle || isBetween) return;
        const SpringSingles<Real>& s = network.singles;
        const int at = block.firstSingle;
        list_({block.lastSingle - at, stride, x, v, w, s.a.data() + at, s.b.data() + at,
               g_.data() + firstSingle_ + static_cast<std::size_t>(at), isForwards});
    };
    const int chunks = static_cast<int>(network.chunks.size());
    for (int turn = 0; turn < 2; ++turn) {
        const int parity = isForwards ? turn : 1 - turn;
        core::parallelFor((chunks + 1 - parity) / 2, [&](int number) {
            const SpringChunk& chunk = network.chunks[static_cast<std::size_t>(2 * number + parity)];
            for (int i = chunk.firstBlock; i < chunk.lastBlock; ++i) {
                const int at = isForwards ? i : chunk.lastBlock - 1 - (i - chunk.firstBlock);
                const SpringBlock& block = network.blocks[static_cast<std::size_t>(at)];
                if (!isForwards) dampSingles(block);
                dampRuns(block);
                if (isForwards) dampSingles(block);
            }
        });
    }
}

template class DashpotSweep<float>;
template class DashpotSweep<double>;

}  // namespace taut::mechanics
