// Words that several parts of a scene share.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "taut/core/finding.h"

namespace taut::world {

using core::at;
using core::Source;
using core::warningAt;
using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

// Ways from one key to the next, with animators' names.
enum class Ease { linear, smooth, in, out, hold };

}  // namespace taut::world
