// Inheritance of elements of a scene: every rope has the values of [defaults.rope] unless it gives its own, and like =
// "rope.a" takes the keys of another. It changes the tree before it is read, and uses keys but not their meaning.
#pragma once

#include <string>
#include <vector>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/document.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

using fields::Problems;

// Writes out the inherited keys of named elements. An element's own keys come first, then the keys of its `like`, then
// of the `like` of that element, then those of its material for its section ([material.silk.cloth]), then the defaults
// of its section. Tables are merged key by key, as by merged(). Values that do not fit the form of the element, such as
// the radius of a box, are left out. Each value keeps the place where it is written. `like` is removed, `defaults`
// stay, ahead of everything else. Reports a `like` that names nothing or goes in a circle.
void inherit(const std::vector<SceneSection>& sections, Node& root, Problems& problems);

}  // namespace taut::scene
