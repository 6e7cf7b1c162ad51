// Scenes from bytes by a grammar, so that every byte string is one that can be played: a few tiny bodies near each
// other, of all kinds, methods and numbers, with actions. It plays nothing.
#pragma once

#include <string>

#include "fuzz/targets.h"

namespace taut::fuzz {

struct GrownScene {
    std::string text;       // TOML
    bool isClosed = false;  // nothing puts energy in
};

// A byte that is not there counts as 0, of which the plainest comes: less bytes, a smaller scene.
GrownScene grownScene(View bytes);

}  // namespace taut::fuzz
