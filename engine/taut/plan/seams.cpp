// The points that seams tie, and where sewn borders have corners.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "taut/core/error.h"
#include "taut/plan/private/couplings.h"
#include "taut/spec/spec.h"

namespace taut::world {
namespace {

using core::Error;
using core::ErrorKind;

bool isHeld(const Spot& spot, const ScenePoints& scene) {
    return std::all_of(
        spot.shares().begin(), spot.shares().end(),
        [&](const Spot::Share& own) {
            const PointRef p = scene.refOf(own.point);
            const std::vector<int>& carried = scene.body(p.body).carried;
            return scene.body(p.body).model.held[p.point] ||
                   std::binary_search(carried.begin(), carried.end(), p.point);
        });
}

// The points of one edge, from one end to the other or around.
std::vector<PointRef> edgeOf(const std::string& target, const Source& source, const ScenePoints& scene,
                             bool& isClosed) {
    const std::vector<PointRef> named = scene.named(target, source);
    std::vector<int> own;
    for (const PointRef& p : named) {
        if (p.body != named.front().body)
            throw Error(ErrorKind::badContent,
                        at(source) + "\"" + target +
                            "\" names edges of several bodies; name them in a list, as they follow each other");
        own.push_back(p.point);
    }
    const Line line = lineOf(scene.body(named.front().body).model, own);
    isClosed = line.isClosed;
    std::vector<PointRef> found;
    for (const int i : line.points) found.push_back({named.front().body, i});
    if (found.empty())
        throw Error(ErrorKind::badContent,
                    at(source) + "\"" + target +
                        "\" is no edge to sew: its points are not one line; name a part of it, as @left of a "
                        "cloth");
    return found;
}

// Each edge goes on from the end that lies nearest to the one before. A gap between them has no length. Whether
// other seams close it is not known here.
SeamRow rowOf(const JointSide& side, const Source& source, const ScenePoints& scene) {
    std::vector<std::vector<PointRef>> edges;
    bool isClosed = false;
    for (const std::string& target : side.targets) {
        edges.push_back(edgeOf(target, source, scene, isClosed));
        if (isClosed && side.targets.size() > 1)
            throw Error(ErrorKind::badContent,
                        at(source) + "\"" + target + "\" is closed, so no edge follows it; name it alone");
    }
    const auto reach = [&](PointRef end, const std::vector<PointRef>& next) {
        return std::min(scene.distance(end, next.front()), scene.distance(end, next.back()));
    };
    std::vector<PointRef>& first = edges.front();
    if (edges.size() > 1 && reach(first.front(), edges[1]) < reach(first.back(), edges[1]))
        std::reverse(first.begin(), first.end());
    SeamRow row;
    for (std::vector<PointRef>& next : edges) {
        if (!row.points.empty()) {
            const PointRef last = row.points.back();
            if (scene.distance(last, next.back()) < scene.distance(last, next.front()))
                std::reverse(next.begin(), next.end());
            if (scene.global(last) == scene.global(next.front()))
                row.points.pop_back();
            else
                row.addStep(0.0);
        }
        for (std::size_t i = 0; i < next.size(); ++i) {
            if (i > 0) row.addStep(scene.distance(next[i - 1], next[i]));
            row.points.push_back(next[i]);
        }
    }
    if (scene.global(row.points.front()) == scene.global(row.points.back()))
        row.points.pop_back();
    else if (isClosed)
        row.addStep(scene.distance(row.points.back(), row.points.front()));
    for (const PointRef& p : row.points) row.edge.places.push_back(scene.position(p));
    return row;
}

}  // namespace

// The rows of all seams. One is closed, too, if other seams bring its ends together.
std::vector<std::array<SeamRow, 2>> rowsOfSeams(const ScenePoints& scene, const SceneSpec& spec) {
    std::vector<std::array<SeamRow, 2>> rows;
    Sets meets(scene.count());
    for (const JointSpec& seam : spec.joints) {
        if (!seam.isSeam()) continue;
        rows.push_back({rowOf(seam.a, seam.source, scene), rowOf(seam.b, seam.source, scene)});
        const auto& [a, b] = rows.back();
        if (a.edge.isClosed() || b.edge.isClosed()) continue;
        const auto isEnd = [](const Spot& spot, const SeamRow& row) {
            return spot.isPoint() && (spot.nearest() == 0 || spot.nearest() + 1 == static_cast<int>(row.points.size()));
        };
        for (const auto& [i, j] : pairedByLength(a.edge, b.edge))
            if (isEnd(i, a) && isEnd(j, b))
                meets.unite(scene.global(a.points[i.nearest()]), scene.global(b.points[j.nearest()]));
    }
    for (std::array<SeamRow, 2>& sides : rows)
        for (SeamRow& row : sides) {
            for (std::size_t k = 0; k + 1 < row.points.size(); ++k)
                if (const PointRef here = row.points[k], next = row.points[k + 1];
                    row.edge.steps[k] == 0.0 && meets.find(scene.global(here)) != meets.find(scene.global(next)))
                    row.gap = std::max(row.gap, scene.distance(here, next));
            if (!row.edge.isClosed() && row.points.size() > 2 &&
                meets.find(scene.global(row.points.front())) == meets.find(scene.global(row.points.back())))
                row.addStep(0.0);
        }
    return rows;
}

void addSeam(const JointSpec& seam, int ofScene, const std::array<SeamRow, 2>& rows, const ScenePoints& scene,
             Couplings& coupled) {
    const auto& [as, bs] = rows;
    // Points that are paired with points are half of a step aside at most.
    const double reach = seam.reach() + 0.5 * std::max(as.longest, bs.longest);
    JointReport& report = coupled.reports.emplace_back();
    report.spec = &seam;
    report.sewn = {{as.length(), bs.length()}, std::max(as.gap, bs.gap)};
    std::map<std::pair<int, int>, int> sewn;  // by bodies: number of points
    for (const auto& [i, j] : pairedByLength(as.edge, bs.edge)) {
        const auto globalOf = [&](const SeamRow& row) { return [&](int k) { return scene.global(row.points[k]); }; };
        const Spot a = i.renumbered(globalOf(as)), b = j.renumbered(globalOf(bs));
        const PointRef first = scene.refOf(a.nearest()), second = scene.refOf(b.nearest());
        if (a.has(b.nearest()) || b.has(a.nearest())) continue;  // where two edges of one body meet
        const dvec3 way = j.of(bs.edge.places) - i.of(as.edge.places);
        const double apart = std::sqrt(glm::dot(way, way));
        if (apart > reach)
            throw Error(ErrorKind::badContent, at(seam.source) + "the seam \"" + seam.a.text() + "\" – \"" +
                                                   seam.b.text() + "\" starts " + std::to_string(apart) +
                                                   " m apart; give the time to close, e.g. over_s = 1.0");
        if (seam.isWeld()) report.jump = std::max(report.jump, apart);
        report.sewn.apart = std::max(report.sewn.apart, apart);
        if (apart > weldReach && isHeld(a, scene) && isHeld(b, scene)) ++report.sewn.heldApart;
        ++sewn[{first.body, second.body}];
        coupled.islands.unite(first.body, second.body);
        coupled.sewn.push_back({a, b});
        const bool merges = seam.isWeld() && first.body != second.body && !seam.hasOwnTies();
        if (merges && a.isPoint() && b.isPoint())
            coupled.welds.unite(a.nearest(), b.nearest());
        else
            coupled.pairs.push_back({a, b, &seam, ofScene, apart});
    }
    if (sewn.empty())
        throw Error(ErrorKind::badContent,
                    at(seam.source) + "the seam sews \"" + seam.a.text() + "\" to itself; name two edges");
    for (const auto& [numbers, count] : sewn)
        report.pairs.push_back({&scene.body(numbers.first), &scene.body(numbers.second), count});
}

// Borders that are sewn are one curve, also where each is drawn as a smooth one, if both go the same way from point
// to point. Where one turns off, as at a seam's end, where three are sewn, or at a corner of one, both have a
// corner, and where points of one edge are tied between those of the other.
void markSeamCorners(const ScenePoints& scene, const Couplings& coupled) {
    for (Body* body : scene.bodies()) body->seamCorners.clear();
    Sets one(scene.count());
    std::vector<PointRef> between;  // on the straight part of an edge that is sewn to a point there
    for (const auto& [a, b] : coupled.sewn)
        if (a.isPoint() && b.isPoint())
            one.unite(a.nearest(), b.nearest());
        else
            for (const Spot* end : {&a, &b})
                for (const Spot::Share& own : end->shares()) between.push_back(scene.refOf(own.point));
    std::map<int, std::vector<std::vector<int>>> borders;  // by body
    const auto beside = [&](PointRef p) -> const std::vector<int>& {
        const auto [found, isNew] = borders.try_emplace(p.body);
        if (isNew) found->second = borderNeighbours(scene.body(p.body).model);
        return found->second[p.point];
    };
    const auto turns = [&](PointRef p) {
        constexpr double most = 0.5;  // cosine of the largest turn of a curve
        const std::vector<int>& ends = beside(p);
        if (ends.size() != 2) return true;
        const dvec3 in = scene.position(p) - scene.position({p.body, ends[0]}),
                    out = scene.position({p.body, ends[1]}) - scene.position(p);
        return glm::dot(in, out) < most * std::sqrt(glm::dot(in, in) * glm::dot(out, out));
    };
    const auto ways = [&](PointRef p) {
        std::set<int> found;
        for (const int i : beside(p)) found.insert(one.find(scene.global({p.body, i})));
        return found;
    };
    std::map<int, std::vector<PointRef>> members;
    for (const auto& [a, b] : coupled.sewn)
        for (const int number : {a.nearest(), b.nearest()}) {
            if (!a.isPoint() || !b.isPoint()) continue;
            const PointRef p = scene.refOf(number);
            std::vector<PointRef>& own = members[one.find(number)];
            if (std::none_of(own.begin(), own.end(),
                             [&](const PointRef& o) { return scene.global(o) == scene.global(p); }))
                own.push_back(p);
        }
    for (const auto& entry : members) {
        const std::vector<PointRef>& own = entry.second;
        const bool isCorner = own.size() > 2 || std::any_of(own.begin(), own.end(), [&](const PointRef& p) {
                                  return turns(p) || ways(p) != ways(own.front());
                              });
        for (const PointRef& p : own)
            if (isCorner) scene.body(p.body).seamCorners.push_back(p.point);
    }
    for (const PointRef& p : between) scene.body(p.body).seamCorners.push_back(p.point);
    for (Body* body : scene.bodies()) std::sort(body->seamCorners.begin(), body->seamCorners.end());
}

}  // namespace taut::world
