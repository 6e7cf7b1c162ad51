#include "game/play_screen.h"

#include <array>
#include <utility>

#include "game/play_figures.h"
#include "taut/pipeline/painting.h"

namespace taut::game {
namespace {

using pipeline::PictureBox;
using pipeline::Ink;
using pipeline::Painting;
using pipeline::Side;

constexpr Ink plateInk{10, 12, 16}, textInk{240, 243, 247}, keyInk{255, 196, 92}, recordInk{255, 92, 82};

constexpr std::array<std::pair<const char*, const char*>, 14> help{{
    {"left drag", "pull what is under the mouse"},
    {"right drag", "turn the view"},
    {"wheel", "nearer, farther"},
    {"c", "back to the scene's camera"},
    {"space", "pause and go on"},
    {".", "one tick"},
    {"s", "slow motion: 1/2, 1/4, 1/8, 1/16"},
    {"backspace", "from the start"},
    {"m", "next method, from the start"},
    {"+  -", "half or twice the step, from the start"},
    {"d", "springs, strain and contacts"},
    {"o", "figures"},
    {"r", "record; again writes the file"},
    {"h  q", "this help; quit"},
}};

void paintMarks(Painting& painting, float width, float em, bool isAtLeft, const std::vector<std::string>& marks) {
    float edge = isAtLeft ? 0.8F * em : width - 0.8F * em;
    for (const std::string& mark : marks) {
        const float wide = painting.widthOf(mark, em) + 1.2F * em;
        const float left = isAtLeft ? edge : edge - wide;
        painting.plate({{left, 0.8F * em}, {left + wide, 2.5F * em}}, 0.5F * em, plateInk, 0.84F);
        painting.text({left + wide - 0.6F * em, 2.0F * em}, Side::right, mark, em,
                      mark.starts_with("●") ? recordInk : textInk);
        edge += (isAtLeft ? 1.0F : -1.0F) * (wide + 0.4F * em);
    }
}

// Beside the figures.
void paintHelp(Painting& painting, glm::vec2 size, float em, bool isAtLeft) {
    const float line = 1.45F * em, width = 29.0F * em;
    const float height = static_cast<float>(help.size()) * line + 1.4F * em;
    const float left = isAtLeft ? 0.8F * em : size.x - width - 0.8F * em;
    const glm::vec2 corner = glm::round(glm::vec2(left, 0.5F * (size.y - height)));
    painting.plate({corner, corner + glm::vec2(width, height)}, 0.7F * em, plateInk, 0.9F);
    float y = corner.y + 1.7F * em;
    for (const auto& [key, meaning] : help) {
        painting.text({corner.x + 7.2F * em, y}, Side::right, key, em, keyInk);
        painting.text({corner.x + 8.2F * em, y}, Side::left, meaning, em, textInk);
        y += line;
    }
}

}  // namespace

void PlayScreen::say(std::string text, double seconds) {
    message_ = std::move(text);
    until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void PlayScreen::paint(image::Image& picture, render::TextPainter& letters, const std::vector<std::string>& marks,
                       const pipeline::OverlayLook& figures, std::optional<glm::vec2> hand) const {
    const float em = pipeline::typeSize(picture.height, figures.density);
    const glm::vec2 size(picture.width, picture.height);
    Painting painting(picture, letters);
    paintMarks(painting, size.x, em, figures.isAtRight, marks);
    if (isHelping_) paintHelp(painting, size, em, figures.isAtRight);
    if (!isSaying()) return;
    const float half = 0.5F * painting.widthOf(message_, em) + 0.9F * em, middle = 0.5F * size.x;
    const PictureBox plate{{middle - half, size.y - 2.9F * em}, {middle + half, size.y - 1.0F * em}};
    if (hand && holds(plate, *hand, em)) return;
    painting.plate(plate, 0.6F * em, plateInk, 0.84F);
    painting.text({middle, size.y - 1.6F * em}, Side::middle, message_, em, textInk);
}

}  // namespace taut::game
