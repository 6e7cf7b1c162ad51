// Loops over the bodies of a scene's description, whatever their kind.
#pragma once

#include "taut/world/spec.h"

namespace taut::study {

template <class Spec, class Action>
void forEachBody(Spec& spec, const Action& action) {
    for (auto& body : spec.cloths) action(body);
    for (auto& body : spec.ropes) action(body);
    for (auto& body : spec.blocks) action(body);
    for (auto& body : spec.nets) action(body);
}

// A cloth has both from its material.
inline double dragOf(const world::ClothSpec&) {
    return 0.0;
}
template <class Body>
double dragOf(const Body& body) {
    return body.drag;
}
inline double dampingOf(const world::ClothSpec&) {
    return 0.0;
}
template <class Body>
double dampingOf(const Body& body) {
    return body.dampingTime;
}

}  // namespace taut::study
