#include "taut/mechanics/dashpot_sweep.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "taut/core/private/instruction_set.h"
#include "taut/core/private/parallel.h"

namespace taut::mechanics {

TAUT_KERNELS(template <class Real> void dampRun(const DashpotRun<Real>&);
             template <class Real> void dampList(const DashpotList<Real>&);)

namespace {

constexpr int chainOffset = 1;  // offset of a run whose dashpots form a chain: a rope, a row of a sheet

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
        each(network.stiffness[run.table + i], run.mixed < 0 ? run.tau : network.mixed[run.mixed + run.count + i],
             w[run.a + i], w[run.a + i + run.offset]);
}

}  // namespace

template <class Real>
DashpotSweep<Real>::DashpotSweep() : run_(TAUT_IN_USE(dampRun<Real>)), list_(TAUT_IN_USE(dampList<Real>)) {}

template <class Real>
void DashpotSweep<Real>::prepare(const SpringNetwork<Real>& network, const Real* w, double h) {
    constexpr double strong = 0.5;  // y of half a step
    h_ = h;
    g_.clear();
    firstOf_.clear();
    isStiff_.clear();
    isBetween_.clear();
    hasBetween_ = false;
    // The runs: g of half a step for each dashpot, and whether the run is stiff.
    const double step = 0.5 * h;
    const auto add = [&](Real k, Real tau, Real wa, Real wb) {
        g_.push_back(static_cast<Real>(step * static_cast<double>(k) * static_cast<double>(tau) /
                                       (1.0 + step * pairRate(k, tau, wa, wb))));
    };
    if (chains_.empty()) findChains(network);
    const auto mostOf = [&](const SpringRun<Real>& run) {
        double most = 0;
        forEachOf(network, run, w,
                  [&](Real k, Real tau, Real wa, Real wb) { most = std::max(most, pairRate(k, tau, wa, wb)); });
        return most;
    };
    for (const SpringRun<Real>& run : network.runs) {
        isStiff_.push_back(0.5 * h * mostOf(run) > strong);
        isBetween_.push_back(false);
        firstOf_.push_back(static_cast<int>(g_.size()));
        forEachOf(network, run, w, add);
    }
    // The chains with a stiff run: g of a whole step for each dashpot. between() damps them, so the sweeps do not.
    chainG_.clear();
    for (Chain& chain : chains_) {
        chain.isBetween = chain.isAlone &&
                          std::any_of(chain.runs.begin(), chain.runs.end(), [&](std::size_t r) { return isStiff_[r]; });
        if (!chain.isBetween) continue;
        hasBetween_ = true;
        chain.firstG = chainG_.size();
        chainG_.resize(chain.firstG + static_cast<std::size_t>(chain.count));
        for (const std::size_t r : chain.runs) {
            isBetween_[r] = true;
            const SpringRun<Real>& run = network.runs[r];
            int at = run.a - chain.a;
            forEachOf(network, run, w, [&](Real k, Real tau, Real wa, Real wb) {
                // A run's padding may lie before or after the chain.
                if (at >= 0 && at < chain.count && k > Real(0))
                    chainG_[chain.firstG + static_cast<std::size_t>(at)] = static_cast<Real>(
                        h * static_cast<double>(k) * static_cast<double>(tau) / (1.0 + h * pairRate(k, tau, wa, wb)));
                ++at;
            });
        }
    }
    // The single dashpots.
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
    if (chains_.empty()) findChains(network);
    std::vector<bool> isInChain(network.runs.size(), false);
    for (const Chain& chain : chains_)
        for (const std::size_t r : chain.runs) isInChain[r] = chain.isAlone;
    for (std::size_t r = 0; r < network.runs.size(); ++r)
        if (!isInChain[r]) forEachOf(network, network.runs[r], w, look);
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
void DashpotSweep<Real>::between(const Points& points) {
    if (!hasBetween_) return;
    for (std::size_t i = 0; i < earlier_.size(); ++i) earlier_[i] = Real(0.5) * (earlier_[i] + points.v[i]);
    for (const Chain& chain : chains_)
        if (chain.isBetween) dampChain(chain, points);
}

// Finds the chains: runs of neighbours without their padding, joined end to end.
template <class Real>
void DashpotSweep<Real>::findChains(const SpringNetwork<Real>& network) {
    std::vector<Chain> found;
    for (std::size_t r = 0; r < network.runs.size(); ++r) {
        const SpringRun<Real>& run = network.runs[r];
        if (run.offset != chainOffset) continue;
        const Real* k = network.stiffness.data() + run.table;
        int first = 0, last = run.count;
        while (first < last && !(k[first] > Real(0))) ++first;
        while (last > first && !(k[last - 1] > Real(0))) --last;
        if (first == last) continue;
        Chain& chain = found.emplace_back();
        chain.a = run.a + first;
        chain.count = last - first;
        chain.runs = {r};
    }
    std::stable_sort(found.begin(), found.end(), [](const Chain& x, const Chain& y) { return x.a < y.a; });
    for (Chain& next : found) {
        Chain* last = chains_.empty() ? nullptr : &chains_.back();
        if (last != nullptr && next.a <= last->a + last->count) {
            last->isAlone = last->isAlone && next.a == last->a + last->count;
            last->count = std::max(last->count, next.a + next.count - last->a);
            last->runs.insert(last->runs.end(), next.runs.begin(), next.runs.end());
        } else {
            chains_.push_back(std::move(next));
        }
    }
}

// Solves for all impulses p of the chain at once, by elimination:
//   p_i = g_i (m_b - m_a)·n + ½ g_i [w_a (n_{i-1}·n_i) p_{i-1} + w_b (n_i·n_{i+1}) p_{i+1}],
// m the mean of the velocities before the kick and after it.
template <class Real>
void DashpotSweep<Real>::dampChain(const Chain& chain, const Points& points) {
    const auto count = static_cast<std::size_t>(chain.count);
    for (auto* list : {&p_, &up_, &down_, &pivot_}) list->resize(count);
    const std::ptrdiff_t stride = points.stride;
    const auto at = [&](const Real* planes, std::size_t i) {
        const Real* from = planes + chain.a + static_cast<std::ptrdiff_t>(i);
        return glm::dvec3(from[0], from[stride], from[2 * stride]);
    };
    const auto way = [&](std::size_t i) {
        const glm::dvec3 d = at(points.x, i + 1) - at(points.x, i);
        const double square = glm::dot(d, d);
        return square > 0 ? d / std::sqrt(square) : glm::dvec3(0.0);
    };
    // The equations: right-hand sides p_, couplings down_ and up_.
    const Real* w = points.w + chain.a;
    const Real* g = chainG_.data() + chain.firstG;
    glm::dvec3 before(0.0), n = way(0);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 next = i + 1 < count ? way(i + 1) : glm::dvec3(0.0);
        const auto own = static_cast<double>(g[i]);
        p_[i] = own * glm::dot(at(earlier_.data(), i + 1) - at(earlier_.data(), i), n);
        down_[i] = 0.5 * own * static_cast<double>(w[i]) * glm::dot(before, n);
        up_[i] = 0.5 * own * static_cast<double>(w[i + 1]) * glm::dot(n, next);
        before = n;
        n = next;
    }
    // Elimination of the tridiagonal system.
    pivot_[0] = 1.0;
    for (std::size_t i = 1; i < count; ++i) {
        const double factor = down_[i] / pivot_[i - 1];
        pivot_[i] = 1.0 - factor * up_[i - 1];
        p_[i] += factor * p_[i - 1];
    }
    p_[count - 1] /= pivot_[count - 1];
    for (std::size_t i = count - 1; i-- > 0;) p_[i] = (p_[i] + up_[i] * p_[i + 1]) / pivot_[i];
    // The impulses change the velocities.
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 impulse = p_[i] * way(i);
        for (int axis = 0; axis < 3; ++axis) {
            Real* v = points.v + chain.a + static_cast<std::ptrdiff_t>(i) + axis * stride;
            v[0] = static_cast<Real>(static_cast<double>(v[0]) + static_cast<double>(w[i]) * impulse[axis]);
            v[1] = static_cast<Real>(static_cast<double>(v[1]) - static_cast<double>(w[i + 1]) * impulse[axis]);
        }
    }
}

