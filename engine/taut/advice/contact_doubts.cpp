#include "taut/advice/contact_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "taut/contact/closest_points.h"
#include "taut/damage/private/inside.h"
#include "taut/plan/private/ties.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/colliders.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/tick.h"

namespace taut::world {
namespace {

constexpr std::size_t mostDoubts = 8;  // of one sort
constexpr double samePlace = 0.01;     // of the distance kept; any closer, the sides of two surfaces are not known

std::string inLength(double metres) {
    return metres < 0.01 ? fmt::format("{:.3g} mm", 1e3 * metres) : fmt::format("{:.3g} m", metres);
}

// The bodies that touch, now or later.
std::vector<const Body*> touchingBodies(const WorldImpl& world) {
    std::vector<const Body*> all;
    const auto add = [&](const Body& body) {
        if (body.spec->touch != Touch::nothing) all.push_back(&body);
    };
    for (const Body* body : bodiesOf(world)) add(*body);
    for (const auto& body : world.waiting) add(*body);
    return all;
}

void doubtThickness(std::span<const Body* const> bodies, std::vector<core::Finding>& doubts) {
    std::set<const BodySpec*> seen;  // copies would repeat the same
    std::size_t count = 0;
    for (const Body* body : bodies) {
        if (body->spec->isRigid()) continue;  // it has no layers
        const double edge = shortestEdge(*body), thickness = body->spec->thickness;
        if (!(2 * thickness > edge * (1 + 1e-9)) || !seen.insert(body->spec.get()).second || ++count > mostDoubts)
            continue;
        doubts.push_back(
            warningAt({}) +
            fmt::format(
                "{}: layers of it lie further apart ({}, twice its thickness) than its cells are wide ({}); give "
                "thickness <= {:.3g}",
                body->spec->fullName(), inLength(2 * thickness), inLength(edge), 0.5 * edge));
    }
}

// Its faces meet corners and edges of colliders at least, if there are any.
void doubtLoneliness(const WorldImpl& world, std::span<const Body* const> bodies, std::vector<core::Finding>& doubts) {
    if (bodies.size() != 1 || bodies[0]->spec->touch != Touch::others || bodies[0]->spec->isRigid()) return;
    if (bodies[0]->spec->collide && !colliderWidths(world).empty()) return;
    doubts.push_back(warningAt({}) + bodies[0]->fullName() +
                     " has touch = \"others\", but there is no other that touches: nothing will come of it; give "
                     "another body touch too, or this one touch = \"all\"");
}

struct PlacedSolid {
    const Body* body;
    std::vector<dvec3> x;  // (points of the model) [m]
    core::Aabb box;        // of the bodies that touch

