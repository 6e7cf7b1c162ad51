#include "taut/world/undoing_world.h"

#include <algorithm>

#include "taut/core/error.h"
#include "taut/spec/ticks.h"
#include "taut/world/components.h"

namespace taut::world {
namespace {

// Sets a flag while it lives.
struct Flag {
    bool& is;
    explicit Flag(bool& flag) : is(flag) { is = true; }
    ~Flag() { is = false; }
};

struct Lead {
    ColliderPart* part = nullptr;
    Placement* placement = nullptr;
};

Lead leadOf(World& world, const std::string& collider) {
    Lead found;
    std::string names;
    world.registry().each<Identity, ColliderPart, Placement>(
        [&](ecs::Entity, const Identity& identity, ColliderPart& part, Placement& placement) {
            if (identity.fullName() == collider) found = {&part, &placement};
            names += (names.empty() ? "" : ", ") + identity.fullName();
        });
    if (found.part == nullptr)
        throw core::Error(core::ErrorKind::usage, "there is no collider \"" + collider + "\"; " +
                                                      (names.empty() ? "the scene has none" : "there are " + names));
    return found;
}

}  // namespace

UndoingWorld::UndoingWorld(SceneSpec spec, Options options)
    : spec_(std::move(spec)), added_{std::move(options), {}, {}, {}}, world_(spec_, added_.options) {}

World UndoingWorld::made(const Added& added) const {
    World fresh(spec_, added.options);
    for (const auto& force : added.lateForces) fresh.addForce(force);
    for (const auto& [system, callback] : added.systems) fresh.addSystem(system, callback);
    return fresh;
}

// Making a world evaluates its forces, which leaves no trace in the state that is read.
void UndoingWorld::goTo(std::span<const std::byte> state, Added added) {
    const Flag isGoing(*isGoingBack_);
    World fresh = made(added);
    fresh.restore(state, added.ramps);
    world_ = std::move(fresh);
    added_ = std::move(added);
}

bool UndoingWorld::mayThrow() const {
    if (!world_.callbacks().empty()) return true;
    const Ticks ticks(spec_.run);
    const std::int64_t tick = world_.tick();
    return std::any_of(spec_.actions.begin(), spec_.actions.end(), [&](const ActionSpec& action) {
        return ticks.at(action.t) <= tick && tick <= ticks.at(action.t + action.lasts());
    });
}

template <class Doing>
auto UndoingWorld::orUndo(Doing&& doing) {
    isUntouched_ = false;
    if (isTicking_) return doing();  // a throw ends the tick, which is then undone
    const std::vector<std::byte> before = world_.save();
    const Added added = added_;
    try {
        return doing();
    } catch (...) {
        goTo(before, added);
        throw;
    }
}

std::optional<Divergence> UndoingWorld::advance() {
    TAUT_EXPECTS(!isTicking_);
    const auto tick = [&] {
        const Flag ticking(isTicking_);
        return world_.advance();
    };
    if (mayThrow()) return orUndo(tick);
    isUntouched_ = false;
    return tick();
}

void UndoingWorld::apply(const ActionSpec& action) {
    const auto* move = dynamic_cast<const MoveAction*>(&action);
    if (isTicking_ && move != nullptr && move->id.empty())
        throw core::Error(core::ErrorKind::usage,
                          "within a tick a collider is not sent on its way; let the system lead it, tick by tick");
    orUndo([&] {
        action.foresee([&](const ActionSpec& part) {
            const auto* ramp = dynamic_cast<const RampAction*>(&part);
            if (ramp == nullptr) return;
            std::erase_if(added_.ramps, [&](const RampAction& other) { return other.key == ramp->key; });
            added_.ramps.push_back(*ramp);
        });
        world_.apply(action);
    });
}

void UndoingWorld::place(const std::string& collider, const collision::Pose& pose) {
    const auto [part, placement] = leadOf(world_, collider);
    isUntouched_ = false;
    if (isTicking_)
        placement->to = pose;
    else
        part->move = PoseMove{placement->to, pose, world_.tick(), 1, Ease::linear};
}

collision::Pose UndoingWorld::poseOf(const std::string& collider) const {
    return leadOf(const_cast<World&>(world_), collider).placement->to;
}

void UndoingWorld::addForce(CallbackSpec spec) {
    const auto unlessGoingBack = [this](auto function) {
        return [function, isGoingBack = isGoingBack_](const CallbackPoints& points, auto into) {
            if (!*isGoingBack) function(points, into);
        };
    };
    spec.force = unlessGoingBack(spec.force);
    if (spec.energy) spec.energy = unlessGoingBack(spec.energy);
    const std::shared_ptr<const Force> force = callbackForce(std::move(spec));
    if (!isUntouched_)
        return orUndo([&] {
            world_.addForce(force);
            added_.lateForces.push_back(force);
        });
    Added added = added_;
    World(spec_, added.options).addForce(force);  // it refuses a force that is not allowed
    added.options.forces.push_back(force);
    world_ = made(added);
    added_ = std::move(added);
}

void UndoingWorld::addSystem(World::System system, const std::string& callback) {
    world_.addSystem(system, callback);
    added_.systems.emplace_back(std::move(system), callback);
}

void UndoingWorld::restore(std::span<const std::byte> bytes, std::vector<RampAction> applied) {
    TAUT_EXPECTS(!isTicking_);
    Added added = added_;
    added.ramps = std::move(applied);
    goTo(bytes, std::move(added));
    isUntouched_ = false;
}

}  // namespace taut::world
