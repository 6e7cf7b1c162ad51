// Texts of `taut play` over its pictures besides the figures: help, switches, and short messages. Independent of the
// session and the window.
#pragma once

#include <chrono>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "taut/image/image.h"
#include "taut/pipeline/overlay.h"
#include "taut/pipeline/painting.h"
#include "taut/render/private/text_picture.h"

namespace taut::game {

// A point with its name, written beside the mouse; places in [px].
struct NamedPoint {
    glm::vec2 point{0.0F}, mouse{0.0F};
    std::string name;
};

struct ScreenContent {
    std::vector<std::string> marks;  // "paused", "recording", … in the upper corner without figures
    std::optional<glm::vec2> hand;   // [px] where the hand holds something; messages leave it free
    std::optional<NamedPoint> named;
};

class PlayScreen {
  public:
    using Clock = std::chrono::steady_clock;

    // The font is for faults of a file; letters of one width are best.
    explicit PlayScreen(const std::filesystem::path& font) : fixed_(render::Font(font)) {}

    // Shows a line at the lower edge for some seconds. A new line replaces it.
    void say(std::string text, double seconds = 4.0);
    bool isSaying() const { return Clock::now() < until_; }

    // Shows the errors of the scene, in as many lines as needed, until the next call; empty: none.
    void showFault(std::string text) { fault_ = std::move(text); }

    void toggleHelp() { isHelping_ = !isHelping_; }

    // Place and size follow from the figures.
    void paint(image::Image& picture, render::TextPainter& letters, const ScreenContent& content,
               const pipeline::OverlayLook& figures);

  private:
    void paintMessage(pipeline::Painting& painting, glm::vec2 size, float em, const ScreenContent& content) const;

    render::TextPainter fixed_;
    std::string message_, fault_;
    Clock::time_point until_ = Clock::now();
    bool isHelping_ = false;
};

}  // namespace taut::game
