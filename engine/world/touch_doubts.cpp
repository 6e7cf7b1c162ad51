#include "taut/world/touch_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "taut/world/impl.h"

namespace taut::world {
namespace {

constexpr std::size_t mostDoubts = 8;  // of one sort

std::string inLength(double metres) {
    return metres < 0.01 ? fmt::format("{:.3g} mm", 1e3 * metres) : fmt::format("{:.3g} m", metres);
}

// Those that touch, there or to come.
std::vector<const Body*> touchingBodies(const WorldImpl& world) {
    std::vector<const Body*> all;
    const auto add = [&](const Body& body) {
        if (body.spec->touch != Touch::nothing) all.push_back(&body);
    };
    for (const Body* body : world.allBodies()) add(*body);
    for (const auto& body : world.waiting) add(*body);
    return all;
}

void doubtThickness(std::span<const Body* const> bodies, std::vector<std::string>& doubts) {
    std::set<const BodySpec*> seen;  // copies would say the same again
    std::size_t count = 0;
    for (const Body* body : bodies) {
        const double edge = shortestEdge(*body), thickness = body->spec->thickness;
        if (!(2 * thickness > edge * (1 + 1e-9)) || !seen.insert(body->spec.get()).second || ++count > mostDoubts)
            continue;
        doubts.push_back(fmt::format(
            "{}: layers of it lie further apart ({}, twice its thickness) than its cells are wide ({}); give "
            "thickness <= {:.3g}",
            body->spec->fullName(), inLength(2 * thickness), inLength(edge), 0.5 * edge));
    }
}

void doubtInstants(const WorldImpl& world, std::vector<std::string>& doubts) {
    if (!world.spec.contact.instants) return;
    const Island* stiffest = nullptr;
    for (const auto& island : world.islands)
        if (touches(island->plan()) &&
            (stiffest == nullptr || island->instantsToPress() > stiffest->instantsToPress()))
            stiffest = island.get();
    const int instants = *world.spec.contact.instants;
    if (stiffest == nullptr || instants >= stiffest->instantsToPress()) return;
    doubts.push_back(fmt::format(
        "{} instants of contact a tick are few for {}, which asks for {} where it is pressed: contact may drive its "
        "springs; leave out instants",
        instants, stiffest->plan().bodies.front()->fullName(), stiffest->instantsToPress()));
}

void doubtLoneliness(std::span<const Body* const> bodies, std::vector<std::string>& doubts) {
    if (bodies.size() != 1 || bodies[0]->spec->touch != Touch::others) return;
    doubts.push_back(bodies[0]->fullName() +
                     " has touch = \"others\", but there is no other that touches: nothing will come of it; give "
                     "another body touch too, or this one touch = \"all\"");
}

void doubtCrossings(WorldImpl& world, std::vector<std::string>& doubts) {
    if (!world.touchesAny()) return;
    struct Pair {
        std::set<int> edges;
        BodyCrossing deepest;
    };
    std::map<std::pair<std::string, std::string>, Pair> pairs;
    for (const BodyCrossing& crossing : world.crossings()) {
        const bool isInOrder = !sortsBefore(*crossing.ofTriangle, *crossing.ofEdge);
        const Body &a = isInOrder ? *crossing.ofEdge : *crossing.ofTriangle,
                   &b = isInOrder ? *crossing.ofTriangle : *crossing.ofEdge;
        Pair& pair = pairs[{a.fullName(), b.fullName()}];
        pair.edges.insert(crossing.edge);
        if (pair.deepest.ofEdge == nullptr || crossing.depth > pair.deepest.depth) pair.deepest = crossing;
    }
    std::size_t count = 0;
    for (const auto& [names, pair] : pairs) {
        if (++count > mostDoubts) break;
        const bool isOne = names.first == names.second;
        const dvec3 x = pair.deepest.place;
        doubts.push_back(fmt::format(
            "{} as {}: {} edge{}, the deepest by {} at [{:.4g}, {:.4g}, {:.4g}]; {} will be drawn apart, "
            "start {} further off",
            isOne ? names.first + " goes through itself"
                  : names.first + " and " + names.second + " go through each other",
            isOne ? "it starts" : "they start", pair.edges.size(), pair.edges.size() == 1 ? "" : "s",
            inLength(pair.deepest.depth), x.x, x.y, x.z, isOne ? "it" : "they", isOne ? "its parts" : "them"));
    }
    if (pairs.size() > mostDoubts)
        doubts.push_back(fmt::format("{} more pairs of bodies go through each other", pairs.size() - mostDoubts));
}

}  // namespace

std::vector<std::string> touchDoubts(World& world) {
    WorldImpl& w = WorldAccess::of(world);
    std::vector<std::string> doubts;
    const std::vector<const Body*> bodies = touchingBodies(w);
    doubtLoneliness(bodies, doubts);
    doubtThickness(bodies, doubts);
    doubtInstants(w, doubts);
    doubtCrossings(w, doubts);
    return doubts;
}

}  // namespace taut::world
