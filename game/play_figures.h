// The place of the figures of `taut play`, clear of the pulled body. It paints nothing.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "taut/pipeline/overlay.h"

namespace taut::game {

// Whether the place is in the box or at most `margin` away from it, all in [px].
bool holds(const pipeline::PictureBox& box, glm::vec2 at, float margin);

class FiguresPlace {
  public:
    // covered: the area of the figures in the present picture of that width. hand, body: places of the hand and of
    // points of the pulled body [px]. `seconds` since the last call.
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
