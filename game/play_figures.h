// Where the figures of `taut play` stand: out of the way of what is pulled. It paints nothing.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "taut/pipeline/overlay.h"

namespace taut::game {

// Whether the box holds the place, or has it no farther away than `margin`, all in [px].
bool holds(const pipeline::PictureBox& box, glm::vec2 at, float margin);

class FiguresPlace {
  public:
    // What the figures cover in the picture now, of that width, and what is pulled [px]: where the hand has it, and
    // points of its body. `seconds` since the last call.
    void follow(const pipeline::PictureBox& covered, float width, std::optional<glm::vec2> hand,
                std::span<const glm::vec2> body, double seconds);

    bool isAtRight() const { return isAtRight_; }
    float opacity() const { return opacity_; }
    bool isFading() const { return opacity_ != wanted_; }

  private:
    bool isAtRight_ = false;
    float opacity_ = 1.0F, wanted_ = 1.0F;
};

}  // namespace taut::game
