// Finds the word that was probably meant. It knows nothing of where the words come from.
#pragma once

#include <string>
#include <vector>

namespace taut::game {

// "; did you mean X?" with the nearest candidate, or nothing when none is near: at most one change in three letters.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace taut::game
