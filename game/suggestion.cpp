#include "game/suggestion.h"

#include <algorithm>

#include "taut/core/private/edit_distance.h"

namespace taut::game {

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates) {
    const std::string* best = nullptr;
    int least = 1 + std::max(1, static_cast<int>(word.size()) / 3);
    for (const std::string& candidate : candidates) {
        const int distance = core::editDistance(word, candidate);
        if (distance < least) {
            least = distance;
            best = &candidate;
        }
    }
    return best == nullptr ? "" : "; did you mean " + *best + "?";
}

}  // namespace taut::game
