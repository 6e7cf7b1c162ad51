#include "taut/render/private/text_picture.h"

#include <algorithm>
#include <cmath>

namespace taut::render {

namespace {

constexpr std::size_t mostGlyphs = 4096;  // kept; a long run with a text that grows starts anew
constexpr float rimShare = 0.1F;          // reach of the rim, as a share of the size of the type
constexpr float leastRim = 1.6F;          // [px]
constexpr float longest = 32768.0F;       // [px] a line ends there: no picture is wider

struct Placed {
    const Glyph* glyph;
    int pen;  // [px]
};

// What a pixel of a letter gives to the rim around it, by offset: full nearby, fading to nothing at `reach`.
struct Brush {
    struct Bristle {
        int x, y, strength;  // 0 … 256
    };
    explicit Brush(float reach) : radius(static_cast<int>(std::ceil(reach))) {
        for (int y = -radius; y <= radius; ++y) {
            for (int x = -radius; x <= radius; ++x) {
                const float distance = std::sqrt(static_cast<float>(x * x + y * y));
                const float part = std::clamp((reach + 0.5F - distance) / (0.7F * reach), 0.0F, 1.0F);
                const int strength = static_cast<int>(256.0F * part);
                if (strength > 0) bristles.push_back({x, y, strength});
            }
        }
    }
    int radius;
    std::vector<Bristle> bristles;
};

void drawRim(TextPicture& text, const Brush& brush) {
    for (int y = 0; y < text.height; ++y) {
        for (int x = 0; x < text.width; ++x) {
            const int ink = text.letters[static_cast<std::size_t>(y * text.width + x)];
            if (ink == 0) continue;
            for (const Brush::Bristle& bristle : brush.bristles) {
                std::uint8_t& rim = text.rim[static_cast<std::size_t>((y + bristle.y) * text.width + x + bristle.x)];
                rim = std::max(rim, static_cast<std::uint8_t>(std::min(255, ink * bristle.strength >> 8)));
            }
        }
    }
}

}  // namespace

std::u32string charactersOf(std::string_view text) {
    std::u32string characters;
    std::size_t i = 0;
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
    while (i < text.size()) {
        const unsigned first = byte(i);
        const std::size_t length = first < 0x80   ? 1
                                   : first < 0xC2 ? 0
                                   : first < 0xE0 ? 2
                                   : first < 0xF0 ? 3
                                   : first < 0xF5 ? 4
                                                  : 0;
        char32_t value = length == 1 ? first : first & (0x7FU >> length);
        bool isWhole = length > 0 && i + length <= text.size();
        for (std::size_t k = 1; isWhole && k < length; ++k) {
            isWhole = (byte(i + k) & 0xC0U) == 0x80U;
            value = value << 6U | (byte(i + k) & 0x3FU);
        }
        characters.push_back(isWhole ? value : U'\uFFFD');
        i += isWhole ? length : 1;
    }
    return characters;
}

const Glyph& TextPainter::glyph(const Key& key) {
    const auto known = glyphs_.find(key);
    if (known != glyphs_.end()) return known->second;
    const float shift = 0.25F * static_cast<float>(key.quarter);
    return glyphs_.emplace(key, font_.drawn(key.glyph, key.pixels, shift)).first->second;
}

TextPicture TextPainter::picture(std::string_view text, float pixels) {
    if (glyphs_.size() > mostGlyphs) glyphs_.clear();
    const std::u32string characters = charactersOf(text);
    std::vector<int> numbers;
    for (const char32_t character : characters) numbers.push_back(font_.glyphOf(character));

    // Where each letter stands, and the box of all.
    TextPicture result;
    std::vector<Placed> placed;
    int right = 0, bottom = 0;
    for (std::size_t i = 0; i < numbers.size() && result.advance < longest; ++i) {
        const int quarters = static_cast<int>(std::lround(4.0F * result.advance));
        const Placed letter{&glyph({numbers[i], quarters & 3, pixels}), quarters >> 2};
        result.advance += font_.advance(numbers[i], i + 1 < numbers.size() ? numbers[i + 1] : -1, pixels);
        if (letter.glyph->coverage.empty()) continue;
        const int left = letter.pen + letter.glyph->left;
        const bool isFirst = placed.empty();
        result.left = isFirst ? left : std::min(result.left, left);
        result.top = isFirst ? letter.glyph->top : std::min(result.top, letter.glyph->top);
        right = isFirst ? left + letter.glyph->width : std::max(right, left + letter.glyph->width);
        const int low = letter.glyph->top + letter.glyph->height;
        bottom = isFirst ? low : std::max(bottom, low);
        placed.push_back(letter);
    }
    if (placed.empty()) return result;

    const Brush brush(std::max(leastRim, rimShare * pixels));
    result.left -= brush.radius;
    result.top -= brush.radius;
    result.width = right - result.left + brush.radius;
    result.height = bottom - result.top + brush.radius;
    result.letters.resize(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height));
    result.rim = result.letters;
    for (const Placed& letter : placed) {
        const Glyph& glyph = *letter.glyph;
        for (int y = 0; y < glyph.height; ++y) {
            for (int x = 0; x < glyph.width; ++x) {
                const int column = letter.pen + glyph.left - result.left + x;
                std::uint8_t& ink =
                    result.letters[static_cast<std::size_t>((glyph.top - result.top + y) * result.width + column)];
                ink = std::max(ink, glyph.coverage[static_cast<std::size_t>(y * glyph.width + x)]);
            }
        }
    }
    drawRim(result, brush);
    return result;
}

}  // namespace taut::render
