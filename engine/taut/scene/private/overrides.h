// Puts `--set cloth.flag.cells=[72,48]` into a document before it is read, so that one validator checks both.
#pragma once

#include <string>
#include <vector>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

// The name of an override in messages: "--set cloth.flag.cells", or the flag that stands for it, which follows as a
// comment: `picture.camera="side" # --camera`. Throws core::Error(usage) for one without a key and a value.
std::string overrideLabel(const std::string& text);

// Changes the document. `origin` is the override's number from 1. Instead of a name, or of the number of an element, *
// stands for any letters: "block.*.touch" is that of every block. A missing body, collider, … or list element, and a *
// that matches nothing, are errors. The reader checks everything else. A value that is a plain word, and no TOML,
// counts as a text.
void applyOverride(const std::string& text, int origin, const std::vector<SceneSection>& sections, Node& root,
                   Problems& problems);

}  // namespace taut::scene
