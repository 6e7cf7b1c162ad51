// Paints plates, lines and text over a finished picture. Colours are mixed in linear light. Independent of their
// meaning and of GL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "taut/image/image.h"
#include "taut/render/private/text_picture.h"

namespace taut::pipeline {

struct Ink {
    std::uint8_t red = 255, green = 255, blue = 255;  // sRGB
};

struct PictureBox {
    glm::vec2 low{0.0F}, high{0.0F};  // [px] corners from the top left of the picture
};

enum class Side { left, middle, right };

// Coordinates in pixels from the picture's top left corner, y down; the middle of the first pixel is at (½, ½). Parts
// outside the picture are left out. The pixels depend on the arguments alone.
class Painting {
  public:
    // Both must outlive it. Expects a whole picture.
    Painting(image::Image& picture, render::TextPainter& letters);

    // A box with round corners. `strength` 0 (nothing) … 1 (opaque).
    void plate(const PictureBox& box, float radius, Ink ink, float strength);

    // A line through the corners, with round ends, `width` [px] wide. It is no stronger where it crosses itself.
    void line(std::span<const glm::vec2> corners, float width, Ink ink, float strength = 1.0F);

    // A line of text of type size `pixels`. `at` is the left end, middle or right end of its base line, as `side` says.
    void text(glm::vec2 at, Side side, std::string_view text, float pixels, Ink ink);

    // A name at the left end of a span [px] and a value at the right. If both do not fit, the name is shortened.
    void pair(float left, float right, float baseLine, std::string_view name, Ink nameInk, std::string_view value,
              Ink valueInk, float pixels);
    // [px] width that such a span needs for both.
    float pairWidth(std::string_view name, std::string_view value, float pixels);

    float widthOf(std::string_view text, float pixels);  // [px]

  private:
    void lay(int x, int y, const glm::vec3& light, float part);
    std::array<std::array<std::uint8_t, 256>, 3> mixed(const glm::vec3& light, float part) const;

    image::Image& picture_;
    render::TextPainter& letters_;
};

}  // namespace taut::pipeline
