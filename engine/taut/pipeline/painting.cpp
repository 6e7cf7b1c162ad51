#include "taut/pipeline/painting.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "taut/core/error.h"
#include "taut/image/private/srgb_curve.h"
#include "taut/image/private/with_alpha.h"

namespace taut::pipeline {
namespace {

const image::SrgbCurve& curve() {
    static const image::SrgbCurve made;
    return made;
}

glm::vec3 lightOf(Ink ink) {
    return {curve().light(ink.red), curve().light(ink.green), curve().light(ink.blue)};
}

struct Pixels {
    int left = 0, top = 0, right = 0, bottom = 0;  // the last two are not part of it
};

// The pixels of the picture that the box touches.
Pixels pixelsOf(const PictureBox& box, const image::Image& picture) {
    const glm::vec2 size(picture.width, picture.height);
    const glm::vec2 low = glm::clamp(box.low, glm::vec2(0.0F), size),
                    high = glm::clamp(box.high, glm::vec2(0.0F), size);
    return {static_cast<int>(std::floor(low.x)), static_cast<int>(std::floor(low.y)),
            static_cast<int>(std::ceil(high.x)), static_cast<int>(std::ceil(high.y))};
}

float distanceToSegment(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 along = b - a;
    const float square = glm::dot(along, along);
    const float share = square > 0.0F ? glm::clamp(glm::dot(p - a, along) / square, 0.0F, 1.0F) : 0.0F;
    return glm::length(p - a - share * along);
}

}  // namespace

Painting::Painting(image::Image& picture, render::TextPainter& letters) : picture_(picture), letters_(letters) {
    TAUT_EXPECTS(picture.isWhole());
}

void Painting::lay(int x, int y, const glm::vec3& light, float part) {
    if (part <= 0.0F || x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return;
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width);
    std::uint8_t* pixel = picture_.rgb.data() + 3 * (row + static_cast<std::size_t>(x));
    part = image::coverPart(picture_, row + static_cast<std::size_t>(x), part);
    for (int c = 0; c < 3; ++c) pixel[c] = curve().byte(glm::mix(curve().light(pixel[c]), light[c], part));
}

std::array<std::array<std::uint8_t, 256>, 3> Painting::mixed(const glm::vec3& light, float part) const {
    std::array<std::array<std::uint8_t, 256>, 3> table{};
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < 256; ++i)
            table[c][i] = curve().byte(glm::mix(curve().light(static_cast<std::uint8_t>(i)), light[c], part));
    return table;
}

void Painting::plate(const PictureBox& box, float radius, Ink ink, float strength) {
    const glm::vec3 light = lightOf(ink);
    const auto inside = mixed(light, strength);
    const glm::vec2 middle = 0.5F * (box.low + box.high), half = 0.5F * (box.high - box.low) - radius;
    const Pixels pixels = pixelsOf({box.low - 1.0F, box.high + 1.0F}, picture_);
    for (int y = pixels.top; y < pixels.bottom; ++y) {
        for (int x = pixels.left; x < pixels.right; ++x) {
            const glm::vec2 offset = glm::abs(glm::vec2(x, y) + 0.5F - middle) - half;
            const float distance =
                glm::length(glm::max(offset, 0.0F)) + std::min(std::max(offset.x, offset.y), 0.0F) - radius;
            if (distance > -0.5F || !picture_.alpha.empty()) {
                lay(x, y, light, strength * std::clamp(0.5F - distance, 0.0F, 1.0F));
                continue;
            }
            const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width);
            std::uint8_t* pixel = picture_.rgb.data() + 3 * (row + static_cast<std::size_t>(x));
            for (std::size_t c = 0; c < 3; ++c) pixel[c] = inside[c][pixel[c]];
        }
    }
}

void Painting::line(std::span<const glm::vec2> corners, float width, Ink ink, float strength) {
    if (corners.empty()) return;
    const float reach = 0.5F * width + 0.5F;  // [px] from the middle of the line to where nothing of it is left
    PictureBox box{corners.front(), corners.front()};
    for (const glm::vec2& corner : corners) box = {glm::min(box.low, corner), glm::max(box.high, corner)};
    const Pixels all = pixelsOf({box.low - reach, box.high + reach}, picture_);
    const int columns = all.right - all.left, rows = all.bottom - all.top;
    if (columns <= 0 || rows <= 0) return;

    // How much of each pixel is covered by the whole line, then the ink at once.
    std::vector<float> cover(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0F);
    for (std::size_t i = 0; i < std::max<std::size_t>(1, corners.size() - 1); ++i) {
        const glm::vec2 a = corners[i], b = corners[std::min(i + 1, corners.size() - 1)];
        const Pixels part = pixelsOf({glm::min(a, b) - reach, glm::max(a, b) + reach}, picture_);
        for (int y = part.top; y < part.bottom; ++y) {
            for (int x = part.left; x < part.right; ++x) {
                const float distance = distanceToSegment(glm::vec2(x, y) + 0.5F, a, b);
                float& c = cover[static_cast<std::size_t>(y - all.top) * static_cast<std::size_t>(columns) +
                                 static_cast<std::size_t>(x - all.left)];
                c = std::max(c, std::clamp(reach - distance, 0.0F, std::min(1.0F, width)));
            }
        }
    }
    const glm::vec3 light = lightOf(ink);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            lay(all.left + x, all.top + y, light,
                strength * cover[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) +
                                 static_cast<std::size_t>(x)]);
}

void Painting::text(glm::vec2 at, Side side, std::string_view text, float pixels, Ink ink) {
    const render::TextPicture letters = letters_.picture(text, pixels);
    if (side == Side::middle) at.x -= 0.5F * letters.advance;
    if (side == Side::right) at.x -= letters.advance;
    const int left = static_cast<int>(std::lround(at.x)) + letters.left;
    const int top = static_cast<int>(std::lround(at.y)) + letters.top;
    const glm::vec3 light = lightOf(ink);
    for (int y = 0; y < letters.height; ++y)
        for (int x = 0; x < letters.width; ++x)
            lay(left + x, top + y, light, static_cast<float>(letters.letters[y * letters.width + x]) / 255.0F);
}

void Painting::pair(float left, float right, float baseLine, std::string_view name, Ink nameInk, std::string_view value,
                    Ink valueInk, float pixels) {
    const float room = right - left - pairWidth("", value, pixels);
    std::string shown(name);
    while (!shown.empty() && widthOf(shown, pixels) > room) {
        if (shown.ends_with("…")) shown.resize(shown.size() - std::string_view("…").size());
        while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xC0U) == 0x80U) shown.pop_back();
        if (!shown.empty()) shown.pop_back();
        if (!shown.empty()) shown += "…";
    }
    text({left, baseLine}, Side::left, shown, pixels, nameInk);
    text({right, baseLine}, Side::right, value, pixels, valueInk);
}

float Painting::pairWidth(std::string_view name, std::string_view value, float pixels) {
    constexpr float gap = 0.5F;  // in sizes of the type
    return widthOf(name, pixels) + gap * pixels + widthOf(value, pixels);
}

float Painting::widthOf(std::string_view text, float pixels) {
    return letters_.picture(text, pixels).advance;
}

}  // namespace taut::pipeline
