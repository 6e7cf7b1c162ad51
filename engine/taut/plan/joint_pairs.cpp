// The points and places that joints tie, other than seams and welds of whole solids.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "taut/body/private/solid_places.h"
#include "taut/core/error.h"
#include "taut/plan/private/couplings.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

using core::Error;
using core::ErrorKind;

// An end that a side of a joint gives, in global numbers of points.
struct JointEnd {
    Spot spot;
    int body;
    dvec3 place;  // [m]
};
// The bodies of the first side without a selection of points; the place of a joint is in their axes.
struct PlacedSide {
    bool isA;
    std::vector<int> bodies;
};
PlacedSide placedSide(const JointSpec& joint, const ScenePoints& scene) {
    for (const bool isA : {true, false}) {
        const JointSide& side = isA ? joint.a : joint.b;
        PlacedSide placed{isA, {}};
        for (int number = 0; number < static_cast<int>(scene.bodies().size()); ++number)
            if (isWhole(side) && names(side, scene.body(number))) placed.bodies.push_back(number);
        if (!placed.bodies.empty()) return placed;
    }
    throw Error(ErrorKind::badContent,
                at(joint.source) +
                    "place is on a side that is a whole body, and both sides of this joint name points of theirs; "
                    "leave the selector of one out, or leave place out");
}

// The place of a joint on a body of its placed side, and the axes of that.
collision::Frame frameOf(const JointSpec& joint, int number, const ScenePoints& scene) {
    const bool isInWorld = joint.placeIn == JointSpec::PlaceIn::world;
    collision::Frame frame = isInWorld ? collision::Frame() : scene.body(number).axes;
    frame.position = frame.toWorld(*joint.place);
    return frame;
}

// Ends at `place` [m] of whole bodies, else points and places by name.
std::vector<JointEnd> endsOf(const JointSide& side, const JointSpec& joint, const std::optional<dvec3>& place,
                             const ScenePoints& scene) {
    const bool isAtPlace = place && isWhole(side);
    std::vector<JointEnd> found;
    for (int number = 0; number < static_cast<int>(scene.bodies().size()) && isAtPlace; ++number)
        if (names(side, scene.body(number))) found.push_back({scene.spotOf(number, *place), number, *place});
    if (isAtPlace && !found.empty()) return found;
    for (const std::string& target : side.targets) {
        const std::string selector = parseTarget(target).selector;
        for (int number = 0; number < static_cast<int>(scene.bodies().size()); ++number)
            if (const auto named =
                    names(target, scene.body(number)) && selectPoints(scene.body(number).model, selector).empty()
                        ? placeNamed(scene.body(number), selector)
                        : std::nullopt)
                found.push_back({scene.spotOf(number, *named), number, *named});
    }
    if (found.empty())
        for (const PointRef& p : scene.named(side, joint.source))
            found.push_back({scene.global(p), p.body, scene.position(p)});
    return found;
}

// A tie at the place on each body of the placed side, to the one other end.
void addMounted(const JointSpec& joint, int ofScene, const ScenePoints& scene, Couplings& coupled) {
    if (!joint.place)
        throw Error(ErrorKind::badContent, at(joint.source) + std::string(joint.title()) + " needs a place");
    JointReport& report = coupled.reports.emplace_back();
    report.spec = &joint;
    const auto [isA, own] = placedSide(joint, scene);
    const JointSide& side = isA ? joint.b : joint.a;
    for (const int number : own) {
        const dvec3 place = frameOf(joint, number, scene).position;
        const std::vector<JointEnd> others = endsOf(side, joint, place, scene);
        if (others.size() != 1)
            throw Error(ErrorKind::badContent, at(joint.source) + std::string(joint.title()) +
                                                   " ties bodies to one other at a place, and \"" + side.text() +
                                                   "\" are " + std::to_string(others.size()) +
                                                   " places; name one whole body, or one point");
        const JointEnd end{scene.spotOf(number, place), number, place}, &other = others.front();
        const JointEnd &a = isA ? end : other, &b = isA ? other : end;
        coupled.islands.unite(a.body, b.body);
        report.pairs.push_back({&scene.body(a.body), &scene.body(b.body), 1});
        coupled.pairs.push_back({a.spot, b.spot, &joint, ofScene, 0.0});
        const bool isRigid = scene.body(other.body).spec->isRigid();
        const dvec3 there = isRigid ? other.place : scene.position(scene.refOf(other.spot.nearest()));
        const double away = glm::distance(there, place);
        if (isRigid) expectAtPlace(joint, side, away);
        report.jump = std::max(report.jump, away);
    }
}

}  // namespace

Mounting mountingOf(const JointPair& pair, const ScenePoints& scene) {
    Mounting mounting;
    const auto end = [&scene](const Spot& spot) {
        return [&scene, spot](const dvec3& place) {
            const int number = scene.refOf(spot.nearest()).body;
            const Spot there = scene.body(number).spec->isRigid() ? scene.spotOf(number, place) : spot;
            return there.renumbered([&](int global) { return scene.pointOf(scene.refOf(global)); });
        };
    };
    mounting.a = end(pair.a);
    mounting.b = end(pair.b);
    const Spot& placed = placedSide(*pair.spec, scene).isA ? pair.a : pair.b;
    mounting.at = frameOf(*pair.spec, scene.refOf(placed.nearest()).body, scene);
    mounting.centre = scene.body(scene.refOf(pair.b.nearest()).body).axes.position;
    mounting.size = 0.5 * sizeOf(scene.body(scene.refOf(pair.a.nearest()).body));
    return mounting;
}

