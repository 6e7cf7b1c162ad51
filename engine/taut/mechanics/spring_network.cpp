#include "taut/mechanics/spring_network.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "taut/core/error.h"

namespace taut::mechanics {
namespace {

constexpr int blockPoints = 256;   // so that a block's springs and points fit the first-level cache
constexpr int chunkPoints = 8192;  // at least, so that a thread has enough work
constexpr int mostChunks = 8;      // each has its own window, which costs memory traffic
constexpr int shortestRun = 8;     // for fewer springs, single springs are as fast
constexpr int longestBridge = 3;   // missing springs that a run steps over or is padded with, at stiffness zero

// Springs of one block with the same key can make a run.
using Key = std::tuple<int, double, double>;  // offset, rest length, damping time

struct Sorted {
    Key key;
    int a;
    double k;
    int spring;
    bool operator<(const Sorted& other) const {
        return std::tie(key, a, k, spring) < std::tie(other.key, other.a, other.k, other.spring);
    }
};

template <class Real>
class Builder {
  public:
    Builder(SpringNetwork<Real>& network, int points, std::span<const PointRange> bodies,
            std::span<const Spring> springs)
        : network_(network), points_(points) {
        cutBlocks(bodies);
        shareOut(springs);
        cutChunks();
        for (std::size_t i = 0; i < network_.blocks.size(); ++i) fill(network_.blocks[i], sorted_[i]);
        network_.order.insert(network_.order.end(), singles_.begin(), singles_.end());
    }

  private:
    void cutBlocks(std::span<const PointRange> bodies) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const int first = bodies[i].firstPoint;
            const int last = i + 1 < bodies.size() ? bodies[i + 1].firstPoint : points_;
            const int row = bodies[i].row;
            const int size = row > 0 ? row * std::max(1, blockPoints / row) : blockPoints;
            for (int at = first; at < last; at += size) {
                SpringBlock block{};
                block.firstPoint = at;
                block.lastPoint = block.reach = std::min(at + size, last);
                network_.blocks.push_back(block);
            }
        }
    }

    void shareOut(std::span<const Spring> springs) {
        std::vector<int> blockOf(points_);
        for (std::size_t i = 0; i < network_.blocks.size(); ++i)
            for (int p = network_.blocks[i].firstPoint; p < network_.blocks[i].lastPoint; ++p)
                blockOf[p] = static_cast<int>(i);
        sorted_.resize(network_.blocks.size());
        for (std::size_t i = 0; i < springs.size(); ++i) {
            const Spring& s = springs[i];
            TAUT_EXPECTS(s.a != s.b && s.a >= 0 && s.b >= 0 && s.a < points_ && s.b < points_);
            const int a = std::min(s.a, s.b), b = std::max(s.a, s.b);
            const auto block = static_cast<std::size_t>(blockOf[a]);
            sorted_[block].push_back({{b - a, s.restLength, s.dampingTime}, a, s.stiffness, static_cast<int>(i)});
            network_.blocks[block].reach = std::max(network_.blocks[block].reach, b + 1);
        }
        for (auto& list : sorted_) std::sort(list.begin(), list.end());
        network_.springCount = static_cast<int>(springs.size());
    }

    // A chunk takes blocks until it is large enough and holds all points that the chunk before spills onto.
    void cutChunks() {
        const int enough = std::max(chunkPoints, points_ / mostChunks);
        int incoming = 0;  // one past the last point that an earlier chunk touches
        SpringChunk chunk{};
        int reach = 0;
        const int count = static_cast<int>(network_.blocks.size());
        for (int i = 0; i < count; ++i) {
            const SpringBlock& block = network_.blocks[i];
            if (i == chunk.firstBlock) chunk.firstPoint = block.firstPoint;
            reach = std::max(reach, block.reach);
            const bool full = block.lastPoint - chunk.firstPoint >= enough && block.lastPoint >= incoming;
            if (!full && i + 1 < count) continue;
            chunk.lastBlock = i + 1;
            chunk.lastPoint = block.lastPoint;
            chunk.spill = std::max(0, reach - block.lastPoint);
            network_.chunks.push_back(chunk);
            incoming = reach;
            chunk = SpringChunk{};
            chunk.firstBlock = i + 1;
            reach = 0;
        }
    }

    // Springs from … to - 1 of a block's list. They make a run over the points a = first … last - 1.
    struct Stretch {
        std::size_t from, to;
        int offset, first, last;
    };

