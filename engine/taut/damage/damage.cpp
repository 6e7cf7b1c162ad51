#include "taut/damage/damage.h"

#include <algorithm>
#include <array>

namespace taut::world {
namespace {

Damage::Edge edgeOf(int a, int b) {
    return {std::min(a, b), std::max(a, b)};
}

// Whether the edges that hold still connect the first corner to all others.
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

bool Damage::isCellGone(std::size_t cell) const {
    if (tetrahedra_.empty()) return false;
    const auto first = tetrahedra_.begin() + static_cast<std::ptrdiff_t>(cellTetrahedra * cell);
    return std::find(first, first + cellTetrahedra, true) != first + cellTetrahedra;
}

// The springs, triangles and cells at each point of a model.
struct Damage::Index {
    struct Way {
        int to;
        mechanics::SpringKind kind;
    };
    std::vector<std::vector<Way>> springs;  // (points) in the order of the model
    std::vector<std::vector<std::size_t>> triangles, cells;

    explicit Index(const mechanics::Model& model)
        : springs(model.positions.size()), triangles(springs.size()), cells(springs.size()) {
        const auto at = [](int point) { return static_cast<std::size_t>(point); };
        for (const mechanics::Spring& s : model.springs) {
            springs[at(s.a)].push_back({s.b, s.kind});
            springs[at(s.b)].push_back({s.a, s.kind});
        }
        for (std::size_t t = 0; t < model.triangles.size(); ++t)
            for (const int i : model.triangles[t]) triangles[at(i)].push_back(t);
        for (std::size_t c = 0; c < model.cells.size(); ++c)
            for (const int i : model.cells[c].points) cells[at(i)].push_back(c);
    }
    const std::vector<Way>& from(int point) const { return springs[point]; }
    // Whether a spring other than a bending spring joins them.
    bool areJoined(int a, int b) const {
        return std::any_of(
            from(a).begin(), from(a).end(),
            [&](const Way& way) { return way.to == b && way.kind != mechanics::SpringKind::bend; });
    }
    bool areNeighbours(int a, int b) const {
        return std::any_of(
            from(a).begin(), from(a).end(),
            [&](const Way& way) { return way.to == b && way.kind == mechanics::SpringKind::structural; });
    }
};

void Damage::sever(int a, int b, double share) {
    if (edges_.try_emplace(edgeOf(a, b), a < b ? share : 1.0 - share).second) fresh_.push_back(edgeOf(a, b));
}

void Damage::assess(const mechanics::Model& model) {
    if (fresh_.empty()) return;
    if (!index_) index_ = std::make_shared<const Index>(model);
    triangles_.resize(model.triangles.size(), false);
    tetrahedra_.resize(cellTetrahedra * model.cells.size(), false);
    const Index& index = *index_;
    // A bending spring goes when no point between its ends is tied to both any more.
    const auto isLoose = [&](int a, int b) {
        bool isBetween = false;
        for (const Index::Way& way : index.from(a)) {
            if (way.kind != mechanics::SpringKind::structural || !index.areNeighbours(way.to, b)) continue;
            if (!isSevered(a, way.to) && !isSevered(way.to, b)) return false;
            isBetween = true;
        }
        return isBetween;
    };
    const std::size_t torn = fresh_.size();
    for (std::size_t i = 0; i < torn; ++i)
        for (const int a : {fresh_[i].first, fresh_[i].second})
            for (const Index::Way& way : index.from(a))
                if (way.kind == mechanics::SpringKind::bend && !isSevered(a, way.to) && isLoose(a, way.to))
                    sever(a, way.to, 0.5);
    const auto holds = [&](int a, int b) { return index.areJoined(a, b) && !isSevered(a, b); };
    const auto look = [&](const auto& corners, std::vector<bool>& gone, std::size_t number, int b) {
        if (gone[number] || std::find(corners.begin(), corners.end(), b) == corners.end()) return;
        gone[number] = !isConnected(corners, holds);
    };
    for (const auto& [a, b] : fresh_) {
        for (const std::size_t t : index.triangles[a]) look(model.triangles[t], triangles_, t, b);
        for (const std::size_t c : index.cells[a])
            for (std::size_t n = 0; n < cellTetrahedra; ++n)
                look(tetrahedronOf(model.cells[c], n), tetrahedra_, cellTetrahedra * c + n, b);
    }
    goneTetrahedra_ = static_cast<std::size_t>(std::count(tetrahedra_.begin(), tetrahedra_.end(), true));
    goneTriangles_ = static_cast<std::size_t>(std::count(triangles_.begin(), triangles_.end(), true));
    fresh_.clear();
}

}  // namespace taut::world