// Over 60 lines: it ties each point of one side to the nearest of the other, and reports the points that it left out.
void addJoint(const JointSpec& joint, int ofScene, const ScenePoints& scene, Couplings& coupled) {
    if (joint.isMounted()) return addMounted(joint, ofScene, scene, coupled);
    if (joint.isWeld() && !joint.place && addWholeSolids(joint, scene, coupled)) return;
    std::optional<dvec3> place;
    if (joint.place) {
        const PlacedSide placed = placedSide(joint, scene);
        if (placed.bodies.size() > 1 && joint.placeIn == JointSpec::PlaceIn::side)
            throw Error(ErrorKind::badContent, at(joint.source) + "\"" + (placed.isA ? joint.a : joint.b).text() +
                                                   "\" names several bodies, and place is in the axes of one; "
                                                   "write a [[joint]] for each, or set place_in = \"world\"");
        place = frameOf(joint, placed.bodies.front(), scene).position;
    }
    std::vector<JointEnd> as = endsOf(joint.a, joint, place, scene), bs = endsOf(joint.b, joint, place, scene);
    if (place && !joint.isWeld() && as.size() < bs.size()) std::swap(as, bs);  // all go to the place
    const auto isOther = [&](const JointEnd& end) { return end.body != as.front().body; };
    const bool isOneBody = std::none_of(as.begin(), as.end(), isOther) && std::none_of(bs.begin(), bs.end(), isOther);
    const bool mayTieWithin = isOneBody || joint.tiesWithin();
    const bool merges = joint.isWeld() && !isOneBody && !joint.hasOwnTies();
    JointReport& report = coupled.reports.emplace_back();
    report.spec = &joint;
    std::map<std::pair<int, int>, int> pairs;  // by bodies: number of joined points
    std::map<int, double> reached;             // by body: distance to the nearest point of the other side [m]
    for (const JointEnd& b : bs) reached.emplace(b.body, HUGE_VAL);
    int made = 0;
    double nearest = HUGE_VAL;
    for (const JointEnd& a : as) {
        std::size_t best = bs.size();
        double bestDistance = HUGE_VAL;
        double& ownReach = reached.emplace(a.body, HUGE_VAL).first->second;
        for (std::size_t i = 0; i < bs.size(); ++i) {
            const dvec3 d = bs[i].place - a.place;
            const double distance = std::sqrt(glm::dot(d, d));
            if (bs[i].body == a.body && (!mayTieWithin || bs[i].spot == a.spot)) continue;
            double& otherReach = reached.at(bs[i].body);
            otherReach = std::min(otherReach, distance);
            if (distance < bestDistance) {
                best = i;
                bestDistance = distance;
            }
        }
        nearest = std::min(nearest, bestDistance);
        ownReach = std::min(ownReach, bestDistance);
        if (best == bs.size() || bestDistance > joint.reach()) continue;
        coupled.islands.unite(a.body, bs[best].body);
        ++pairs[{a.body, bs[best].body}];
        ++made;
        // Points of two rigid bodies stay two: all that is held of these is found at once.
        const Spot& b = bs[best].spot;
        if (merges && a.spot.isPoint() && b.isPoint() &&
            !(scene.body(a.body).spec->isRigid() && scene.body(bs[best].body).spec->isRigid()))
            coupled.welds.unite(a.spot.nearest(), b.nearest());
        else
            coupled.pairs.push_back({a.spot, b, &joint, ofScene, bestDistance});
        if (!joint.isWeld()) continue;
        report.jump = std::max(report.jump, bestDistance);
        bs.erase(bs.begin() + static_cast<std::ptrdiff_t>(best));
    }
    if (made == 0) {
        const std::string why = std::isfinite(nearest)
                                    ? "the nearest two points are " + std::to_string(nearest) +
                                          " m apart, more than reach_m = " + std::to_string(joint.reach()) +
                                          "; move the bodies together, or use kind = \"spring\""
                                    : "both sides are the same point";
        throw Error(ErrorKind::badContent, at(joint.source) + "the joint \"" + joint.a.text() + "\" – \"" +
                                               joint.b.text() + "\" joins nothing: " + why);
    }
    for (const auto& [numbers, points] : pairs)
        report.pairs.push_back({&scene.body(numbers.first), &scene.body(numbers.second), points});
    for (const auto& [number, distance] : reached) {
        const Body* named = &scene.body(number);
        if (std::none_of(report.pairs.begin(), report.pairs.end(),
                         [&](const auto& pair) { return pair.a == named || pair.b == named; }))
            report.loose.emplace_back(named, distance);
    }
}

}  // namespace taut::world