    void fill(SpringBlock& block, const std::vector<Sorted>& list) {
        block.firstRun = static_cast<int>(network_.runs.size());
        block.firstSingle = network_.singles.size();
        std::vector<Stretch> stretches;
        for (std::size_t from = 0; from < list.size();) {
            const Stretch stretch = longestFrom(list, from);
            from = stretch.to;
            if (stretch.to - stretch.from >= shortestRun)
                stretches.push_back(stretch);
            else
                for (std::size_t i = stretch.from; i < stretch.to; ++i) addSingle(list[i]);
        }
        while (!stretches.empty()) addBundle(list, takeBundle(stretches, block.reach));
        block.lastRun = static_cast<int>(network_.runs.size());
        block.lastSingle = network_.singles.size();
    }

    static Stretch longestFrom(const std::vector<Sorted>& list, std::size_t from) {
        std::size_t to = from + 1;
        while (to < list.size() && list[to].key == list[from].key && list[to].a > list[to - 1].a &&
               list[to].a - list[to - 1].a - 1 <= longestBridge)
            ++to;
        return {from, to, std::get<0>(list[from].key), list[from].a, list[to - 1].a + 1};
    }

    // Takes out the first stretch, and the others that begin and end near it. Pads all of them to the same points. It
    // leaves out stretches whose padding would reach beyond the block's springs.
    static std::vector<Stretch> takeBundle(std::vector<Stretch>& stretches, int reach) {
        std::vector<Stretch> bundle, others;
        Stretch all = stretches.front();
        for (const Stretch& s : stretches) {
            const int first = std::min(all.first, s.first), last = std::max(all.last, s.last);
            const int offset = std::max(all.offset, s.offset);
            const bool isNear = std::abs(s.first - stretches.front().first) <= longestBridge &&
                                std::abs(s.last - stretches.front().last) <= longestBridge;
            if (!isNear || last - 1 + offset >= reach || bundle.size() == mostTogether) {
                others.push_back(s);
                continue;
            }
            bundle.push_back(s);
            all = {0, 0, offset, first, last};
        }
        for (Stretch& s : bundle) {
            s.first = all.first;
            s.last = all.last;
        }
        stretches = std::move(others);
        return bundle;
    }

    void addBundle(const std::vector<Sorted>& list, const std::vector<Stretch>& bundle) {
        for (const Stretch& stretch : bundle) {
            SpringRun<Real> run{};
            run.a = stretch.first;
            run.offset = stretch.offset;
            run.count = stretch.last - stretch.first;
            run.together = &stretch == bundle.data() ? static_cast<int>(bundle.size()) : 0;
            network_.runs.push_back(run);
            const std::size_t begin = network_.order.size();
            network_.order.resize(begin + static_cast<std::size_t>(run.count), -1);
            for (std::size_t i = stretch.from; i < stretch.to; ++i)
                network_.order[begin + static_cast<std::size_t>(list[i].a - run.a)] = list[i].spring;
        }
    }

    void addSingle(const Sorted& s) {
        network_.singles.a.push_back(s.a);
        network_.singles.b.push_back(s.a + std::get<0>(s.key));
        singles_.push_back(s.spring);
    }

    SpringNetwork<Real>& network_;
    int points_;
    std::vector<std::vector<Sorted>> sorted_;  // (blocks)
    std::vector<int> singles_;                 // numbers of the single springs
};

}  // namespace

template <class Real>
SpringNetwork<Real>::SpringNetwork(int points, std::span<const Body> bodies, std::span<const Spring> springs) {
    Builder<Real>(*this, points, bodies, springs);
    places.assign(springs.size(), -1);
    for (std::size_t i = 0; i < order.size(); ++i)
        if (order[i] >= 0) places[order[i]] = static_cast<int>(i);
    firstPlaces.push_back(0);
    for (const SpringRun<Real>& run : runs) firstPlaces.push_back(firstPlaces.back() + run.count);
    setSprings(springs);
}

