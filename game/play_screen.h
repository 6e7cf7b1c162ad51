// What `taut play` writes over its pictures besides the figures: help, what is on, and messages for a while. It knows
// neither the session nor the window.
#pragma once

#include <chrono>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "taut/image/image.h"
#include "taut/pipeline/overlay.h"
#include "taut/render/private/text_picture.h"

namespace taut::game {

class PlayScreen {
  public:
    using Clock = std::chrono::steady_clock;

    // A line at the lower edge, for some seconds; a new one takes its place.
    void say(std::string text, double seconds = 4.0);
    bool isSaying() const { return Clock::now() < until_; }

    void toggleHelp() { isHelping_ = !isHelping_; }

    // marks: "paused", "recording", … in the upper corner where the figures are not; those say where and how. No
    // message over the hand [px], where it holds something.
    void paint(image::Image& picture, render::TextPainter& letters, const std::vector<std::string>& marks,
               const pipeline::OverlayLook& figures, std::optional<glm::vec2> hand) const;

  private:
    std::string message_;
    Clock::time_point until_ = Clock::now();
    bool isHelping_ = false;
};

}  // namespace taut::game