    std::span<const dvec3> touching() const { return std::span(x).subspan(body->model.innerPoints); }
};

std::vector<PlacedSolid> placedSolids(const WorldImpl& world) {
    std::vector<PlacedSolid> solids;
    for (const auto& island : world.islands)
        for (const Body* body : island->plan().bodies) {
            if (!body->spec->isRigid() || body->spec->touch == Touch::nothing) continue;
            PlacedSolid& solid = solids.emplace_back(PlacedSolid{body, {}, {}});
            for (const int i : body->pointOf) solid.x.push_back(island->plan().positions[i]);
            for (const dvec3& x : solid.touching()) solid.box.add(x);
        }
    std::sort(solids.begin(), solids.end(),
              [](const PlacedSolid& a, const PlacedSolid& b) { return sortsBefore(*a.body, *b.body); });
    return solids;
}

// Where one is not convex, and no face of them crosses, nothing parts them.
void doubtSwallowed(const std::vector<PlacedSolid>& solids, std::vector<core::Finding>& doubts) {
    const auto isConvex = [](const PlacedSolid& solid) {
        const auto& pieces = solid.body->pieces;
        return std::all_of(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.shape != nullptr; });
    };
    std::size_t count = 0;
    for (const PlacedSolid& inner : solids)
        for (const PlacedSolid& outer : solids) {
            if (inner.body->island == outer.body->island || !inner.box.overlaps(outer.box, 0)) continue;
            if (isConvex(inner) && isConvex(outer)) continue;
            const Inside inside(outer.x, outer.body->model.triangles, {8, 8});
            const auto touching = inner.touching();
            if (!std::all_of(touching.begin(), touching.end(), [&](const dvec3& x) { return inside.has(x); })) continue;
            if (++count <= mostDoubts)
                doubts.push_back(warningAt(inner.body->spec->source) +
                                 fmt::format("{} starts wholly inside {}, and nothing brings it out: move it, or give "
                                             "one of them touch = \"nothing\"",
                                             inner.body->fullName(), outer.body->fullName()));
        }
}

// The first doubts of one sort, and the number of further ones.
template <class Pairs, class TextOf>
void addFirst(std::vector<core::Finding>& doubts, const Pairs& pairs, const char* further, const TextOf& textOf) {
    for (std::size_t count = 0; const auto& pair : pairs)
        if (++count <= mostDoubts) doubts.push_back(warningAt({}) + textOf(pair));
    if (pairs.size() > mostDoubts)
        doubts.push_back(warningAt({}) + fmt::format("{} more pairs of {}", pairs.size() - mostDoubts, further));
}

// Convex solids.
void doubtOverlaps(ContactStage& stage, std::vector<core::Finding>& doubts) {
    std::map<std::pair<std::string, std::string>, double> pairs;
    for (const RigidTouch& touch : stage.overlaps()) {
        const std::string first = stage.nameOf(touch.surface), second = stage.nameOf(touch.other);
        double& depth = pairs[std::minmax(first, second)];
        depth = std::max(depth, -touch.gap);
    }
    addFirst(doubts, pairs, "solids start in each other", [](const auto& pair) {
        return fmt::format("{} and {} start in each other: they will be pushed apart, start them {} further off",
                           pair.first.first, pair.first.second, inLength(pair.second));
    });
}

// Of solids, whose points no island brings out.
void doubtSunk(const WorldImpl& world, const std::vector<PlacedSolid>& solids, std::vector<core::Finding>& doubts) {
    constexpr double share = 0.02;  // of its size
    std::vector<std::string> names;
    world.registry.each<ColliderPart>(
        [&](ecs::Entity, const ColliderPart& part) { names.push_back("collider." + part.spec.name); });
    std::size_t count = 0;
    for (const PlacedSolid& solid : solids) {
        const collision::Colliders& colliders = solid.body->island->colliders();
        collision::Colliders::Inside deepest;
        for (const mechanics::RigidPart& part : surfacesOf(*solid.body))
            for (int i = part.first; i < part.last; ++i)
                if (const auto inside = colliders.inside(solid.x[i], part.rounding); inside.depth > deepest.depth)
                    deepest = inside;
        const bool isCounted =
            solid.body->spec->collide && deepest.depth > share * glm::length(solid.box.high - solid.box.low);
        if (!isCounted) continue;
        const std::string& collider = names[deepest.collider];
        const bool isMounted = std::any_of(world.spec.joints.begin(), world.spec.joints.end(), [&](const auto& joint) {
            return isTie(joint) && !joint.touch && colliderOf(joint) == collider &&
                   world::names(pointsOf(joint), *solid.body);
        });
        if (isMounted || solid.body->spec->holdOn == collider || ++count > mostDoubts) continue;
        doubts.push_back(warningAt(solid.body->spec->source) +
                         fmt::format("{} starts {} deep in {}, and is pushed out of it: move the body or the collider",
                                     solid.body->fullName(), inLength(deepest.depth), collider));
    }
}

void doubtCrossings(WorldImpl& world, std::vector<core::Finding>& doubts) {
    if (!touchesAny(world)) return;
    struct Pair {
        std::set<int> edges;
        double depth = -1;
        dvec3 place{0.0};  // of the deepest
    };
    std::map<std::pair<std::string, std::string>, Pair> pairs;
    makeContactStage(world);
    ContactStage& stage = *world.contactStage;
    for (const contact::Crossing& crossing : stage.crossings()) {
        const auto sides = stage.sidesOf(crossing);
        if (!sides) continue;
        Pair& pair = pairs[{stage.nameOf(sides->first), stage.nameOf(sides->second)}];
        pair.edges.insert(crossing.edge);
        if (const double depth = stage.depthOf(crossing); depth > pair.depth) {
            pair.depth = depth;
            pair.place = crossing.place;
        }
    }
    doubtOverlaps(stage, doubts);
    addFirst(doubts, pairs, "bodies go through each other", [](const auto& found) {
        const auto& [names, pair] = found;
        const bool isOne = names.first == names.second;
        const dvec3 x = pair.place;
        return fmt::format(
            "{} as {}: {} edge{}, the deepest by {} at [{:.4g}, {:.4g}, {:.4g}]; {} will be drawn apart, "
            "start {} further off",
            isOne ? names.first + " goes through itself"
                  : names.first + " and " + names.second + " go through each other",
            isOne ? "it starts" : "they start", pair.edges.size(), pair.edges.size() == 1 ? "" : "s",
            inLength(pair.depth), x.x, x.y, x.z, isOne ? "it" : "they", isOne ? "its parts" : "them");
    });
}

void doubtPlaces(const ContactStage& stage, std::vector<core::Finding>& doubts) {
    auto found = pointsInOnePlace(stage);
    // Solids have an inside, which tells the sides.
    std::erase_if(found, [&](const auto& entry) {
        const auto [a, b] = entry.first;
        return stage.bodyOf(a).spec->isRigid() && stage.bodyOf(b).spec->isRigid();
    });
    addFirst(doubts, found, "bodies start in the same place", [&](const auto& pair) {
        const auto& [surfaces, points] = pair;
        const Body &a = stage.bodyOf(surfaces.first), &b = stage.bodyOf(surfaces.second);
        return fmt::format(
            "{} and {} start in the same place, by {} points: their sides are "
            "undetermined, and separation takes long; start them {} apart",
            a.fullName(), b.fullName(), points.size(), inLength(a.spec->thickness + b.spec->thickness));
    });
}

}  // namespace