template <class Real>
void SpringNetwork<Real>::setSprings(std::span<const Spring> springs) {
    TAUT_EXPECTS(static_cast<int>(springs.size()) == springCount);
    largestTau = 0;
    isTauUniform = true;
    for (const Spring& s : springs) {
        largestTau = std::max(largestTau, static_cast<Real>(s.dampingTime));
        isTauUniform = isTauUniform && s.dampingTime == springs.front().dampingTime;
    }
    // The runs. Runs with the same stiffnesses share a table. Mixed runs store a length and a damping time each spring.
    stiffness.clear();
    mixed.clear();
    isOwn.assign(runs.size(), false);
    std::map<std::vector<Real>, int> tables;
    std::vector<Real> k, lengths, taus;
    const int* next = order.data();
    for (SpringRun<Real>& run : runs) {
        for (std::vector<Real>* table : {&k, &lengths, &taus}) table->assign(run.count, Real(0));
        bool isFirst = true;
        bool isMixed = false;
        for (std::size_t i = 0; i < k.size(); ++i, ++next) {
            if (*next < 0) continue;
            const Spring& s = springs[*next];
            k[i] = static_cast<Real>(s.stiffness);
            lengths[i] = static_cast<Real>(s.restLength);
            taus[i] = static_cast<Real>(s.dampingTime);
            if (isFirst) {
                isFirst = false;
                run.restLength = lengths[i];
                run.tau = taus[i];
            }
            isMixed = isMixed || lengths[i] != run.restLength || taus[i] != run.tau;
        }
        const auto [entry, isNew] = tables.try_emplace(k, static_cast<int>(stiffness.size()));
        if (isNew) stiffness.insert(stiffness.end(), k.begin(), k.end());
        run.table = entry->second;
        run.mixed = isMixed ? static_cast<int>(mixed.size()) : -1;
        if (!isMixed) continue;
        mixed.insert(mixed.end(), lengths.begin(), lengths.end());
        mixed.insert(mixed.end(), taus.begin(), taus.end());
    }
    // The single springs.
    for (std::vector<Real>* table : {&singles.k, &singles.restLength, &singles.tau}) table->resize(singles.a.size());
    for (std::size_t i = 0; i < singles.a.size(); ++i, ++next) {
        const Spring& s = springs[*next];
        singles.k[i] = static_cast<Real>(s.stiffness);
        singles.restLength[i] = static_cast<Real>(s.restLength);
        singles.tau[i] = static_cast<Real>(s.dampingTime);
    }
}

template <class Real>
bool SpringNetwork<Real>::setSpring(int spring, const Spring& now) {
    const int place = placeOf(spring);
    const auto k = static_cast<Real>(now.stiffness), restLength = static_cast<Real>(now.restLength);
    if (place >= placeOfSingles()) {
        const auto i = static_cast<std::size_t>(place - placeOfSingles());
        singles.restLength[i] = restLength;
        return std::exchange(singles.k[i], k) != k;
    }
    const auto r = static_cast<std::size_t>(std::upper_bound(firstPlaces.begin(), firstPlaces.end(), place) -
                                            firstPlaces.begin() - 1);
    SpringRun<Real>& run = runs[r];
    const int i = place - firstPlaces[r];
    const bool isOther = stiffness[run.table + i] != k;
    if (isOther) {
        if (!isOwn[r]) {
            const auto from = static_cast<std::size_t>(run.table);
            run.table = static_cast<int>(stiffness.size());
            stiffness.resize(stiffness.size() + static_cast<std::size_t>(run.count));
            std::copy_n(stiffness.begin() + static_cast<std::ptrdiff_t>(from), run.count,
                        stiffness.begin() + run.table);
            isOwn[r] = true;
        }
        stiffness[run.table + i] = k;
    }
    if (run.mixed < 0 && run.restLength == restLength) return isOther;
    if (run.mixed < 0) {
        run.mixed = static_cast<int>(mixed.size());
        mixed.insert(mixed.end(), static_cast<std::size_t>(run.count), run.restLength);
        mixed.insert(mixed.end(), static_cast<std::size_t>(run.count), run.tau);
    }
    mixed[run.mixed + i] = restLength;
    return isOther;
}

template <class Real>
void SpringNetwork<Real>::takeUndamped(const SpringNetwork& damped) {
    *this = damped;
    largestTau = 0;
    isTauUniform = true;
    for (SpringRun<Real>& run : runs) {
        run.tau = 0;
        if (run.mixed >= 0) std::fill_n(mixed.begin() + run.mixed + run.count, run.count, Real(0));
    }
    std::fill(singles.tau.begin(), singles.tau.end(), Real(0));
}

template struct SpringNetwork<float>;
template struct SpringNetwork<double>;

}  // namespace taut::mechanics
