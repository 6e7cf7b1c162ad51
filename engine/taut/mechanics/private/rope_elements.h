// Bending elements of a ring and of a rope that is curved at rest.
#pragma once

#include "taut/mechanics/bending_elements.h"

namespace taut::mechanics {

// As bendingElements(). Expects the freeform bending of a rope.
std::vector<BendingElement> ropeElements(const Model& model, const std::vector<bool>& isHeld,
                                         const std::vector<bool>& isClamped,
                                         const std::function<bool(int, int)>& isSevered);

}  // namespace taut::mechanics
