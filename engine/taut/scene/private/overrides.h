// Puts `--set cloth.flag.cells=[72,48]` into a document before it is read, so that one validator checks both.
#pragma once

#include <string>
#include <vector>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

// What an override is called in messages: "--set cloth.flag.cells". Throws core::Error(usage) for one without
// a key and a value.
std::string overrideLabel(const std::string& text);

// Changes the document. `origin` is the override's number from 1. In the place of a name, or of the number of an
// element, * stands for any letters: "block.*.touch" is that of every block. A body, a collider, … that the file lacks,
// an element that a list lacks, and a * that fits nothing, are errors; everything else is left to the reader. A value
// that is not TOML but a plain word is taken as a text.
void applyOverride(const std::string& text, int origin, const std::vector<SceneSection>& sections, Node& root,
                   Problems& problems);

}  // namespace taut::scene
