#include "game/play_figures.h"

#include <algorithm>
#include <cmath>

namespace taut::game {
namespace {

constexpr float around = 16.0F;  // [px] how near the hand may come
constexpr float thin = 0.2F;     // opacity over the body that is pulled
constexpr double fading = 0.1;   // [s] in which two thirds of a fading are done

pipeline::PictureBox mirrored(const pipeline::PictureBox& box, float width) {
    return {{width - box.high.x, box.low.y}, {width - box.low.x, box.high.y}};
}

}  // namespace

bool holds(const pipeline::PictureBox& box, glm::vec2 at, float margin) {
    return at.x > box.low.x - margin && at.x < box.high.x + margin && at.y > box.low.y - margin &&
           at.y < box.high.y + margin;
}

void FiguresPlace::follow(const pipeline::PictureBox& covered, float width, std::optional<glm::vec2> hand,
                          std::span<const glm::vec2> body, double seconds) {
    pipeline::PictureBox box = covered;
    bool isUnder = hand && holds(box, *hand, around);
    if (isUnder && !holds(mirrored(box, width), *hand, around)) {
        isAtRight_ = !isAtRight_;
        box = mirrored(box, width);
        isUnder = false;
    }
    const bool isOverBody = hand && std::ranges::any_of(body, [&](glm::vec2 at) { return holds(box, at, 0.0F); });
    wanted_ = isUnder ? 0.0F : isOverBody ? thin : 1.0F;
    opacity_ += static_cast<float>(1.0 - std::exp(-seconds / fading)) * (wanted_ - opacity_);
    if (std::abs(opacity_ - wanted_) < 0.02F) opacity_ = wanted_;
}

}  // namespace taut::game
