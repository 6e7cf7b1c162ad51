// What things of a scene have from others: [defaults.rope] is what every rope says unless it says otherwise, and
// like = "rope.a" takes the keys of one. It changes the tree before it is read; it knows keys, not what they mean.
#pragma once

#include <string>
#include <vector>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/document.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

using fields::Problems;

// Writes out what every element of a section with names has from others: its own keys stand over those of the one that
// it is like, those over the ones of that, and all over the defaults of its section; tables are laid over each other
// key by key, as merged() does. What does not go with the form of the element, such as the radius of a box, is left
// out. Places stay those where a value is written. `like` is gone then; `defaults` stay, before everything else.
// Reports a like that names nothing, or goes in a circle.
void inherit(const std::vector<SceneSection>& sections, Node& root, Problems& problems);

}  // namespace taut::scene
