// A world for programs whose forces and systems may throw: what throws in the middle of a tick, or of an action, has
// not happened. It knows no language.
//
// It goes back by another world that is made of the same scene and reads what save() wrote. Between its start and where
// a tick throws, actions, ramps and tears may have changed all that a world has: who is there, plans, networks, methods
// and forces of islands, the fields of the scene. save() lists that once, as what differs from the scene; memories as
// values, such as IslandMemory of what a tick does to an island whose plan stays, would list it a second time.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/spec/actions.h"
#include "taut/spec/spec.h"
#include "taut/forces/callback.h"
#include "taut/world/world.h"

namespace taut::world {

class UndoingWorld {
  public:
    // Of such a scene and such options, as World has them.
    explicit UndoingWorld(SceneSpec spec, Options options = {});
    UndoingWorld(const UndoingWorld&) = delete;
    UndoingWorld& operator=(const UndoingWorld&) = delete;

    // To be asked. What changes it goes through the functions below: what they know is all that is made anew. What it
    // refers to is gone after each of them that throws or restores.
    const World& world() const { return world_; }
    const SceneSpec& spec() const { return spec_; }
    bool isTicking() const { return isTicking_; }  // a force or a system is asking

    // As World's. What a force, a system or an action throws passes through, and everything is as it was before. So
    // that it can be, the state is kept before each tick that has callbacks or actions, which costs what save() costs.
    std::optional<Divergence> advance();
    // Between two ticks or from a system, where it throws core::Error(usage) for the move of a collider.
    void apply(const ActionSpec& action);
    // Leads a collider to where it is at the end of the coming tick, or, from a system, of this one: it sweeps what is
    // in its way. Throws core::Error(usage) for one that is not there.
    void place(const std::string& collider, const collision::Pose& pose);
    collision::Pose poseOf(const std::string& collider) const;  // throws the same

    // As World::addForce() does. Before the first tick steps are chosen anew, with the force in mind. While a world is
    // made that goes back to a state, its functions are not asked.
    void addForce(CallbackSpec force);
    void addSystem(World::System system, const std::string& callback);

    // The state of any tick, of a world with the same scene, forces and systems; what does not fit throws and changes
    // nothing. Expects that it is not ticking.
    void restore(std::span<const std::byte> bytes, std::vector<RampAction> applied = {});
    // Ramps that apply() began, of each key the last, which restore() has to be told.
    const std::vector<RampAction>& applied() const { return added_.ramps; }

  private:
    // What is not in the scene.
    struct Added {
        Options options;
        std::vector<std::shared_ptr<const Force>> lateForces;  // after the first tick
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
    bool isUntouched_ = true;  // neither a tick nor an action
    bool isTicking_ = false;
    std::shared_ptr<bool> isGoingBack_ = std::make_shared<bool>(false);  // forces ask nobody meanwhile
    World world_;
};

}  // namespace taut::world
