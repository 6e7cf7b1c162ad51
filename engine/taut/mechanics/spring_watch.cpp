#include "taut/mechanics/private/spring_watch.h"

#include <algorithm>

#include "taut/core/error.h"
#include "taut/core/private/instruction_set.h"
#include "taut/core/private/parallel.h"

namespace taut::mechanics {

// Whether any spring is beyond its limits.
TAUT_KERNELS(template <class Real> bool isAnyBeyond(const WatchRun<Real>&);
             template <class Real> bool isAnyInListBeyond(const WatchList<Real>&);)

namespace {

template <class Real>
Real squareOf(double length) {
    return static_cast<Real>(length) * static_cast<Real>(length);
}

}  // namespace

template <class Real>
SpringWatch<Real>::SpringWatch() : run_(TAUT_IN_USE(isAnyBeyond<Real>)), list_(TAUT_IN_USE(isAnyInListBeyond<Real>)) {}

template <class Real>
void SpringWatch<Real>::set(const SpringNetwork<Real>& network, std::span<const LengthLimits> limits) {
    TAUT_EXPECTS(static_cast<int>(limits.size()) == network.springCount);
    const std::size_t places = network.order.size();
    most_.assign(places, std::numeric_limits<Real>::infinity());
    least_.clear();
    if (std::any_of(limits.begin(), limits.end(), [](const LengthLimits& l) { return l.least > 0; }))
        least_.assign(places, Real(0));
    const auto isWatched = [&](std::size_t first, std::size_t last) {
        return std::any_of(network.order.begin() + static_cast<std::ptrdiff_t>(first),
                           network.order.begin() + static_cast<std::ptrdiff_t>(last),
                           [&](int s) { return s >= 0 && limits[s].isAny(); });
    };
    for (std::size_t s = 0; s < limits.size(); ++s) change(network, static_cast<int>(s), limits[s]);
    parts_.clear();
    const auto firstSingle = static_cast<std::size_t>(network.placeOfSingles());
    for (const SpringChunk& chunk : network.chunks) {
        Part& part = parts_.emplace_back();
        const SpringBlock &first = network.blocks[chunk.firstBlock],
                          &last = network.blocks[static_cast<std::size_t>(chunk.lastBlock) - 1];
        for (int r = first.firstRun; r < last.lastRun; ++r) {
            const auto at = static_cast<std::size_t>(network.placeOfRun(r));
            if (isWatched(at, at + static_cast<std::size_t>(network.runs[r].count))) part.runs.push_back(r);
        }
        if (!isWatched(firstSingle + static_cast<std::size_t>(first.firstSingle),
                       firstSingle + static_cast<std::size_t>(last.lastSingle)))
            continue;
        part.firstSingle = first.firstSingle;
        part.lastSingle = last.lastSingle;
    }
}

template <class Real>
void SpringWatch<Real>::change(const SpringNetwork<Real>& network, int spring, const LengthLimits& limits) {
    const auto place = static_cast<std::size_t>(network.placeOf(spring));
    most_[place] = squareOf<Real>(limits.most);
    if (!least_.empty()) least_[place] = squareOf<Real>(limits.least);
}

template <class Real>
bool SpringWatch<Real>::isRunBeyond(const SpringNetwork<Real>& network, int r, int stride, const Real* x) const {
    const SpringRun<Real>& run = network.runs[r];
    const auto at = static_cast<std::size_t>(network.placeOfRun(r));
    return run_({run.count, run.offset, stride, x + run.a, leastFrom(at), most_.data() + at});
}

template <class Real>
bool SpringWatch<Real>::isAnyBeyond(const SpringNetwork<Real>& network, const Part& part, int stride,
                                    const Real* x) const {
    for (const int r : part.runs)
        if (isRunBeyond(network, r, stride, x)) return true;
    if (part.firstSingle == part.lastSingle) return false;
    const auto first = static_cast<std::size_t>(part.firstSingle),
               at = static_cast<std::size_t>(network.placeOfSingles()) + first;
    return list_({part.lastSingle - part.firstSingle, stride, x, network.singles.a.data() + first,
                  network.singles.b.data() + first, leastFrom(at), most_.data() + at});
}

template <class Real>
void SpringWatch<Real>::find(const SpringNetwork<Real>& network, int stride, const Real* x,
                             std::vector<int>& beyond) const {
    // Which parts have a spring beyond its limits: the cheap test, in parallel.
    isHit_.assign(parts_.size(), 0);
    const auto look = [&](int c) {
        const auto k = static_cast<std::size_t>(c);
        isHit_[k] = isAnyBeyond(network, parts_[k], stride, x) ? 1 : 0;
    };
    if (parts_.size() == 1)
        look(0);
    else
        core::parallelFor(static_cast<int>(parts_.size()), look);
    // Only those parts are searched spring by spring.
    const std::size_t before = beyond.size();
    const auto lookAt = [&](int place, int a, int b) {
        const auto p = static_cast<std::size_t>(place);
        Real square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const Real* plane = x + static_cast<std::ptrdiff_t>(axis) * stride;
            square += (plane[b] - plane[a]) * (plane[b] - plane[a]);
        }
        if (square > most_[p] || (!least_.empty() && square < least_[p])) beyond.push_back(network.order[p]);
    };
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        if (isHit_[k] == 0) continue;
        for (const int r : parts_[k].runs) {
            if (!isRunBeyond(network, r, stride, x)) continue;
            const SpringRun<Real>& run = network.runs[r];
            for (int i = 0; i < run.count; ++i) lookAt(network.placeOfRun(r) + i, run.a + i, run.a + i + run.offset);
        }
        for (int i = parts_[k].firstSingle; i < parts_[k].lastSingle; ++i)
            lookAt(network.placeOfSingles() + i, network.singles.a[i], network.singles.b[i]);
    }
    std::sort(beyond.begin() + static_cast<std::ptrdiff_t>(before), beyond.end());
}

template class SpringWatch<float>;
template class SpringWatch<double>;

}  // namespace taut::mechanics
