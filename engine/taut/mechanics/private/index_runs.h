// Sorts the elements of a mesh (triangles, tetrahedra) into runs and loose elements. It knows no forces.
//
// Builders number points row by row. So the triangles of a row follow each other with all corners one point further,
// and so do its tetrahedra of one kind. Lanes without an element join rows and layers over small gaps (a row's last
// point starts no cell); kernels give these lanes no weight. The order depends only on the list of elements.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "taut/mechanics/private/kernel_parts.h"

namespace taut::mechanics {

template <int Corners>
class IndexRuns {
  public:
    using Element = std::array<int, Corners>;  // points

    IndexRuns() = default;
    explicit IndexRuns(std::span<const Element> elements) {
        std::vector<Chain> chains = chainsOf(elements);
        std::vector<int> left;
        for (const Chain& chain : chains) {
            if (chain.sources.size() < shortestRun) {
                for (int s : chain.sources)
                    if (s >= 0) left.push_back(s);
                continue;
            }
            CornerRun<Corners> run{};
            for (std::size_t c = 0; c < Corners; ++c) run.first[c] = chain.first[c];
            run.count = static_cast<int>(chain.sources.size());
            run.lane = static_cast<int>(sources_.size());
            runs_.push_back(run);
            sources_.insert(sources_.end(), chain.sources.begin(), chain.sources.end());
        }
        looseLane_ = static_cast<int>(sources_.size());
        for (int s : left)
            loosePoints_.insert(loosePoints_.end(), elements[std::size_t(s)].begin(), elements[std::size_t(s)].end());
        std::sort(loosePoints_.begin(), loosePoints_.end());
        loosePoints_.erase(std::unique(loosePoints_.begin(), loosePoints_.end()), loosePoints_.end());
        for (int s : left) {
            sources_.push_back(s);
            for (std::size_t c = 0; c < Corners; ++c) loose_[c].push_back(placeOf(elements[s][c]));
        }
    }

    // (lanes) The element of the list that a lane holds; -1: none.
    const std::vector<int>& sources() const { return sources_; }

    CornerLanes<Corners> lanes() const {
        CornerLanes<Corners> lanes{};
        lanes.runs = runs_.data();
        lanes.runCount = static_cast<int>(runs_.size());
        lanes.loosePoints = loosePoints_.data();
        lanes.loosePointCount = static_cast<int>(loosePoints_.size());
        for (std::size_t c = 0; c < Corners; ++c) lanes.loose[c] = loose_[c].data();
        lanes.looseCount = static_cast<int>(loose_[0].size());
        lanes.looseLane = looseLane_;
        return lanes;
    }

  private:
    static constexpr int widestGap = 8;             // lanes; and at most a third of the elements before it, or 1
    static constexpr std::size_t shortestRun = 16;  // lanes; gathering a shorter run costs no more

    struct Chain {
        Element first{};
        std::vector<int> sources;
        int elements = 0;
        int gapAllowed() const { return std::max(1, elements / 3); }
    };

    static Element moved(Element element, int by) {
        for (int& point : element) point += by;
        return element;
    }

    static std::vector<Chain> chainsOf(std::span<const Element> elements) {
        std::vector<Chain> chains;
        std::map<Element, std::size_t> chainThatExpects;
        for (std::size_t e = 0; e < elements.size(); ++e) {
            std::size_t chain = chains.size();
            for (int gap = 0; gap <= widestGap && chain == chains.size(); ++gap) {
                const auto found = chainThatExpects.find(moved(elements[e], -gap));
                if (found == chainThatExpects.end() || gap > chains[found->second].gapAllowed()) continue;
                chain = found->second;
                chainThatExpects.erase(found);
                chains[chain].sources.insert(chains[chain].sources.end(), static_cast<std::size_t>(gap), -1);
            }
            if (chain == chains.size()) chains.push_back({elements[e], {}});
            chains[chain].sources.push_back(static_cast<int>(e));
            ++chains[chain].elements;
            chainThatExpects.emplace(moved(elements[e], 1), chain);
        }
        return chains;
    }

    int placeOf(int loosePoint) const {
        return static_cast<int>(std::lower_bound(loosePoints_.begin(), loosePoints_.end(), loosePoint) -
                                loosePoints_.begin());
    }

    std::vector<CornerRun<Corners>> runs_;
    std::vector<int> loosePoints_;                 // ascending
    std::array<std::vector<int>, Corners> loose_;  // (corners)(loose elements)
    int looseLane_ = 0;
    std::vector<int> sources_;
};

}  // namespace taut::mechanics