template <class Real>
void DashpotSweep<Real>::after(const SpringNetwork<Real>& network, const Points& points) {
    damp(network, points, Part::after);
}

// A chunk touches points of the next one. So every other chunk runs in parallel, then the rest.
template <class Real>
void DashpotSweep<Real>::damp(const SpringNetwork<Real>& network, const Points& points, Part part) {
    const int stride = points.stride;
    const Real *w = points.w, *x = points.x;
    Real* v = points.v;
    const bool isForwards = part == Part::before;
    const auto dampRuns = [&](const SpringBlock& block) {
        for (int i = block.firstRun; i < block.lastRun; ++i) {
            const auto r = static_cast<std::size_t>(isForwards ? i : block.lastRun - 1 - (i - block.firstRun));
            const SpringRun<Real>& run = network.runs[r];
            if (isBetween_[r]) continue;
            run_({run.count, run.offset, stride, x + run.a, v + run.a, w + run.a, g_.data() + firstOf_[r], isForwards,
                  isStiff_[r]});
        }
    };
    const auto dampSingles = [&](const SpringBlock& block) {
        if (block.firstSingle == block.lastSingle) return;
        const SpringSingles<Real>& s = network.singles;
        const int at = block.firstSingle;
        list_({block.lastSingle - at, stride, x, v, w, s.a.data() + at, s.b.data() + at,
               g_.data() + firstSingle_ + static_cast<std::size_t>(at), isForwards});
    };
    const int chunks = static_cast<int>(network.chunks.size());
    for (int turn = 0; turn < 2; ++turn) {
        const int parity = isForwards ? turn : 1 - turn;
        core::parallelFor((chunks + 1 - parity) / 2, [&](int number) {
            const SpringChunk& chunk = network.chunks[2 * number + parity];
            for (int i = chunk.firstBlock; i < chunk.lastBlock; ++i) {
                const int at = isForwards ? i : chunk.lastBlock - 1 - (i - chunk.firstBlock);
                const SpringBlock& block = network.blocks[at];
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
