// Actions of a scene: the timeline as plain data, for any kinds of actions. Independent of files and of the kinds,
// which are in actions/. A hand at a mouse makes the same actions.
//
// To add a kind: derive from SpecOf<Own, ActionSpec>, give it a `kindName` and perform(), and add its rows to a table
// of kinds (actionKind() in common_rows.h, Kinds::actions); tests/unit/world_own_action_test.cpp does.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "taut/spec/source.h"
#include "taut/spec/specs.h"

namespace taut::world {

class World;

// Happens at the start of tick ⌊t · ticks per second + ½⌋. Actions of one tick happen in the order of the list.
struct ActionSpec {
    Source source;
    double t = 0.0;  // [s]

    ActionSpec();
    ActionSpec(const ActionSpec&);
    ActionSpec& operator=(const ActionSpec&);
    virtual ~ActionSpec();
    virtual std::string_view kind() const = 0;  // "push"
    virtual std::unique_ptr<ActionSpec> copy() const = 0;

    // Performs it now, with the services of a world, such as apply() of other actions. Throws core::Error(badContent),
    // with the source, if it has no target.
    virtual void perform(World& world) const = 0;
    // How long it goes on after t [s], finite. A timeline performs it at every tick up to then.
    virtual double lasts() const { return 0.0; }

    // Calls visit with this action and with all actions that it applies. The choice of the step and the preparation of
    // spawned bodies use this.
    using Visit = std::function<void(const ActionSpec&)>;
    virtual void foresee(const Visit& visit) const { visit(*this); }
};

// Calls visit with each action of one kind, both in the timeline and applied by its actions.
template <class Own>
void foreseen(const Specs<ActionSpec>& timeline, const std::function<void(const Own&)>& visit) {
    for (const ActionSpec& action : timeline)
        action.foresee([&](const ActionSpec& part) {
            if (const auto* own = dynamic_cast<const Own*>(&part)) visit(*own);
        });
}
template <class Own>
bool anyForeseen(const Specs<ActionSpec>& timeline, const std::function<bool(const Own&)>& is) {
    bool any = false;
    foreseen<Own>(timeline, [&](const Own& action) { any = any || is(action); });
    return any;
}

}  // namespace taut::world
