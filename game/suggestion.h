// Finds the word that was probably meant. It does not know where the words come from.
#pragma once

#include <string>
#include <vector>

namespace taut::game {

// "; did you mean X?" with the nearest candidate, with at most one change in three letters. Empty if none is near.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace taut::game
