// Edit distance of two words, for "did you mean".
#pragma once

#include <string_view>

namespace taut::core {

// How many letters must be inserted, removed, replaced or swapped with their neighbour to turn one word into the other.
int editDistance(std::string_view a, std::string_view b);

}  // namespace taut::core
