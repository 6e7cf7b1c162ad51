#include "taut/bodies/private/seam_pairing.h"

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

std::vector<int> lineAlong(std::span<const Link> links, std::span<const int> points) {
    std::map<int, std::vector<int>> next;
    for (const int i : points) next[i];
    for (const auto& [a, b] : links)
        if (next.contains(a) && next.contains(b)) {
            next[a].push_back(b);
            next[b].push_back(a);
        }
    const auto end = std::find_if(next.begin(), next.end(), [](const auto& own) { return own.second.size() == 1; });
    if (end == next.end()) return {};
    std::vector<int> line{end->first};
    for (int before = -1, here = end->first;;) {
        const std::vector<int>& ways = next.at(here);
        if (ways.size() > 2) return {};
        const auto on = std::find_if(ways.begin(), ways.end(), [&](int i) { return i != before; });
        if (on == ways.end()) break;
        before = here;
        here = *on;
        line.push_back(here);
    }
    return line.size() == next.size() ? line : std::vector<int>{};
}

// (places) the share of the length up to each, from 0 to 1.
std::vector<double> sharesOf(std::span<const dvec3> line) {
    std::vector<double> shares{0.0};
    for (std::size_t i = 1; i < line.size(); ++i) {
        const dvec3 d = line[i] - line[i - 1];
        shares.push_back(shares.back() + std::sqrt(glm::dot(d, d)));
    }
    const double length = shares.back();
    for (double& share : shares) share = length > 0 ? share / length : 0.0;
    return shares;
}

int nearest(std::span<const double> shares, double share) {
    const auto isNearer = [&](double a, double b) { return std::abs(a - share) < std::abs(b - share); };
    return static_cast<int>(std::min_element(shares.begin(), shares.end(), isNearer) - shares.begin());
}

// Expects that `many` has no fewer places.
std::vector<std::pair<int, int>> pairs(std::span<const double> many, std::span<const double> few) {
    std::vector<std::pair<int, int>> all;
    std::vector<bool> isTaken(few.size(), false);
    for (std::size_t i = 0; i < many.size(); ++i) {
        all.emplace_back(static_cast<int>(i), nearest(few, many[i]));
        isTaken[static_cast<std::size_t>(all.back().second)] = true;
    }
    for (std::size_t j = 0; j < few.size(); ++j)
        if (!isTaken[j]) all.emplace_back(nearest(many, few[j]), static_cast<int>(j));
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace

std::vector<int> lineOf(const mechanics::Model& model, std::span<const int> points) {
    const std::vector<int> border = lineAlong(bordersOf(model), points);
    return !border.empty() ? border : lineAlong(threadsOf(model), points);
}

std::vector<std::pair<int, int>> pairedByLength(std::span<const dvec3> a, std::span<const dvec3> b) {
    const auto sewn = [&](const std::vector<dvec3>& other) {
        const bool isMore = a.size() >= other.size();
        auto all = isMore ? pairs(sharesOf(a), sharesOf(other)) : pairs(sharesOf(other), sharesOf(a));
        double squares = 0;
        for (auto& [i, j] : all) {
            if (!isMore) std::swap(i, j);
            const dvec3 d = other[static_cast<std::size_t>(j)] - a[static_cast<std::size_t>(i)];
            squares += glm::dot(d, d);
        }
        return std::pair(squares, all);
    };
    auto [ahead, onward] = sewn({b.begin(), b.end()});
    auto [behind, backward] = sewn({b.rbegin(), b.rend()});
    if (ahead <= behind) return onward;
    for (auto& [i, j] : backward) j = static_cast<int>(b.size()) - 1 - j;
    return backward;
}

}  // namespace taut::world
