#include "taut/island/private/cutting.h"

#include <algorithm>
#include <optional>
#include <set>

namespace taut::world {
namespace {

// Signed distances, in any unit, from a cut to the points of a body. An edge with its ends on different sides may cross
// the cut: always for a plane, within its length for a segment.
struct Knife {
    std::vector<double> side;    // (points of the model)
    std::vector<dvec2> place;    // (points of the model) in shares of the grid; empty for a plane
    dvec2 from{0.0}, upTo{0.0};  // of a segment

    std::optional<double> crossing(int a, int b) const {
        const double sa = side[a], sb = side[b];
        if ((sa >= 0) == (sb >= 0)) return std::nullopt;
        const double share = sa / (sa - sb);
        if (place.empty()) return share;
        const dvec2 at = place[a] + share * (place[b] - place[a]);
        const dvec2 way = upTo - from;
        const double along = glm::dot(at - from, way) / glm::dot(way, way);
        if (along < 0 || along > 1) return std::nullopt;
        return share;
    }
};

// A layer of a block's points that the plane meets is on one side of it, wherever rounding has put each.
Knife planeThrough(const CutAction& action, const Island& island, const Body& body) {
    constexpr double met = 1e-3;  // of the shortest edge
    const double near = body.model.cells.empty() ? 0.0 : met * shortestEdge(body) * glm::length(*action.planeNormal);
    Knife knife;
    for (int i : body.pointOf) {
        const double side = glm::dot(island.position(i) - *action.planePoint, *action.planeNormal);
        knife.side.push_back(std::abs(side) < near ? 0.0 : side);
    }
    return knife;
}

Knife segmentOn(const CutAction& action, const Body& body) {
    Knife knife;
    knife.from = *action.from;
    knife.upTo = *action.upTo;
    const dvec2 way = knife.upTo - knife.from;
    const int columns = body.model.grid[0] + 1;
    for (int i = 0; i < body.model.pointCount(); ++i) {
        const dvec2 at(static_cast<double>(i % columns) / body.model.grid[0],
                       static_cast<double>(i / columns) / body.model.grid[1]);
        knife.place.push_back(at);
        knife.side.push_back(way.x * (at.y - knife.from.y) - way.y * (at.x - knife.from.x));
    }
    return knife;
}

// All edges of a model, each once.
std::set<Damage::Edge> edgesOf(const mechanics::Model& model) {
    std::set<Damage::Edge> edges;
    const auto add = [&](int a, int b) { edges.insert({std::min(a, b), std::max(a, b)}); };
    for (const mechanics::Spring& s : model.springs) add(s.a, s.b);
    for (const auto& t : model.triangles)
        for (std::size_t i = 0; i < 3; ++i) add(t[i], t[(i + 1) % 3]);
    for (const auto& cell : model.cells)
        for (std::size_t n = 0; n < mechanics::cellTetrahedra.size(); ++n) {
            const std::array<int, 4> corners = tetrahedronOf(cell, n);
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = i + 1; j < 4; ++j) add(corners[i], corners[j]);
        }
    return edges;
}

}  // namespace

CutEdges edgesCutBy(const CutAction& action, const Island& island, std::span<Body* const> bodies) {
    CutEdges crossing;
    const IslandPlan& plan = island.plan();
    const bool isPlane = action.planePoint.has_value() && action.planeNormal.has_value();
    const bool isAll = !isPlane && !action.from;
    std::vector<double> side(plan.points.size(), 0.0);
    std::vector<bool> isCut(plan.points.size(), false);
    for (Body* body : plan.bodies) {
        if (std::find(bodies.begin(), bodies.end(), body) == bodies.end()) continue;
        if (!isPlane && !isAll && (body->model.grid[0] == 0 || !action.from || !action.upTo)) continue;
        const Knife knife = isPlane ? planeThrough(action, island, *body) : isAll ? Knife{} : segmentOn(action, *body);
        const bool isRigid = body->spec->isRigid();
        for (const auto& [a, b] : isRigid ? std::set<Damage::Edge>{} : edgesOf(body->model)) {
            if (body->damage.isSevered(a, b)) continue;
            const std::optional<double> share = isAll ? 0.5 : knife.crossing(a, b);
            if (share) crossing.edges.push_back({body, a, b, *share});
        }
        if (!isPlane && !isAll) continue;
        for (std::size_t i = 0; i < body->pointOf.size(); ++i) {
            const auto point = static_cast<std::size_t>(body->pointOf[i]);
            isCut[point] = true;
            if (isPlane) side[point] = knife.side[i];
        }
    }
    for (std::size_t t = 0; t < plan.ties.size(); ++t) {
        const JointTie& tie = plan.ties[t];
        if (tie.b < 0 || !holds(plan, tie)) continue;
        const auto a = static_cast<std::size_t>(tie.a), b = static_cast<std::size_t>(tie.b);
        if (isCut[a] && isCut[b] && (isAll || (side[a] >= 0) != (side[b] >= 0))) crossing.ties.push_back(t);
    }
    return crossing;
}

void sever(const CutEdges& crossing, IslandPlan& plan) {
    for (const CutEdges::Edge& edge : crossing.edges) edge.body->damage.sever(edge.a, edge.b, edge.share);
    for (const std::size_t tie : crossing.ties) letGo(plan, tie);
    breakSevered(plan);
}

void breakSevered(IslandPlan& plan, const std::function<void(int)>& before) {
    for (Body* body : plan.bodies) body->damage.assess(body->model);
    for (std::size_t s = 0; s < plan.springs.size(); ++s) {
        const SpringOrigin& origin = plan.origins[s];
        if (origin.body < 0 || plan.broken[s]) continue;
        const Body& body = *plan.bodies[origin.body];
        const mechanics::Spring& spring = body.model.springs[origin.spring];
        if (!body.damage.isSevered(spring.a, spring.b)) continue;
        if (before) before(static_cast<int>(s));
        plan.broken[s] = true;
        plan.springs[s].stiffness = 0;
    }
}

}  // namespace taut::world
