// A world for programs whose forces and systems may throw. If one throws in the middle of a tick or an action, the
// world returns to the state before. It knows no language.
//
// It goes back through another world, made of the same scene, that reads the bytes of save(). A tick that throws may
// have changed everything in a world: its bodies, plans, networks, methods, forces, the fields of the scene. save()
// lists all this in one place, as differences from the scene. Keeping values instead, such as IslandMemory for an
// island with an unchanged plan, would need a second list.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/forces/callback.h"
#include "taut/spec/actions.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut::world {

class UndoingWorld {
  public:
    // Scene and options as for World.
    explicit UndoingWorld(SceneSpec spec, Options options = {});
    UndoingWorld(const UndoingWorld&) = delete;
    UndoingWorld& operator=(const UndoingWorld&) = delete;

    // For questions only. Changes go through the functions below, because they know all that has to be made anew.
    // References into the world are invalid after any of them throws or restores.
    const World& world() const { return world_; }
    const SceneSpec& spec() const { return spec_; }
    bool isTicking() const { return isTicking_; }  // a force or a system is asking

    // As in World. Passes on exceptions of a force, a system or an action; everything is then as it was before. For
    // that it keeps the state before each tick that has callbacks or actions, at the cost of a save().
    std::optional<Divergence> advance();
    // To be called between two ticks. A system may call it too, but core::Error(usage) is thrown for the move of a
    // collider.
    void apply(const ActionSpec& action);
    // Moves a collider to its pose at the end of the coming tick; if a system calls, of this tick. It pushes
    // bodies out of its way. Throws core::Error(usage) for an unknown collider.
    void place(const std::string& collider, const collision::Pose& pose);
    collision::Pose poseOf(const std::string& collider) const;  // throws for an unknown collider too

    // As World::addForce(). Before the first tick it chooses the steps anew, with the force in mind. The force's
    // functions are not called while a world is made to go back to a state.
    void addForce(CallbackSpec force);
    void addSystem(World::System system, const std::string& callback);

    // Goes to the state of any tick of a world with the same scene, forces and systems. Bytes that do not fit throw and
    // change nothing. Expects that it is not ticking.
    void restore(std::span<const std::byte> bytes, std::vector<RampAction> applied = {});
    // The ramps that apply() has started, for each key the last. restore() needs them.
    const std::vector<RampAction>& applied() const { return added_.ramps; }

  private:
    // Additions to the scene.
    struct Added {
        Options options;
        std::vector<std::shared_ptr<const Force>> lateForces;  // added after the first tick
        std::vector<std::pair<World::System, std::string>> systems;
        std::vector<RampAction> ramps;
    };
    World made(const Added& added) const;
    void goTo(std::span<const std::byte> state, Added added);
    bool mayThrow() const;
    template <class Doing>
    auto orUndo(Doing&& doing);

    SceneSpec spec_;
    Added added_;
    bool isUntouched_ = true;  // no tick and no action yet
    bool isTicking_ = false;
    std::shared_ptr<bool> isGoingBack_ = std::make_shared<bool>(false);  // forces call no function meanwhile
    World world_;
};

}  // namespace taut::world
