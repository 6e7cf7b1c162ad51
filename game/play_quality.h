// How finely `taut play` draws: levels from coarse to the scene's own, each with the cost of a picture. It knows
// neither the renderer nor which level there is time for.
#pragma once

#include <string>
#include <vector>

namespace taut::world {
struct PictureSpec;
}

namespace taut::game {

struct DrawingLevel {
    std::string name;       // "normal"
    double size = 1.0;      // of the window's pixels, along an edge
    int samples = 1;        // of anti-aliasing
    int shadowSize = 1024;  // [texels]
    bool occlusion = true;  // things darken the ground around them
    double cost = 1.0;      // of a picture, in processor time [ms]; only the ratio of levels counts

    int pixels(int length) const;  // of the window's length
    bool looksAs(const DrawingLevel& other) const;
};

// Ascending. The last is as the scene has it, and none is finer.
std::vector<DrawingLevel> drawingLevels(const world::PictureSpec& scene);

// "draft", "normal" or "full", as in the flag --quality. Only "full" depends on the scene.
DrawingLevel levelNamed(const std::string& name, const world::PictureSpec& scene);

}  // namespace taut::game
