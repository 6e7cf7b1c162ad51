#include "game/play_quality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "taut/core/error.h"
#include "taut/spec/picture_spec.h"

namespace taut::game {
namespace {

// Costs are those of the curtain in a window of 512 × 288. 0: the scene's.
const std::array<DrawingLevel, 7> everyLevel{{
    {"coarse", 0.5, 1, 256, false, 6.5},
    {"rough", 0.75, 1, 512, false, 8.5},
    {"low", 0.75, 1, 512, true, 12.0},
    {"draft", 1.0, 1, 512, true, 15.5},
    {"normal", 1.0, 1, 1024, true, 18.5},
    {"fine", 1.0, 4, 1024, true, 21.0},
    {"full", 1.0, 0, 0, true, 28.0},
}};

}  // namespace

int DrawingLevel::pixels(int length) const {
    return std::max(1, static_cast<int>(std::lround(size * length)));
}

bool DrawingLevel::looksAs(const DrawingLevel& other) const {
    return size == other.size && samples == other.samples && shadowSize == other.shadowSize &&
           occlusion == other.occlusion;
}

std::vector<DrawingLevel> drawingLevels(const world::PictureSpec& scene) {
    std::vector<DrawingLevel> levels;
    for (DrawingLevel level : everyLevel) {
        level.samples = level.samples == 0 ? scene.samples : std::min(level.samples, scene.samples);
        level.shadowSize = level.shadowSize == 0 ? scene.shadowSize : std::min(level.shadowSize, scene.shadowSize);
        if (!levels.empty() && levels.back().looksAs(level)) levels.pop_back();
        levels.push_back(level);
    }
    return levels;
}

DrawingLevel levelNamed(const std::string& name, const world::PictureSpec& scene) {
    const auto found = std::ranges::find(everyLevel, name, &DrawingLevel::name);
    TAUT_EXPECTS(found != everyLevel.end());
    DrawingLevel level = *found;
    if (level.samples == 0) level.samples = scene.samples;
    if (level.shadowSize == 0) level.shadowSize = scene.shadowSize;
    return level;
}

}  // namespace taut::game
