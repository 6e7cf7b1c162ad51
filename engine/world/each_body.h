// Loops over the bodies of a scene's description, whatever their kind.
#pragma once

#include "taut/world/spec.h"

namespace taut::world {

// Calls action(kind, body) for each, as for "cloth" and a ClothSpec; `spec` may be const.
template <class Spec, class Action>
void forEachBody(Spec& spec, const Action& action) {
    for (auto& body : spec.cloths) action("cloth", body);
    for (auto& body : spec.ropes) action("rope", body);
    for (auto& body : spec.blocks) action("block", body);
    for (auto& body : spec.nets) action("net", body);
}

}  // namespace taut::world
