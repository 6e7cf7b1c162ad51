#include "taut/plan/private/seam_pairing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace taut::world {
namespace {

using Link = std::array<int, 2>;  // two points, the lower first

Link linkOf(int a, int b) {
    return {std::min(a, b), std::max(a, b)};
}

// Edges of one triangle only.
std::vector<Link> bordersOf(const mechanics::Model& model) {
    std::map<Link, int> count;
    for (const std::array<int, 3>& t : model.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++count[linkOf(t[k], t[(k + 1) % 3])];
    std::vector<Link> borders;
    for (const auto& [link, triangles] : count)
        if (triangles == 1) borders.push_back(link);
    return borders;
}

std::vector<Link> threadsOf(const mechanics::Model& model) {
    std::vector<Link> threads;
    for (const mechanics::Spring& spring : model.springs)
        if (spring.kind == mechanics::SpringKind::structural) threads.push_back(linkOf(spring.a, spring.b));
    return threads;
}

Line lineAlong(std::span<const Link> links, std::span<const int> points) {
    std::map<int, std::vector<int>> next;
    for (const int i : points) next[i];
    for (const auto& [a, b] : links)
        if (next.contains(a) && next.contains(b)) {
            next[a].push_back(b);
            next[b].push_back(a);
        }
    const auto end = std::find_if(next.begin(), next.end(), [](const auto& own) { return own.second.size() == 1; });
    Line line{{}, end == next.end()};
    if (next.empty()) return {};
    const int first = line.isClosed ? next.begin()->first : end->first;
    for (int before = -1, here = first;;) {
        line.points.push_back(here);
        const std::vector<int>& ways = next.at(here);
        if (ways.size() > 2) return {};
        const auto on = std::find_if(ways.begin(), ways.end(), [&](int i) { return i != before; });
        if (on == ways.end() || *on == first) break;
        before = here;
        here = *on;
    }
    const bool isOne = line.points.size() == next.size() && line.points.size() > (line.isClosed ? 2u : 1u);
    return isOne ? line : Line{};
}

// An edge on its way from a start, which a closed one reaches again.
struct Way {
    std::vector<int> order;      // of its places
    std::vector<double> shares;  // of the length up to each, from 0 to 1
};

Way wayAlong(const SewnEdge& edge, std::size_t start, bool isBackward) {
    const std::size_t count = edge.places.size();
    Way way{{}, {0.0}};
    for (std::size_t k = 0; k < count + (edge.isClosed() ? 1 : 0); ++k) {
        const std::size_t i = (start + k) % count;
        way.order.push_back(static_cast<int>(isBackward ? count - 1 - i : i));
    }
    for (std::size_t k = 1; k < way.order.size(); ++k) {
        const auto step = static_cast<std::size_t>(way.order[isBackward ? k : k - 1]);
        way.shares.push_back(way.shares.back() + edge.steps[step]);
    }
    const double length = way.shares.back();
    for (double& share : way.shares) share = length > 0 ? share / length : 0.0;
    return way;
}

// Of the way the place with the nearest share; of several with that share, as where two edges meet, the one that lies
// nearest to `place`. Expects that shares do not fall.
int nearest(const Way& way, const SewnEdge& edge, double share, const dvec3& place) {
    const std::vector<double>& shares = way.shares;
    const auto after = std::lower_bound(shares.begin(), shares.end(), share);
    const bool isBefore = after != shares.begin() && (after == shares.end() || share - after[-1] <= *after - share);
    const auto [first, last] = std::equal_range(shares.begin(), shares.end(), isBefore ? after[-1] : *after);
    const auto squareAt = [&](std::ptrdiff_t k) {
        const int i = way.order[k];
        const dvec3 d = edge.places[i] - place;
        return glm::dot(d, d);
    };
    std::ptrdiff_t best = first - shares.begin();
    for (std::ptrdiff_t k = best + 1; k < last - shares.begin(); ++k)
        if (squareAt(k) < squareAt(best)) best = k;
    return static_cast<int>(best);
}

// The spot at a share, in numbers of the way: the nearest place if it is as good as there.
Spot spotAt(const Way& way, const SewnEdge& edge, double share, const dvec3& place) {
    constexpr double asGood = 0.01;  // of the step between two places
    const auto at = [&](std::ptrdiff_t k) { return way.shares[k]; };
    const int best = nearest(way, edge, share, place);
    const std::ptrdiff_t after = std::lower_bound(way.shares.begin(), way.shares.end(), share) - way.shares.begin();
    if (after == 0 || after == std::ssize(way.shares)) return best;
    const double step = at(after) - at(after - 1);
    if (std::abs(share - at(best)) <= asGood * step) return best;
    const double weight = (share - at(after - 1)) / step;
    return {{static_cast<int>(after) - 1, 1.0 - weight}, {static_cast<int>(after), weight}};
}

// (places of the way) Those with the same share, as where two edges meet, have one number.
std::vector<int> meetings(const Way& way) {
    std::vector<int> numbers{0};
    for (std::size_t k = 1; k < way.shares.size(); ++k)
        numbers.push_back(numbers.back() + (way.shares[k] > way.shares[k - 1] ? 1 : 0));
    return numbers;
}

// Expects that `many` has no fewer places.
std::vector<SewnPair> pairs(const Way& many, const SewnEdge& manyEdge, const Way& few, const SewnEdge& fewEdge) {
    const auto placeOf = [](const Way& way, const SewnEdge& edge, std::size_t k) { return edge.places[way.order[k]]; };
    const std::vector<int> ofMany = meetings(many), ofFew = meetings(few);
    bool isEven = ofMany.back() == ofFew.back();
    for (std::size_t i = 0; i < many.shares.size(); ++i)
        isEven = isEven && ofFew[nearest(few, fewEdge, many.shares[i], placeOf(many, manyEdge, i))] == ofMany[i];
    const auto partner = [&](const Way& way, const SewnEdge& edge, double share, const dvec3& place) -> Spot {
        return isEven ? nearest(way, edge, share, place) : spotAt(way, edge, share, place);
    };
    std::vector<SewnPair> all;
    std::vector<bool> isTaken(few.shares.size(), false);
    for (std::size_t i = 0; i < many.shares.size(); ++i) {
        all.push_back({static_cast<int>(i), partner(few, fewEdge, many.shares[i], placeOf(many, manyEdge, i))});
        for (const Spot::Share& own : all.back().b.shares()) isTaken[own.point] = true;
    }
    for (std::size_t j = 0; j < few.shares.size(); ++j)
        if (!isTaken[j])
            all.push_back({partner(many, manyEdge, few.shares[j], placeOf(few, fewEdge, j)), static_cast<int>(j)});
    std::stable_sort(all.begin(), all.end(), [](const SewnPair& own, const SewnPair& other) {
        return std::pair(own.a.nearest(), own.b.nearest()) < std::pair(other.a.nearest(), other.b.nearest());
    });
    return all;
}

}  // namespace

Line lineOf(const mechanics::Model& model, std::span<const int> points) {
    const Line border = lineAlong(bordersOf(model), points);
    return !border.points.empty() ? border : lineAlong(threadsOf(model), points);
}

std::vector<std::vector<int>> borderNeighbours(const mechanics::Model& model) {
    std::vector<std::vector<int>> neighbours(model.positions.size());
    for (const auto& [a, b] : bordersOf(model)) {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    }
    return neighbours;
}

std::vector<SewnPair> pairedByLength(const SewnEdge& a, const SewnEdge& b) {
    const bool turnsFirst = a.isClosed() && (!b.isClosed() || a.places.size() > b.places.size());
    const SewnEdge &still = turnsFirst ? b : a, &turned = turnsFirst ? a : b;
    const Way own = wayAlong(still, 0, false);
    std::vector<SewnPair> best;
    double least = HUGE_VAL;
    for (const bool isBackward : {false, true})
        for (std::size_t start = 0; start < (turned.isClosed() ? turned.places.size() : 1); ++start) {
            const Way other = wayAlong(turned, start, isBackward);
            const bool isMore = still.places.size() >= turned.places.size();
            auto all = isMore ? pairs(own, still, other, turned) : pairs(other, turned, own, still);
            double squares = 0;
            for (auto& [i, j] : all) {
                if (!isMore) std::swap(i, j);
                i = i.renumbered([&](int k) { return own.order[k]; });
                j = j.renumbered([&](int k) { return other.order[k]; });
                const dvec3 d = j.of(turned.places) - i.of(still.places);
                squares += glm::dot(d, d);
            }
            if (!(squares < least)) continue;
            least = squares;
            best = all;
        }
    std::vector<SewnPair> once;  // the start of a closed edge is there twice
    for (SewnPair& pair : best) {
        if (turnsFirst) std::swap(pair.a, pair.b);
        if (std::find(once.begin(), once.end(), pair) == once.end()) once.push_back(pair);
    }
    return once;
}

}  // namespace taut::world
