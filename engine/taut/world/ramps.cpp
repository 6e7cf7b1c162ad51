// Fields of the scene that change while it runs.
#include <algorithm>

#include "taut/world/private/impl.h"

namespace taut::world {
namespace {

template <class Spec>
const Spec* named(const std::vector<Spec>& specs, const std::string& name) {
    const auto found = std::find_if(specs.begin(), specs.end(), [&](const Spec& s) { return s.name == name; });
    return found == specs.end() ? nullptr : &*found;
}

}  // namespace

void World::Impl::applyRamps(double moment, fields::Affects which) {
    for (const Ramp& ramp : ramps) {
        if (ramp.action.field->affects != which) continue;
        const double ticks = moment - static_cast<double>(ramp.start);
        const double share = ramp.length == 0 ? 1.0 : shareOfWay(ramp.action.ease, ticks, ramp.length);
        std::vector<double> value = ramp.action.value;
        if (share < 1)
            for (std::size_t i = 0; i < value.size() && i < ramp.from.size(); ++i)
                value[i] = ramp.from[i] + share * (value[i] - ramp.from[i]);
        ramp.action.field->write(spec, value);
    }
}

// Whether one of them may be different in the coming tick from what it was in the one before.
bool World::Impl::isRamping(fields::Affects which) const {
    return std::any_of(
        ramps.begin(), ramps.end(),
        [&](const Ramp& ramp) { return ramp.action.field->affects == which && tick <= ramp.start + ramp.length; });
}

// Gravity, flows and places change evenly during the tick; all else stays at its value in the middle.
void World::Impl::changeForces() {
    if (!isRamping(fields::Affects::forces)) return;
    const auto forcesAt = [&](double moment) {
        applyRamps(moment, fields::Affects::forces);
        takeRampedParts();
        return forces();
    };
    const double begin = static_cast<double>(tick);
    const ForceList from = forcesAt(begin), middle = forcesAt(begin + 0.5), to = forcesAt(begin + 1.0);
    const ForceList current = during(from, middle, to, seconds(), static_cast<double>(tick + 1) / ticksPerSecond);
    for (const auto& island : islands) island->setForces(now(), current);
}

// Takes the springs over that the body would have if it were built from the scene as it is now.
void World::Impl::takeSprings(Body& body) const {
    const BodySpec* now = spec.bodies.find(body.kind(), body.base());
    if (now == nullptr) return;
    const mechanics::Model fresh = now->build(spec);
    if (fresh.springs.size() != body.model.springs.size()) return;
    for (std::size_t i = 0; i < fresh.springs.size(); ++i) {
        body.model.springs[i].stiffness = fresh.springs[i].stiffness;
        body.model.springs[i].dampingTime = fresh.springs[i].dampingTime;
    }
    body.model.dragRates = fresh.dragRates;
    for (std::size_t i = 0; i < body.model.cells.size() && i < fresh.cells.size(); ++i)
        body.model.cells[i].bulkModulus = fresh.cells[i].bulkModulus;
    if (body.model.bending.columns == fresh.bending.columns) body.model.bending = fresh.bending;
    body.plasticity = now->plasticityIn(spec);
}

void World::Impl::changeSprings() {
    if (!isRamping(fields::Affects::springs)) return;
    applyRamps(static_cast<double>(tick) + 0.5, fields::Affects::springs);
    const auto concerns = [&](const Body& body) {
        return std::any_of(ramps.begin(), ramps.end(), [&](const Ramp& ramp) {
            const std::string& owner = ramp.action.field->owner;
            if (ramp.action.field->affects != fields::Affects::springs || tick > ramp.start + ramp.length) return false;
            return owner == body.spec->fullName() || owner == "material." + std::string(body.spec->materialName());
        });
    };
    for (const auto& island : islands) {
        if (island->frozen() != nullptr) continue;
        bool any = false;
        for (Body* body : island->plan().bodies) {
            if (!concerns(*body)) continue;
            takeSprings(*body);
            any = true;
        }
        if (any) takeSpringsFromModels(island->change(now(), Change::material));
    }
}

void World::Impl::changeColliders() {
    if (!isRamping(fields::Affects::colliders)) return;
    applyRamps(static_cast<double>(tick) + 0.5, fields::Affects::colliders);
    takeRampedParts();
    rebuildColliders();
}

// What only a picture shows has its value at the time of the picture.
void World::Impl::changePicture() {
    if (ramps.empty()) return;
    applyRamps(static_cast<double>(tick), fields::Affects::picture);
    takeRampedParts();
}

// Entities have specs of their own: what ramps have changed of the scene's goes over to them.
void World::Impl::takeRampedParts() {
    if (ramps.empty()) return;
    registry.each<CameraPart>([&](ecs::Entity, CameraPart& part) {
        if (const CameraSpec* camera = named(spec.cameras, part.spec.name)) part.spec = *camera;
    });
    registry.each<ColliderPart>([&](ecs::Entity, ColliderPart& part) {
        const ColliderSpec* collider = named(spec.colliders, part.spec.name);
        if (collider == nullptr) return;
        part.spec.friction = collider->friction;
        part.spec.restitution = collider->restitution;
    });
}

}  // namespace taut::world
