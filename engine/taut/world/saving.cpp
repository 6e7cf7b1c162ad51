#include "taut/world/private/saving.h"

#include <algorithm>

#include "taut/core/private/contains.h"
#include "taut/spec/kinds.h"
#include "taut/spec/ticks.h"
#include "taut/world/private/bodies.h"
#include "taut/world/private/cameras.h"
#include "taut/world/private/impl.h"
#include "taut/world/private/tick.h"
#include "taut/world/result_bits.h"

namespace taut::world {
namespace {

// Longest way, in ticks. No run is longer.
constexpr std::int64_t longestWay = std::int64_t{1} << 40;

void visitWay(StateBytes& bytes, std::int64_t& start, std::int64_t& length, Ease& ease) {
    bytes.atLeast(start, 0, longestWay);
    bytes.atLeast(length, 1, longestWay);
    bytes.choice(ease, Ease::hold);
}

// Marks a hand that is turned. No name, with which all other hands begin, has such a length.
constexpr std::uint64_t turnMark = 0xfff8'7461'7574'0003ULL;

void visitPart(StateBytes& bytes, Hand& hand) {
    if (bytes.mark(turnMark, hand.isTurned()))
        for (dvec3* v : {&hand.turnedFrom, &hand.turnedTo, &hand.spin}) bytes(*v);
    bytes(hand.id);
    bytes(hand.rigid);
    for (dvec3* v : {&hand.from, &hand.to, &hand.rate}) bytes(*v);
    visitWay(bytes, hand.start, hand.length, hand.ease);
}

void visitPart(StateBytes& bytes, PoseMove& move) {
    bytes(move.from);
    bytes(move.to);
    visitWay(bytes, move.start, move.length, move.ease);
}

// Expects as many numbers as the field has.
void visitValue(StateBytes& bytes, std::vector<double>& value, std::size_t size) {
    bytes.list(value);
    bytes.require(value.size() == size &&
                  std::all_of(value.begin(), value.end(), [](double v) { return std::isfinite(v); }));
}

// The field is that of any action of the scene with the same key. Reading writes the saved value into the scene.
void visitPart(StateBytes& bytes, Ramp& ramp, const SceneSpec& start, std::span<const RampAction> applied,
               SceneSpec& spec) {
    std::string key = ramp.action.key;
    bytes(key);
    if (bytes.isReading()) {
        foreseen<RampAction>(start.actions, [&](const RampAction& like) {
            if (like.key == key) ramp.action = like;
        });
        for (const RampAction& like : applied)
            if (like.key == key) ramp.action = like;
        if (ramp.action.field == nullptr) misfit("it has no ramp of \"" + key + "\"");
    }
    std::vector<double> now = ramp.action.field->read(spec);
    const std::size_t size = now.size();
    visitValue(bytes, ramp.action.value, size);
    bytes.choice(ramp.action.ease, Ease::hold);
    visitValue(bytes, ramp.from, size);
    bytes.atLeast(ramp.start, 0, longestWay);
    bytes.atLeast(ramp.length, 0, longestWay);
    visitValue(bytes, now, size);
    if (bytes.isReading()) ramp.action.field->write(spec, now);
}

// Marks the number of bits; no frame rate has this value.
constexpr std::uint64_t bitsMark = 0xfff8'7461'7574'0002ULL;  // a NaN

void visitBits(StateBytes& bytes) {
    int number = bytes.isReading() ? 1 : resultBits;
    if (bytes.mark(bitsMark, true)) bytes(number);
    bytes.require(areBits(number));
    if (number != resultBits) throw core::Error(core::ErrorKind::badContent, "this state was " + recordedBy(number));
}

// Marks a world with kinds of its own. No frame rate, with which all others begin, has this value.
constexpr std::uint64_t ownKindsMark = 0xfff8'7461'7574'0001ULL;  // a NaN

// Marks the report of touching bodies. Without it the number of islands comes here, which has no such value.
constexpr std::uint64_t touchMark = 0xfff8'7461'7574'0004ULL;

// Marks cameras that follow bodies.
constexpr std::uint64_t followMark = 0xfff8'7461'7574'0005ULL;

// The kinds of actions that are not of the engine and begin before the tick: "action shake".
std::vector<std::string> ownActions(const SceneSpec& scene, std::int64_t tick) {
    const Ticks ticks(scene.run);
    std::vector<std::string> names;
    for (const ActionSpec& action : scene.actions)
        if (ticks.at(action.t) < tick && builtInActions().find(action.kind()) == nullptr)
            names.push_back("action " + std::string(action.kind()));
    return names;
}

// The kinds in a world that are not of the engine: "force attraction.well", "body ring.hoop", "method mine", "shape
// torus", and the actions so far.
std::vector<std::string> ownKinds(const SceneSpec& scene, const ForceList& added,
                                  const std::vector<std::unique_ptr<Island>>& islands, std::int64_t tick) {
    static const Kinds known = builtIn();
    std::vector<std::string> names;
    const auto need = [&](const std::string& name) {
        if (!core::contains(names, name)) names.push_back(name);
    };
    for (const auto& force : added) need("force " + force->name());
    for (const ForceSpec& force : scene.forces)
        if (known.forces.find(force.kind()) == nullptr) need("force " + force.fullName());
    for (const BodySpec& body : scene.bodies)
        if (known.bodies.find(body.kind()) == nullptr) need("body " + body.fullName());
    const auto needShape = [&](const ShapeSpec& spec) {
        if (known.shapes.find(spec.shape) == nullptr) need("shape " + spec.shape);
    };
    for (const BodySpec& body : scene.bodies)
        for (const BodySpec* part : body.shapes())
            if (const auto* shape = dynamic_cast<const ShapeSpec*>(part)) needShape(*shape);
    for (const ColliderSpec& collider : scene.colliders) {
        needShape(collider);
        for (const ColliderSpec& part : collider.parts) needShape(part);
    }
    for (const auto& island : islands)
        if (known.methods.find(island->plan().solver.integrator) == nullptr)
            need("method " + island->plan().solver.integrator);
    for (const std::string& action : ownActions(scene, tick)) need(action);
    return names;
}

// Lets a world without these kinds refuse the bytes by name. `actions`: all that its timeline has.
void visitKinds(StateBytes& bytes, const std::vector<std::string>& own, const std::vector<std::string>& actions) {
    std::vector<std::string> names;
    if (bytes.mark(ownKindsMark, !own.empty())) {
        names = own;
        bytes.each(names, [&](std::string& name) { bytes(name); });
    }
    if (bytes.isReading())
        std::erase_if(names,
                      [&](const std::string& name) { return std::count(actions.begin(), actions.end(), name) > 0; });
    for (std::size_t i = 0; i < std::max(names.size(), own.size()); ++i) {
        if (i >= own.size() || (i < names.size() && names[i] != own[i]))
            misfit("they need the " + names[i] + ", which this world has not, or not in this place");
        if (i >= names.size()) misfit("they know nothing of the " + own[i]);
    }
}

}  // namespace

void visit(WorldImpl& w, StateBytes& bytes, std::span<const RampAction> applied) {
    // The facts that have to agree, then the tick.
    visitBits(bytes);
    visitKinds(bytes, ownKinds(w.spec, w.added, w.islands, w.tick), ownActions(w.spec, longestWay));
    double rate = w.ticksPerSecond;
    bytes(rate);
    if (rate != w.ticksPerSecond) misfit("its frame rate is another");
    bytes.atLeast(w.tick, 0, longestWay);
    bytes(w.hash);
    // Ramps, spawned bodies, hands and colliders.
    bytes.each(w.ramps, [&](Ramp& ramp) { visitPart(bytes, ramp, *w.start, applied, w.spec); });
    if (bytes.isReading()) takeRampedParts(w);
    std::vector<std::string> targets = w.spawned;
    bytes.each(targets, [&](std::string& target) { bytes(target); });
    if (bytes.isReading())
        for (const std::string& target : targets)
            if (!spawnWaiting(w, target)) misfit("no body \"" + target + "\" waits to be spawned");
    bytes.each(
        w.hands, [&](Hand& hand) { visitPart(bytes, hand); });
    w.registry.each<ColliderPart, Placement>([&](ecs::Entity, ColliderPart& part, Placement& placement) {
        bytes.expect(part.spec.name, "its colliders are others");
        bytes(placement.from);
        bytes(placement.to);
        bytes(placement.moved);
        bytes.optional(part.move, [&](PoseMove& move) { visitPart(bytes, move); });
    });
    if (bytes.mark(followMark, followsAny(w)))
        w.registry.each<CameraPart>([&](ecs::Entity, CameraPart& part) {
            if (part.spec.follow.empty()) return;
            bytes.optional(part.followedFrom, [&](dvec3& from) { bytes(from); });
            bytes(part.moved);
            bytes(part.movingAt);
        });
    // Contact between bodies.
    if (bytes.mark(touchMark, w.contactReport.isWorthSaving())) {
        const std::vector<Body*> all = bodiesOf(w);
        w.contactReport.visit(bytes, std::vector<const Body*>(all.begin(), all.end()));
    }
    if (touchesAny(w)) {
        w.contactPace.visit([&](auto& number) { bytes(number); });
        bytes.require(w.contactPace.isSound());
        bytes.each(w.keptForces, [&](contact::KeptForce& own) {
            bytes(own.key);
            for (double* part : {own.force.of, own.torque.of})
                for (int k = 0; k < 4; ++k) bytes(part[k]);
        });
    }
    auto count = static_cast<std::uint64_t>(w.islands.size());
    bytes(count);
    if (count != w.islands.size()) misfit("its bodies hang together in another way");
    // Applies ramps to the bodies, for the next ramp that takes an island's springs from them.
    const bool ramped = std::any_of(w.ramps.begin(), w.ramps.end(), [](const Ramp& ramp) {
        return ramp.action.field->affects == fields::Affects::springs;
    });
    if (bytes.isReading() && ramped)
        for (const WorldImpl::Member& member : w.bodies) takeSprings(w.spec, *member.body);
    if (bytes.isReading()) {
        const ForceList current = forcesOf(w);
        for (const auto& island : w.islands) island->setForces(w.now(), current);
    }
    for (const auto& island : w.islands) island->visit(bytes);
}

}  // namespace taut::world
