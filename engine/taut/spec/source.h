// Words that several parts of a scene share.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "taut/core/source.h"

namespace taut::world {

using core::Source;
using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

// "file:line:column: error: " of a source, or less if the source has less.
std::string at(const Source& source);
// The message, or one that begins with it, as a warning.
std::string asWarning(std::string message);

// Ways from one key to the next, with animators' names.
enum class Ease { linear, smooth, in, out, hold };

}  // namespace taut::world
