// A TrueType font: outlines to coverage at a given size. It knows neither labels nor pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace taut::render {

// The font that Debian's package fonts-dejavu-core installs; empty if it is not there.
std::filesystem::path defaultFont();

// One drawn letter.
struct Glyph {
    int left = 0, top = 0;  // [px] of its first column and row from the pen on the base line; down is positive
    int width = 0, height = 0;
    std::vector<std::uint8_t> coverage;  // (height · width) rows from the top
};

class Font {
  public:
    // An empty path stands for defaultFont(). Throws Error(inputOutput) for a file that is not there or cannot be read,
    // Error(badContent) for one that is no TrueType font. The file is trusted: its tables are not checked.
    explicit Font(const std::filesystem::path& file);
    ~Font();
    Font(Font&&) noexcept;

    // Number of the glyph of a character; 0, an empty box, for one that the font lacks.
    int glyphOf(char32_t character) const;

    // At a size of the type of `pixels` [px]. `shift` [px] moves the outline to the right by a part of a pixel.
    Glyph drawn(int glyph, float pixels, float shift) const;

    // [px] From this pen position to that of the next glyph; `next` < 0 is none.
    float advance(int glyph, int next, float pixels) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::render
