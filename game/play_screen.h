// What `taut play` writes over its pictures besides the figures: help, what is on, and messages for a while. It knows
// neither the session nor the window.
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

// A point, and what it is called, written beside the mouse; places in [px].
struct NamedPoint {
    glm::vec2 point{0.0F}, mouse{0.0F};
    std::string name;
};

struct ScreenContent {
    std::vector<std::string> marks;   // "paused", "recording", … in the upper corner where the figures are not
    std::optional<glm::vec2> hand;    // [px] where it holds something: no message over it
    std::optional<NamedPoint> named;
};

class PlayScreen {
  public:
    using Clock = std::chrono::steady_clock;

    // The font for what is wrong with a file, best with letters of one width.
    explicit PlayScreen(const std::filesystem::path& font) : fixed_(render::Font(font)) {}

    // A line at the lower edge, for some seconds; a new one takes its place.
    void say(std::string text, double seconds = 4.0);
    bool isSaying() const { return Clock::now() < until_; }

    // What is wrong with the scene, in as many lines as it has, until the next call; empty: nothing is.
    void showFault(std::string text) { fault_ = std::move(text); }

    void toggleHelp() { isHelping_ = !isHelping_; }

    // The figures say where and how.
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
