// Questions to a world between two ticks.
#include <algorithm>
#include <map>
#include <set>

#include "taut/core/private/hash.h"
#include "taut/drawing/drawing.h"
#include "taut/island/private/island_report.h"
#include "taut/spec/targets.h"
#include "taut/view/camera_axes.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/joints.h"
#include "taut/world/private/publish.h"
#include "taut/world/private/tick.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using Corners = std::array<glm::dvec3, 3>;

// Whether triangles() returns the drawn surface of a body; otherwise it returns the surface in contact.
bool usesDrawnSurface(const Body& body) {
    const bool isMesh = body.spec->hasCarriedSurface() && body.spec->finish.skinData == nullptr;
    return body.spec->isRigid() || isMesh || body.damage.goneTetrahedra() > 0;
}

void addDrawn(const WorldImpl& w, const Body& body, std::vector<Corners>& triangles) {
    const auto member =
        std::find_if(w.bodies.begin(), w.bodies.end(), [&](const auto& own) { return own.body == &body; });
    const Island& island = islandOf(body);
    std::vector<glm::vec3> positions;
    for (int i : body.pointOf) positions.emplace_back(island.position(i));
    std::vector<view::Surface> surfaces;
    w.registry.find<BodyPart>(member->entity)->drawing->addSurfaces(positions, surfaces);
    for (const view::Surface& surface : surfaces) {
        const std::vector<std::uint32_t>& corners = surface.topology->triangles;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            if (k % 3 == 0) triangles.emplace_back();
            const glm::vec4 corner(surface.geometry->positions[corners[k]], 1.0F);
            triangles.back()[k % 3] = glm::dvec3(surface.transform * corner);
        }
    }
}

Metrics metricsOf(WorldImpl& w, const std::function<bool(const Body&)>& wanted, Measures what) {
    Metrics metrics;
    metrics.time = w.seconds();
    for (const auto& island : w.islands) addMetrics(*island, w.now(), wanted, metrics);
    const auto counts = [&](const Body& body) { return wanted(body) && body.island->frozen() == nullptr; };
    for (const BodyContact& contact : w.contactReport.contacts()) {
        const auto isOfWanted = [&](const Body* body) { return body != nullptr && counts(*body); };
        if (!isOfWanted(contact.first) && !isOfWanted(contact.second)) continue;
        ++(contact.first != nullptr && contact.second != nullptr ? metrics.bodyContacts : metrics.contacts);
    }
    for (const auto& [body, points] : w.contactReport.squeezed())
        if (counts(*body)) metrics.squeezed += static_cast<int>(points);
    if (what == Measures::butCrossings || !touchesAny(w)) return metrics;
    for (const BodyCrossing& crossing : crossingsOf(w))
        metrics.crossings += counts(*crossing.ofEdge) || counts(*crossing.ofTriangle) ? 1 : 0;
    for (const RigidTouch& overlap : w.contactStage->overlaps())
        metrics.crossings +=
            counts(w.contactStage->bodyOf(overlap.surface)) || counts(w.contactStage->bodyOf(overlap.other)) ? 1 : 0;
    const ContactStage::Penetration penetration = w.contactStage->penetration(wanted);
    metrics.crossings += penetration.figureCrossings;
    metrics.facePenetration = penetration.deepest;
    metrics.penetration = std::max(metrics.penetration, penetration.ofPoints);
    return metrics;
}

}  // namespace

Metrics World::metrics(Measures what) const {
    return metricsOf(
        *impl_, [](const Body&) { return true; }, what);
}

Metrics World::metrics(const std::string& bodies) const {
    return metrics(select(bodies));
}

PointsNow World::points(const std::string& target) const {
    return points(select(target));
}

Selection World::select(const std::string& target) const {
    Selection selection;
    selection.generation = impl_->generation;
    const std::string selector = parseTarget(target).selector;
    for (const Body* body : matchBodies(bodiesOf(*impl_), target))
        selection.parts.push_back({body, selectPoints(body->model, selector)});
    return selection;
}

bool World::isCurrent(const Selection& selection) const {
    return selection.generation == impl_->generation;
}

Metrics World::metrics(const Selection& selection, Measures what) const {
    TAUT_EXPECTS(isCurrent(selection));
    std::set<const Body*> bodies;
    for (const Selection::Part& part : selection.parts) bodies.insert(part.body);
    return metricsOf(
        *impl_, [&](const Body& body) { return bodies.contains(&body); }, what);
}

PointsNow World::points(const Selection& selection) const {
    TAUT_EXPECTS(isCurrent(selection));
    PointsNow points;
    std::map<const Island*, std::vector<dvec3>> velocities;  // of the islands asked so far
    for (const auto& [body, numbers] : selection.parts) {
        Island& island = islandOf(*body);
        auto known = velocities.find(&island);
        if (known == velocities.end()) known = velocities.emplace(&island, island.velocities(impl_->now())).first;
        for (int i : numbers) {
            const int point = body->pointOf[i];
            points.x.push_back(island.position(point));
            points.v.push_back(known->second[point]);
            points.mass.push_back(island.plan().points[point].mass);
        }
    }
    return points;
}

std::vector<glm::dvec3> World::positions(const Selection& selection) const {
    TAUT_EXPECTS(isCurrent(selection));
    std::vector<glm::dvec3> positions;
    for (const auto& [body, numbers] : selection.parts) {
        const Island& island = islandOf(*body);
        for (int i : numbers) positions.push_back(island.position(body->pointOf[i]));
    }
    return positions;
}

