#include "taut/render/private/label_pass.h"

#include <algorithm>
#include <cmath>

#include "taut/image/private/srgb_curve.h"
#include "taut/image/private/with_alpha.h"

namespace taut::render {

namespace {

constexpr float rimStrength = 0.72F;
constexpr glm::vec3 rimColour(0.006F);  // linear; the plate has it too
constexpr float farthest = 1e5F;        // [px] beyond it nothing can reach into a picture
constexpr float smallestType = 4.0F;    // [px] below it nobody reads
constexpr float largestType = 2000.0F;  // [px]

// A picture that takes colours over its pixels, in light as lights add.
class Canvas {
  public:
    explicit Canvas(image::Image& picture) : picture_(picture) {}

    int width() const { return picture_.width; }
    int height() const { return picture_.height; }
    void lay(int x, int y, glm::vec3 colour, float part) {
        if (part <= 0.0F || x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return;
        const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width);
        std::uint8_t* pixel = picture_.rgb.data() + 3 * (row + static_cast<std::size_t>(x));
        part = image::coverPart(picture_, row + static_cast<std::size_t>(x), part);
        for (int c = 0; c < 3; ++c) pixel[c] = curve_.byte(glm::mix(curve_.light(pixel[c]), colour[c], part));
    }

  private:
    image::Image& picture_;
    image::SrgbCurve curve_;
};

struct PixelPlace {
    int x = 0, y = 0;
};

// Where the pen begins, or nothing if the label cannot be seen.
std::optional<PixelPlace> penOf(const view::Label& label, const glm::mat4& viewProjection, glm::vec2 size,
                                float advance) {
    glm::vec2 at = label.screen * size;
    if (label.at) {
        const glm::vec4 clip = viewProjection * glm::vec4(*label.at, 1.0F);
        if (!(clip.w > 0.0F) || !(clip.z > -clip.w)) return std::nullopt;
        at = size * (0.5F + glm::vec2(0.5F, -0.5F) * glm::vec2(clip) / clip.w);
    }
    at += label.shift * size.y;
    if (label.align == view::Align::centre) at.x -= 0.5F * advance;
    if (label.align == view::Align::right) at.x -= advance;
    if (!(std::abs(at.x) < farthest) || !(std::abs(at.y) < farthest)) return std::nullopt;
    return PixelPlace{static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))};
}

// A plate with round corners behind a line of type; its height is that of the tallest letters, not of these.
void drawPlate(Canvas& canvas, PixelPlace pen, float advance, float pixels, float strength) {
    const glm::vec2 low(static_cast<float>(pen.x) - 0.42F * pixels, static_cast<float>(pen.y) - 1.02F * pixels);
    const glm::vec2 high(static_cast<float>(pen.x) + advance + 0.42F * pixels,
                         static_cast<float>(pen.y) + 0.4F * pixels);
    const float radius = 0.3F * pixels;
    const glm::vec2 middle = 0.5F * (low + high);
    const glm::vec2 half = 0.5F * (high - low) - radius;
    const int top = std::max(0, static_cast<int>(low.y) - 1);
    const int left = std::max(0, static_cast<int>(low.x) - 1);
    for (int y = top; y < std::min(canvas.height(), static_cast<int>(high.y) + 2); ++y) {
        for (int x = left; x < std::min(canvas.width(), static_cast<int>(high.x) + 2); ++x) {
            const glm::vec2 offset = glm::abs(glm::vec2(x, y) + 0.5F - middle) - half;
            const float distance =
                glm::length(glm::max(offset, 0.0F)) + std::min(std::max(offset.x, offset.y), 0.0F) - radius;
            canvas.lay(x, y, rimColour, strength * std::clamp(0.5F - distance, 0.0F, 1.0F));
        }
    }
}

void drawText(Canvas& canvas, PixelPlace pen, const TextPicture& text, glm::vec3 colour) {
    for (int y = 0; y < text.height; ++y) {
        for (int x = 0; x < text.width; ++x) {
            const auto i = static_cast<std::size_t>(y * text.width + x);
            const int column = pen.x + text.left + x;
            const int row = pen.y + text.top + y;
            canvas.lay(column, row, rimColour, rimStrength * static_cast<float>(text.rim[i]) / 255.0F);
            canvas.lay(column, row, colour, static_cast<float>(text.letters[i]) / 255.0F);
        }
    }
}

}  // namespace

void LabelPass::draw(const view::FrameView& view, const glm::mat4& viewProjection, image::Image& picture) {
    if (view.labels.empty()) return;
    const glm::vec2 size(picture.width, picture.height);
    Canvas canvas(picture);
    for (const view::Label& label : view.labels) {
        const float pixels = label.size * size.y;
        if (label.text.empty() || !(pixels >= smallestType)) continue;
        if (!painter_) painter_.emplace(Font(font_));
        const TextPicture text = painter_->picture(label.text, std::min(pixels, largestType));
        const std::optional<PixelPlace> pen = penOf(label, viewProjection, size, text.advance);
        if (!pen) continue;
        if (label.plate > 0.0F && text.width > 0)
            drawPlate(canvas, *pen, text.advance, pixels, std::min(label.plate, 1.0F));
        drawText(canvas, *pen, text, label.colour);
    }
}

}  // namespace taut::render
