#include "taut/world/private/ramps.h"

#include <algorithm>

#include "taut/world/private/bodies.h"
#include "taut/world/private/colliders.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/sleep.h"

namespace taut::world {
namespace {

template <class Spec>
const Spec* named(const std::vector<Spec>& specs, const std::string& name) {
    const auto found = std::find_if(specs.begin(), specs.end(), [&](const Spec& s) { return s.name == name; });
    return found == specs.end() ? nullptr : &*found;
}

void applyRamps(WorldImpl& w, double moment, fields::Affects which) {
    for (const Ramp& ramp : w.ramps) {
        if (ramp.action.field->affects != which) continue;
        const double ticks = moment - static_cast<double>(ramp.start);
        const double share = ramp.length == 0 ? 1.0 : shareOfWay(ramp.action.ease, ticks, ramp.length);
        std::vector<double> value = ramp.action.value;
        if (share < 1)
            for (std::size_t i = 0; i < value.size() && i < ramp.from.size(); ++i)
                value[i] = ramp.from[i] + share * (value[i] - ramp.from[i]);
        ramp.action.field->write(w.spec, value);
    }
}

// Whether any of these fields may differ in the coming tick from the previous one.
bool isRamping(const WorldImpl& w, fields::Affects which) {
    return std::any_of(
        w.ramps.begin(), w.ramps.end(),
        [&](const Ramp& ramp) { return ramp.action.field->affects == which && w.tick <= ramp.start + ramp.length; });
}

}  // namespace

// Gravity, flows and places change evenly during the tick. All other values are those of its middle.
void changeForces(WorldImpl& w) {
    if (!isRamping(w, fields::Affects::forces)) return;
    const auto forcesAt = [&](double moment) {
        applyRamps(w, moment, fields::Affects::forces);
        takeRampedParts(w);
        return forcesOf(w);
    };
    const double begin = static_cast<double>(w.tick);
    const ForceList from = forcesAt(begin), middle = forcesAt(begin + 0.5), to = forcesAt(begin + 1.0);
    const double end = static_cast<double>(w.tick + 1) / w.ticksPerSecond;
    const ForceList current = during(from, middle, to, w.seconds(), end);
    for (const auto& island : w.islands) island->setForces(w.now(), current);
}

void changeSprings(WorldImpl& w) {
    if (!isRamping(w, fields::Affects::springs)) return;
    applyRamps(w, static_cast<double>(w.tick) + 0.5, fields::Affects::springs);
    const auto concerns = [&](const Body& body) {
        return std::any_of(w.ramps.begin(), w.ramps.end(), [&](const Ramp& ramp) {
            const std::string& owner = ramp.action.field->owner;
            if (ramp.action.field->affects != fields::Affects::springs || w.tick > ramp.start + ramp.length)
                return false;
            return owner == body.spec->fullName() || owner == "material." + std::string(body.spec->materialName());
        });
    };
    for (const auto& island : w.islands) {
        if (island->frozen() != nullptr) continue;
        bool any = false;
        for (Body* body : island->plan().bodies) {
            if (!concerns(*body)) continue;
            takeSprings(w.spec, *body);
            any = true;
        }
        if (any) takeSpringsFromModels(island->change(w.now(), Change::material));
    }
}

void changeColliders(WorldImpl& w) {
    if (!isRamping(w, fields::Affects::colliders)) return;
    applyRamps(w, static_cast<double>(w.tick) + 0.5, fields::Affects::colliders);
    takeRampedParts(w);
    wakeAll(w);
    rebuildColliders(w);
}

// Fields that only a picture shows have their value at the time of the picture.
void changePicture(WorldImpl& w) {
    if (w.ramps.empty()) return;
    applyRamps(w, static_cast<double>(w.tick), fields::Affects::picture);
    takeRampedParts(w);
}

void takeRampedParts(WorldImpl& w) {
    if (w.ramps.empty()) return;
    w.registry.each<CameraPart>([&](ecs::Entity, CameraPart& part) {
        if (const CameraSpec* camera = named(w.spec.cameras, part.spec.name)) part.spec = *camera;
    });
    w.registry.each<ColliderPart>([&](ecs::Entity, ColliderPart& part) {
        const ColliderSpec* collider = named(w.spec.colliders, part.spec.name);
        if (collider == nullptr) return;
        part.spec.friction = collider->friction;
        part.spec.restitution = collider->restitution;
        part.spec.turnFriction = collider->turnFriction;
    });
}

void takeSprings(const SceneSpec& spec, Body& body) {
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
    if (body.model.friction.stuck.columns == fresh.friction.stuck.columns) body.model.friction = fresh.friction;
    if (body.model.freeform.rest.size() == fresh.freeform.rest.size()) body.model.freeform = fresh.freeform;
    body.plasticity = now->plasticityIn(spec);
}

}  // namespace taut::world
