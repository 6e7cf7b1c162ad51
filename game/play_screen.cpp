#include "game/play_screen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "game/play_figures.h"
#include "taut/pipeline/painting.h"

namespace taut::game {
namespace {

using pipeline::Ink;
using pipeline::Painting;
using pipeline::PictureBox;
using pipeline::Side;

constexpr Ink plateInk{10, 12, 16}, textInk{240, 243, 247}, keyInk{255, 196, 92}, recordInk{255, 92, 82},
    faultInk{54, 12, 12};

constexpr std::array<std::pair<const char*, const char*>, 16> help{{
    {"left drag", "pull"},
    {"right drag", "turn the view"},
    {"wheel", "zoom"},
    {"c", "scene's camera"},
    {"space", "pause"},
    {".", "one tick"},
    {"s", "slow motion: 1/2, 1/4, 1/8, 1/16"},
    {"backspace", "restart"},
    {"m", "next method, restart"},
    {"+  -", "half or twice the step, restart"},
    {"d", "springs, strain and contacts"},
    {"o", "figures"},
    {"n", "the name of the point under the mouse"},
    {"y", "copy that name"},
    {"r", "start recording; again writes the file"},
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

// The name to the right of the mouse and above it, or where else there is room, and a ring about the point.
void paintName(Painting& painting, glm::vec2 size, float em, const NamedPoint& named) {
    std::vector<glm::vec2> ring;
    constexpr int corners = 16;
    for (int i = 0; i <= corners; ++i) {
        const float angle = 6.2831853F * static_cast<float>(i) / corners;
        ring.push_back(named.point + 0.45F * em * glm::vec2(std::cos(angle), std::sin(angle)));
    }
    painting.line(ring, 0.34F * em, plateInk);
    painting.line(ring, 0.16F * em, keyInk);
    const glm::vec2 extent(painting.widthOf(named.name, em) + 1.2F * em, 1.7F * em);
    glm::vec2 corner = named.mouse + glm::vec2(em, -em - extent.y);
    if (corner.y < 0.0F) corner.y = named.mouse.y + 2.0F * em;
    corner.x = std::clamp(corner.x, 0.0F, std::max(0.0F, size.x - extent.x));
    painting.plate({corner, corner + extent}, 0.5F * em, plateInk, 0.84F);
    painting.text(corner + glm::vec2(0.6F * em, 1.2F * em), Side::left, named.name, em, textInk);
}

// In lines of so many characters at most; the rest goes on in the next one.
std::vector<std::string> wrapped(const std::string& text, std::size_t columns) {
    std::vector<std::string> lines(1);
    std::size_t column = 0;
    for (const char c : text) {
        const bool isFirst = (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // byte of a character
        if (c == '\n' || (isFirst && column == columns)) {
            lines.emplace_back();
            column = 0;
        }
        if (c == '\n') continue;
        lines.back() += c;
        column += isFirst ? 1 : 0;
    }
    while (!lines.empty() && lines.back().empty()) lines.pop_back();
    return lines;
}

// Above the messages at the lower edge; as many lines as the picture has room for.
void paintFault(Painting& painting, glm::vec2 size, float em, const std::string& fault) {
    const float line = 1.4F * em, edge = 0.8F * em;
    const auto columns = static_cast<std::size_t>(std::max(8.0F, (size.x - 4.0F * edge) / painting.widthOf("0", em)));
    std::vector<std::string> lines = wrapped(fault, columns);
    const auto most = static_cast<std::size_t>(std::max(2.0F, (size.y - 6.0F * em) / line));
    if (lines.size() > most) {
        lines.resize(most);
        lines.back() = "…";
    }
    const float height = static_cast<float>(lines.size()) * line + 1.2F * em;
    const float top = std::round(size.y - 3.3F * em - height);
    painting.plate({{edge, top}, {size.x - edge, top + height}}, 0.7F * em, faultInk, 0.93F);
    float y = top + 1.6F * em;
    for (const std::string& text : lines) {
        painting.text({2.0F * edge, y}, Side::left, text, em, textInk);
        y += line;
    }
}

}  // namespace

void PlayScreen::say(std::string text, double seconds) {
    message_ = std::move(text);
    until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

void PlayScreen::paint(image::Image& picture, render::TextPainter& letters, const ScreenContent& content,
                       const pipeline::OverlayLook& figures) {
    const float em = pipeline::typeSize(picture.height, figures.density);
    const glm::vec2 size(picture.width, picture.height);
    Painting painting(picture, letters);
    paintMarks(painting, size.x, em, figures.isAtRight, content.marks);
    if (content.named) paintName(painting, size, em, *content.named);
    if (!fault_.empty()) {
        Painting fixed(picture, fixed_);
        paintFault(fixed, size, em, fault_);
    }
    if (isHelping_) paintHelp(painting, size, em, figures.isAtRight);
    if (isSaying()) paintMessage(painting, size, em, content);
}

void PlayScreen::paintMessage(Painting& painting, glm::vec2 size, float em, const ScreenContent& content) const {
    const float half = 0.5F * painting.widthOf(message_, em) + 0.9F * em, middle = 0.5F * size.x;
    const PictureBox plate{{middle - half, size.y - 2.9F * em}, {middle + half, size.y - 1.0F * em}};
    if (content.hand && holds(plate, *content.hand, em)) return;
    painting.plate(plate, 0.6F * em, plateInk, 0.84F);
    painting.text({middle, size.y - 1.6F * em}, Side::middle, message_, em, textInk);
}

}  // namespace taut::game
