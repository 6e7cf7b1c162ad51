// Lays the labels of a view over its finished picture. It works on the pixels themselves, so that every GL gives the
// same letters.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>

#include "taut/image/image.h"
#include "taut/render/private/text_picture.h"
#include "taut/view/frame_view.h"

namespace taut::render {

class LabelPass {
  public:
    // The font is read when the first label is drawn; an empty path is the default font.
    explicit LabelPass(std::filesystem::path font) : font_(std::move(font)) {}

    // Labels behind the camera or beyond the edges are left out. Throws as Font does.
    void draw(const view::FrameView& view, const glm::mat4& viewProjection, image::Image& picture);

  private:
    std::filesystem::path font_;
    std::optional<TextPainter> painter_;
};

}  // namespace taut::render
