// Starts a change of a field of the scene; ramps.cpp goes on with it.
#include <algorithm>

#include "taut/world/private/actions/rows.h"
#include "taut/world/private/impl.h"

namespace taut::world {

Kind<ActionSpec> rampKind() {
    return actionKind<RampAction>(
        withWay(fields::FieldList<RampAction>()
                    .text("key", &RampAction::key, fields::Role::none,
                          "The field that changes, e.g. \"wind.breeze.velocity\".")
                    .required()
                    .numbers("to", &RampAction::value, endHelp)),
        [](const fields::CheckInput& input, const RampAction&) {
            if (input.table.find("to") == nullptr) reportLack(input, "to", "to is the value that the ramp ends at");
        });
}

void RampAction::perform(World& world) const {
    TAUT_EXPECTS(field != nullptr);
    WorldImpl& w = WorldAccess::of(world);
    Ramp ramp{*this, field->read(w.spec), w.tick, over > 0 ? ticksIn(over, w.ticksPerSecond) : 0};
    const auto old = std::find_if(w.ramps.begin(), w.ramps.end(), [&](const Ramp& r) { return r.action.key == key; });
    if (old != w.ramps.end())
        *old = std::move(ramp);
    else
        w.ramps.push_back(std::move(ramp));
}

}  // namespace taut::world