std::vector<std::array<glm::dvec3, 3>> World::triangles(const Selection& bodies) const {
    TAUT_EXPECTS(isCurrent(bodies));
    std::vector<Corners> triangles;
    for (const Selection::Part& part : bodies.parts) {
        const Body& body = *part.body;
        if (usesDrawnSurface(body)) {
            addDrawn(*impl_, body, triangles);
            continue;
        }
        const Island& island = islandOf(body);
        const auto add = [&](const std::array<int, 3>& corners) {
            auto& triangle = triangles.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) triangle[i] = island.position(body.pointOf[corners[i]]);
        };
        for (std::size_t t = 0; t < body.model.triangles.size(); ++t)
            if (!body.damage.isTriangleGone(t)) add(body.model.triangles[t]);
    }
    return triangles;
}

std::vector<glm::dvec3> World::positions(ecs::Entity entity) const {
    const BodyPart* part = impl_->registry.find<BodyPart>(entity);
    TAUT_EXPECTS(part != nullptr);
    const Island& island = islandOf(*part->body);
    std::vector<glm::dvec3> positions;
    for (int i : part->body->pointOf) positions.push_back(island.position(i));
    return positions;
}

ContactInfo World::contact() const {
    makeContactStage(*impl_);
    return impl_->contactStage->info();
}

double World::asleepShare() const {
    std::size_t all = 0, asleep = 0;
    for (const auto& island : impl_->islands) {
        all += island->plan().points.size();
        asleep += island->isAsleep() ? island->plan().points.size() : 0;
    }
    return all > 0 ? static_cast<double>(asleep) / static_cast<double>(all) : 0.0;
}

double World::shareInPicture(std::span<const dvec3> places) const {
    const view::Camera camera = cameraOfPictures(*impl_, impl_->seconds());
    const glm::vec2 size(impl_->spec.picture.size);
    const glm::dmat4 toClip(view::projectionOf(camera, size.x / size.y));
    const auto count = std::count_if(places.begin(), places.end(), [&](const dvec3& place) {
        const glm::dvec4 clip = toClip * glm::dvec4(place, 1.0);
        return std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
    });
    return static_cast<double>(count) / static_cast<double>(places.size());
}

bool World::hasTouched() const {
    return impl_->contactReport.hadImpulse() ||
           std::any_of(
               impl_->islands.begin(), impl_->islands.end(), [](const auto& island) { return island->hasTouched(); });
}

std::vector<core::Finding> World::warnings() const {
    std::vector<core::Finding> all = impl_->jointWarnings;
    all.insert(all.end(), impl_->actionWarnings.begin(), impl_->actionWarnings.end());
    for (const auto& island : impl_->islands)
        for (const std::string& warning : warningsOf(*island)) all.push_back(warningAt({}) + warning);
    for (const std::string& warning : impl_->contactReport.warnings()) all.push_back(warningAt({}) + warning);
    for (const std::string& name : callbacks())
        all.push_back(warningAt({}) + name +
                      " is a callback: from here on nobody promises that bits are the same on every machine");
    return all;
}

std::vector<std::string> World::callbacks() const {
    std::vector<std::string> names = impl_->callbackSystems;
    for (const auto& force : impl_->added)
        if (force->isCallback()) names.push_back(force->name());
    return names;
}

std::uint64_t World::stateHash() const {
    return impl_->hash;
}

std::vector<IslandInfo> World::islands() const {
    std::vector<IslandInfo> all;
    for (const auto& island : impl_->islands) all.push_back(infoOf(*island, impl_->now()));
    return all;
}

ode::Work World::work() const {
    ode::Work work;
    for (const auto& island : impl_->islands) work += island->work();
    return work;
}

std::vector<FrozenIsland> World::frozen() const {
    std::vector<FrozenIsland> all;
    for (const auto& island : impl_->islands)
        if (const FrozenIsland* frozen = island->frozen()) all.push_back(*frozen);
    return all;
}

std::vector<BodyHash> World::bodyHashes() const {
    std::vector<BodyHash> hashes;
    for (const Body* body : bodiesOf(*impl_)) {
        core::Hash hash;
        islandOf(*body).addToHash(*body, hash);
        hashes.push_back({body->fullName(), hash.value()});
    }
    return hashes;
}

std::vector<std::uint64_t> World::pointHashes(ecs::Entity entity) const {
    const BodyPart* part = impl_->registry.find<BodyPart>(entity);
    TAUT_EXPECTS(part != nullptr);
    const Island& island = islandOf(*part->body);
    std::vector<std::uint64_t> hashes;
    for (int i : part->body->pointOf) {
        core::Hash hash;
        island.addPointToHash(i, hash);
        hashes.push_back(hash.value());
    }
    return hashes;
}

std::vector<JointInfo> World::joints() const {
    std::vector<JointInfo> all = impl_->joints;
    for (JointInfo& info : all) info.left = jointsLeft(*impl_, info);
    return all;
}

std::optional<glm::dvec3> World::handPlace(const std::string& id) const {
    for (const Hand& hand : impl_->hands)
        if (hand.id == id) return hand.placeAt(impl_->tick);
    return std::nullopt;
}

view::FrameView World::view(bool debug) const {
    return viewOf(*impl_, debug);
}

view::FrameView World::viewAhead(double ahead) const {
    return world::viewAhead(*impl_, ahead);
}

}  // namespace taut::world
