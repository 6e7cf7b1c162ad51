// The place of the figures of `taut play`: out of the way of what is pulled. It paints nothing.
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
    // covered: what the figures cover in the present picture of that width. hand, body: where the hand and points of
    // the pulled body are [px]. `seconds` since the last call.
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
