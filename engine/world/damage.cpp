#include "taut/world/damage.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

namespace taut::world {
namespace {

Damage::Edge edgeOf(int a, int b) {
    return {std::min(a, b), std::max(a, b)};
}

// Whether the edges that hold still lead from the first corner to all others.
template <std::size_t N, class Holds>
bool isConnected(const std::array<int, N>& corners, Holds&& holds) {
    std::array<bool, N> reached{true};
    for (std::size_t round = 1; round < N; ++round)
        for (std::size_t i = 0; i < N; ++i)
            for (std::size_t j = 0; j < N; ++j)
                if (reached[i] && !reached[j] && holds(corners[i], corners[j])) reached[j] = true;
    return std::all_of(reached.begin(), reached.end(), [](bool r) { return r; });
}

}  // namespace

double Damage::share(int a, int b) const {
    const auto found = edges_.find(edgeOf(a, b));
    if (found == edges_.end()) return 0.5;
    return a < b ? found->second : 1.0 - found->second;
}

void Damage::sever(int a, int b, double share) {
    edges_.try_emplace(edgeOf(a, b), a < b ? share : 1.0 - share);
}

void Damage::assess(const mechanics::Model& model) {
    if (edges_.empty()) return;
    std::set<Edge> springs;
    std::vector<std::vector<int>> neighbours(model.positions.size());  // along structural springs
    for (const mechanics::Spring& s : model.springs) {
        if (s.kind == mechanics::SpringKind::bend) continue;
        springs.insert(edgeOf(s.a, s.b));
        if (s.kind != mechanics::SpringKind::structural) continue;
        neighbours[static_cast<std::size_t>(s.a)].push_back(s.b);
        neighbours[static_cast<std::size_t>(s.b)].push_back(s.a);
    }
    for (auto& list : neighbours) std::sort(list.begin(), list.end());
    // A bending spring goes when no point is left between its ends that is tied to both.
    for (const mechanics::Spring& s : model.springs) {
        if (s.kind != mechanics::SpringKind::bend || isSevered(s.a, s.b)) continue;
        const std::vector<int>&from = neighbours[static_cast<std::size_t>(s.a)],
              &to = neighbours[static_cast<std::size_t>(s.b)];
        std::vector<int> between;
        std::set_intersection(from.begin(), from.end(), to.begin(), to.end(), std::back_inserter(between));
        const bool holds = between.empty() || std::any_of(between.begin(), between.end(), [&](int m) {
                               return !isSevered(s.a, m) && !isSevered(m, s.b);
                           });
        if (!holds) sever(s.a, s.b, 0.5);
    }
    const auto holds = [&](int a, int b) { return springs.count(edgeOf(a, b)) > 0 && !isSevered(a, b); };
    const auto touched = [&](const auto& corners) {
        for (int a : corners)
            for (int b : corners)
                if (a < b && isSevered(a, b)) return true;
        return false;
    };
    triangles_.assign(model.triangles.size(), false);
    for (std::size_t t = 0; t < model.triangles.size(); ++t)
        triangles_[t] = touched(model.triangles[t]) && !isConnected(model.triangles[t], holds);
    cells_.assign(model.cells.size(), false);
    for (std::size_t c = 0; c < model.cells.size(); ++c)
        cells_[c] = touched(model.cells[c].points) && !isConnected(model.cells[c].points, holds);
}

}  // namespace taut::world
