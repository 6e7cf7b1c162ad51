// A line of text as coverage, ready to be laid over a picture: its letters and their dark rim. It knows neither
// colours nor places.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "taut/render/private/font.h"

namespace taut::render {

struct TextPicture {
    float advance = 0;      // [px] from the first pen position to the last
    int left = 0, top = 0;  // [px] of the first column and row from the pen on the base line; down is positive
    int width = 0, height = 0;
    std::vector<std::uint8_t> letters, rim;  // (height · width) rows from the top; the rim lies under the letters too
};

// The characters of UTF-8; each faulty byte becomes U+FFFD.
std::u32string charactersOf(std::string_view text);

// Draws lines of text and keeps each letter that it has drawn, as texts change from picture to picture.
class TextPainter {
  public:
    explicit TextPainter(Font font) : font_(std::move(font)) {}

    // At a size of the type of `pixels` [px], letters placed to a quarter of a pixel and kerned.
    TextPicture picture(std::string_view text, float pixels);

  private:
    struct Key {
        int glyph, quarter;
        float pixels;
        auto operator<=>(const Key&) const = default;
    };
    const Glyph& glyph(const Key& key);

    Font font_;
    std::map<Key, Glyph> glyphs_;
};

}  // namespace taut::render
