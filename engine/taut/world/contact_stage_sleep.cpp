// Reports to sleep: who presses whom, and where. Wakes bodies that are reached.
#include "taut/world/private/contact_stage.h"

#include <algorithm>
#include <cmath>

namespace taut::world {
namespace {

constexpr double stickingShare = 0.9;  // of Coulomb's limit: up to there friction may hold what sleeps

}  // namespace

// Wakes companies within the tick, at its start.
void ContactStage::wake(const TickTime& time, std::span<const std::int64_t> companies) {
    for (Island* island : islands_) {
        if (!island->isAsleep() || std::count(companies.begin(), companies.end(), island->company()) == 0) continue;
        island->wake();
        island->close(time);
        island->takeParts(time, pace_.substeps());
        island->beginTick(time);
    }
    takeMasses();
    readAll();
    colliders_.place(0.0, x1_);
    if (hasJumped_) group_->drop();
    hasJumped_ = false;
}

// What crosses a body that is awake has to make way for it.
void ContactStage::wakeCrossed(const TickTime& time) {
    reached_.clear();
    for (const contact::Crossing& crossing : group_->crossings()) {
        const auto& elements = group_->elements();
        addReached(elements.edges()[static_cast<std::size_t>(crossing.edge)].surface,
                   elements.triangles()[static_cast<std::size_t>(crossing.triangle)].surface);
    }
    if (!reached_.empty()) wake(time, reached_);
}

// Of two surfaces that meet: if one sleeps and the other is of a body that moves, the first has been reached.
void ContactStage::addReached(int surfaceA, int surfaceB) {
    if (!isOfBody(surfaceA) || !isOfBody(surfaceB)) return;
    const Island &a = *bodyOf(surfaceA).island, &b = *bodyOf(surfaceB).island;
    if (a.isAsleep() && !b.isStill()) reached_.push_back(a.company());
    if (b.isAsleep() && !a.isStill()) reached_.push_back(b.company());
}

bool ContactStage::findReached() {
    group_->forEachPressing([&](const contact::ContactConstraint& pair, double, const dvec3&) {
        addReached(elements().surfaceOf(pair.points[0]), elements().surfaceOf(pair.points[3]));
    });
    return !reached_.empty();
}

// Adds up the impulses of pairs on points in this step, and of colliders on those of whole bodies.
void ContactStage::addPresses() {
    const auto add = [&](int point, double share, double limit, const dvec3& push, const dvec3& friction) {
        group_->carried().forEachMover(
            point,
            [&](int i, double weight) {
                Press& press = presses_[static_cast<std::size_t>(i)];
                press.limit += std::abs(share * weight) * limit;
                press.push += share * weight * push;
                press.friction += share * weight * friction;
            });
    };
    group_->forEachOnCollider([&](std::size_t k, double normal, const dvec3& friction) {
        const contact::KinematicContact& contact = kinematic_[k];
        if (!contact.isWhole) return;
        contact.forEachPoint([&](int point, double weight) {
            add(point, weight, contact.friction * normal, normal * contact.normal, friction);
        });
    });
    group_->forEachPressing([&](const contact::ContactConstraint& pair, double normal, const dvec3& friction) {
        for (std::size_t k = 0; k < 4; ++k)
            add(pair.points[k], pair.weights[k], pair.friction * normal, normal * pair.normal, friction);
        const int a = elements().surfaceOf(pair.points[0]), b = elements().surfaceOf(pair.points[3]);
        if (!isOfBody(a) || !isOfBody(b)) return;
        const std::pair<const Island*, const Island*> islands{bodyOf(a).island, bodyOf(b).island};
        if (islands.first != islands.second && std::count(pressing_.begin(), pressing_.end(), islands) == 0)
            pressing_.push_back(islands);
    });
}

void ContactStage::addFootholds() {
    group_->forEachPressing([&](const contact::ContactConstraint& pair, double normal, const dvec3& friction) {
        for (const int from : {0, pair.firstSide()}) {
            const int surface = elements().surfaceOf(pair.points[static_cast<std::size_t>(from)]);
            if (!isOfBody(surface) || !bodyOf(surface).spec->isRigid()) continue;
            dvec3 place(0.0);
            for (int k = from; k < (from == 0 ? pair.firstSide() : 4); ++k) {
                const auto own = static_cast<std::size_t>(k);
                place += std::abs(pair.weights[own]) * x1_[static_cast<std::size_t>(pair.points[own])];
            }
            footholds_[bodyOf(surface).island].push_back(
                {&bodyOf(surface), pair.places ? (*pair.places)[from == 0 ? 0 : 1] : place, glm::length(friction),
                 pair.friction * normal, pair.turnFriction.rolling > 0, false});
        }
    });
    group_->forEachOnCollider([&](std::size_t k, double normal, const dvec3& friction) {
        const contact::KinematicContact& contact = kinematic_[k];
        if (!contact.isWhole || !(normal > 0)) return;
        const dvec3 place = x1_[static_cast<std::size_t>(contact.point())] + contact.arm;
        const Body& body = bodyOf(elements().surfaceOf(contact.point()));
        footholds_[body.island].push_back(
            {&body, place, glm::length(friction), contact.friction * normal, contact.turnFriction.rolling > 0, true});
    });
}

std::vector<Island::Support> ContactStage::supports(const Island& island) const {
    std::vector<Island::Support> supports(island.plan().points.size());
    for (const Part& part : parts_) {
        if (part.island != &island || presses_.empty()) continue;
        for (int i = part.first; i < part.last; ++i) {
            const auto& [limit, push, friction] = presses_[static_cast<std::size_t>(i)];
            const double most = stickingShare * limit;
            supports[static_cast<std::size_t>(i - part.first)] = {
                push, limit > 0 && glm::dot(friction, friction) <= most * most};
        }
    }
    return supports;
}

bool ContactStage::crosses(const Island& island) const {
    const auto isOwn = [&](int surface) { return isOfBody(surface) && bodyOf(surface).island == &island; };
    const auto crossings = crossingsBefore();
    return std::any_of(crossings.begin(), crossings.end(), [&](const contact::Crossing& crossing) {
        return isOwn(elements().edges()[static_cast<std::size_t>(crossing.edge)].surface) ||
               isOwn(elements().triangles()[static_cast<std::size_t>(crossing.triangle)].surface);
    });
}

bool ContactStage::anySleeps() const {
    return std::any_of(
        islands_.begin(), islands_.end(), [](const Island* island) { return island->isAsleep(); });
}

bool ContactStage::movesAny() const {
    return std::any_of(
        islands_.begin(), islands_.end(), [](const Island* island) { return !island->isStill(); });
}

}  // namespace taut::world
