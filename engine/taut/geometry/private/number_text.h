// Numbers as text, quickly. It knows no format.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

namespace taut::geometry {

// Appends a number rounded to `digits` (1 … 9) behind the point, without noughts at the end.
void appendNumber(std::string& text, double value, int digits);

// Appends "[(x, y, z), …]".
void appendVectors(std::string& text, std::span<const glm::vec3> vectors, int digits);

// Appends the shortest text that reads back to the same number: up to 17 digits.
void appendExactly(std::string& text, double value);

}  // namespace taut::geometry
