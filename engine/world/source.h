// The words that several parts of a scene share.
#pragma once

#include "taut/core/source.h"

namespace taut::world {

using core::Source;

// Ways from one key to the next, as animators name them.
enum class Ease { linear, smooth, in, out, hold };

}  // namespace taut::world
