// Solids of an island: welds of whole solids, and the constraints that keep them rigid.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "taut/core/error.h"
#include "taut/core/rigid_motion.h"
#include "taut/plan/private/couplings.h"
#include "taut/plan/private/rigid_constraint.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

using core::Error;
using core::ErrorKind;

// The bodies that a side names as a whole, if all are rigid; else none.
std::vector<int> wholeSolids(const JointSide& side, const ScenePoints& scene) {
    std::vector<int> found;
    for (int number = 0; number < static_cast<int>(scene.bodies().size()); ++number)
        for (const std::string& text : side.targets) {
            if (!names(text, scene.body(number))) continue;
            const std::string selector = parseTarget(text).selector;
            if ((!selector.empty() && selector != "all") || !scene.body(number).spec->isRigid()) return {};
            found.push_back(number);
            break;
        }
    return found;
}

// Each solid of one side and the nearest of the other become one rigid body.
void uniteSolids(const JointSpec& weld, std::span<const int> as, std::span<const int> bs, const ScenePoints& scene,
                 Couplings& coupled) {
    if (weld.hasOwnTies())
        throw Error(ErrorKind::badContent,
                    at(weld.source) +
                        "a weld of whole solids makes one rigid body of them, which nothing parts or "
                        "draws: leave out name, break_N and finish, or name points");
    JointReport& report = coupled.reports.emplace_back();
    report.spec = &weld;
    const auto centre = [&](int number) {
        const mechanics::Model& model = scene.body(number).model;
        return core::rigidMotionOf(model.masses, model.positions, model.velocities).centre;
    };
    for (const int a : as) {
        int nearest = -1;
        double least = HUGE_VAL;
        for (const int b : bs)
            if (const double away = glm::distance(centre(a), centre(b)); b != a && away < least)
                nearest = b, least = away;
        if (nearest < 0)
            throw Error(ErrorKind::badContent,
                        at(weld.source) + "the weld joins \"" + weld.a.text() + "\" to itself; name two solids");
        coupled.islands.unite(a, nearest);
        coupled.solids.unite(a, nearest);
        report.pairs.push_back({&scene.body(a), &scene.body(nearest), scene.body(a).model.pointCount()});
    }
}

// Solids carry the points of a side where they are, each that which has the nearest point.
void carryBySolids(const JointSpec& weld, const JointSide& side, std::span<const int> solids, const ScenePoints& scene,
                   Couplings& coupled) {
    JointReport& report = coupled.reports.emplace_back();
    report.spec = &weld;
    std::map<std::pair<int, int>, int> pairs;  // by bodies: number of carried points
    for (const PointRef& point : scene.named(side, weld.source)) {
        int nearest = -1;
        double least = HUGE_VAL;
        for (const int solid : solids)
            for (const dvec3& corner : scene.body(solid).model.positions)
                if (const double away = glm::distance(scene.position(point), corner); away < least)
                    nearest = solid, least = away;
        coupled.islands.unite(point.body, nearest);
        coupled.carried.push_back({point, nearest});
        ++pairs[{point.body, nearest}];
    }
    for (const auto& [numbers, count] : pairs)
        report.pairs.push_back({&scene.body(numbers.first), &scene.body(numbers.second), count});
}

}  // namespace

bool addWholeSolids(const JointSpec& weld, const ScenePoints& scene, Couplings& coupled) {
    const std::vector<int> solidsOfA = wholeSolids(weld.a, scene), solidsOfB = wholeSolids(weld.b, scene);
    if (!solidsOfA.empty() && !solidsOfB.empty()) {
        uniteSolids(weld, solidsOfA, solidsOfB, scene, coupled);
        return true;
    }
    if (weld.hasOwnTies() || solidsOfA.empty() == solidsOfB.empty()) return false;
    carryBySolids(weld, solidsOfA.empty() ? weld.a : weld.b, solidsOfA.empty() ? solidsOfB : solidsOfA, scene, coupled);
    return true;
}

void addSolids(IslandPlan& plan, std::span<const int> members, const ScenePoints& scene, Couplings& coupled) {
    std::map<int, std::vector<const Body*>> solids;  // by the body that represents them
    for (const int number : members)
        if (scene.body(number).spec->isRigid()) solids[coupled.solids.find(number)].push_back(&scene.body(number));
    for (auto& [number, parts] : solids) {
        std::vector<int> points;
        std::vector<dvec3> rest;
        for (const Body* part : parts) {
            points.insert(points.end(), part->pointOf.begin(), part->pointOf.end());
            for (int i = 0; i < part->model.pointCount(); ++i)
                rest.push_back(part->model.positions[i] - jitterOf(*part, i));
        }
        for (const auto& [point, solid] : coupled.carried) {
            const int carried = coupled.solids.find(solid) == number ? scene.pointOf(point) : -1;
            if (carried < 0 || std::find(points.begin(), points.end(), carried) != points.end()) continue;
            points.push_back(carried);
            rest.push_back(scene.position(point) - jitterOf(scene.body(point.body), point.point));
        }
        plan.constraints.push_back(std::make_shared<RigidConstraint>(std::move(points), std::move(rest)));
        plan.solids.push_back(std::move(parts));
    }
}

std::vector<int> solidsOf(const IslandPlan& plan, std::span<const int> members, const ScenePoints& scene,
                          Couplings& coupled) {
    std::vector<int> solidOf(plan.points.size(), -1);
    for (const int number : members)
        if (scene.body(number).spec->isRigid())
            for (const int point : scene.body(number).pointOf) solidOf[point] = coupled.solids.find(number);
    for (const auto& [point, solid] : coupled.carried)
        if (std::find(members.begin(), members.end(), solid) != members.end())
            solidOf[scene.pointOf(point)] = coupled.solids.find(solid);
    return solidOf;
}

}  // namespace taut::world