std::map<std::string, double> colliderWidths(const WorldImpl& world) {
    std::map<std::string, double> widths;
    for (const TouchedCollider& collider : touchedColliders(world)) {
        core::Aabb box;
        for (const collision::Outline& outline : collider.outlines)
            for (const dvec3& vertex : outline.vertices) box.add(vertex);
        for (const collision::PlacedConvex& part : collider.convex.shapes)
            for (int i = 0; i < 8 && part.shape->bounds(); ++i)
                box.add(part.at.toWorld(part.shape->bounds()->corner(i)));
        if (!(box.low.x <= box.high.x)) continue;
        std::array sizes{box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z};
        std::sort(sizes.begin(), sizes.end());
        widths[collider.name] = sizes[1];
    }
    return widths;
}

std::map<std::pair<int, int>, std::set<int>> pointsInOnePlace(const ContactStage& stage) {
    // Pairs of patches whose boxes overlap.
    const contact::Elements& elements = stage.elements();
    std::vector<dvec3> x;
    for (int i = 0; i < elements.pointCount(); ++i) x.push_back(stage.position(i));
    contact::Bvh patches(elements);
    std::vector<contact::LeafPair> near;
    patches.fit(x, x);
    patches.findNear(near);
    const auto at = [&](int i) { return x[i]; };
    // Notes the points of a that lie on a triangle or an edge of b.
    std::map<std::pair<int, int>, std::set<int>> found;
    const auto look = [&](const contact::BvhLeaf& a, const contact::BvhLeaf& b) {
        const Body &own = stage.bodyOf(a.surface), &other = stage.bodyOf(b.surface);
        const double within = samePlace * (own.spec->thickness + other.spec->thickness);
        const auto isIn = [&](const dvec3& point) {
            const auto isNear = [&](const contact::Corners& corners, bool isTriangle) {
                const dvec3 apart = contact::closestPoints(corners, isTriangle).separation;
                return glm::dot(apart, apart) <= within * within;
            };
            for (int t : b.triangles) {
                const std::array<int, 3>& c = elements.triangles()[t].points;
                if (isNear({point, at(c[0]), at(c[1]), at(c[2])}, true)) return true;
            }
            for (int e : b.edges) {
                const contact::Edge& edge = elements.edges()[e];
                if (isNear({point, point, at(edge.a), at(edge.b)}, false)) return true;
            }
            return false;
        };
        for (int i : a.points)
            if (isIn(at(i))) found[std::minmax(a.surface, b.surface)].insert(i);
    };
    // Looks both ways, for surfaces of different bodies that are not joined.
    for (contact::LeafPair pair : near) {
        const contact::BvhLeaf &a = patches[contact::lowOf(pair)], &b = patches[contact::highOf(pair)];
        if (a.surface == b.surface || elements.shareBond(a.surface, b.surface) || !stage.isOfBody(a.surface) ||
            !stage.isOfBody(b.surface))
            continue;
        look(a, b);
        look(b, a);
    }
    return found;
}

std::vector<core::Finding> touchDoubts(World& world) {
    WorldImpl& w = WorldAccess::of(world);
    std::vector<core::Finding> doubts;
    const std::vector<const Body*> bodies = touchingBodies(w);
    doubtLoneliness(w, bodies, doubts);
    doubtThickness(bodies, doubts);
    const std::vector<PlacedSolid> solids = placedSolids(w);
    doubtCrossings(w, doubts);
    doubtSwallowed(solids, doubts);
    doubtSunk(w, solids, doubts);
    if (touchesAny(w)) doubtPlaces(*w.contactStage, doubts);
    return doubts;
}

}  // namespace taut::world
