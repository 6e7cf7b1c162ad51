// Small scenes and pixels for the tests of the renderer.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <memory>

#include "taut/render/renderer.h"
#include "taut/view/primitives.h"

namespace taut::render::test {

inline RendererOptions smallOptions() {
    RendererOptions options;
    options.width = 320;
    options.height = 180;
    options.shaders = std::filesystem::path(TAUT_SOURCE_DIR) / "shaders";
    return options;
}

inline image::Image pictureOf(const view::FrameView& view, const RendererOptions& options = smallOptions()) {
    return Renderer(options).draw(view);
}

using Pixel = std::array<int, 3>;

inline Pixel pixelAt(const image::Image& picture, int x, int y) {
    const auto* first = picture.rgb.data() + 3 * (static_cast<std::size_t>(y * picture.width + x));
    return {first[0], first[1], first[2]};
}

// The pixel in which a place of the world is seen.
inline Pixel pixelOf(const image::Image& picture, const view::Camera& camera, glm::vec3 place) {
    const glm::vec2 size(picture.width, picture.height);
    const glm::vec4 clip = glm::perspective(camera.fieldOfView, size.x / size.y, camera.nearPlane, camera.farPlane) *
                           glm::lookAt(camera.eye, camera.target, camera.up) * glm::vec4(place, 1.0F);
    const glm::vec2 at = size * (0.5F + glm::vec2(0.5F, -0.5F) * glm::vec2(clip) / clip.w);
    return pixelAt(picture, static_cast<int>(at.x), static_cast<int>(at.y));
}

inline int brightness(const Pixel& pixel) {
    return pixel[0] + pixel[1] + pixel[2];
}

// IEC 61966-2-1, 0 … 255.
inline float srgb(float linear) {
    return 255.0F * (linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F);
}

// The tone curve of shaders/tone.glsl.
inline float filmic(float light) {
    const float x = 0.75F * light;
    return x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F);
}

// The light that a byte of a picture stands for: both curves backwards.
inline float lightOf(int byte) {
    const float c = static_cast<float>(byte) / 255.0F;
    const float y = c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
    const float a = 2.51F - 2.43F * y, b = 0.03F - 0.59F * y;
    return (std::sqrt(b * b + 0.56F * a * y) - b) / (2.0F * a) / 0.75F;
}

inline view::Surface surface(const view::Mesh& mesh, glm::vec3 at, glm::vec3 colour) {
    view::Finish finish;
    finish.front = finish.back = colour;
    finish.roughness = 1.0F;
    view::Surface result;
    result.topology = mesh.topology;
    result.geometry = mesh.geometry;
    result.finish = std::make_shared<const view::Finish>(finish);
    result.transform = glm::translate(glm::mat4(1.0F), at);
    return result;
}

// A floor seen obliquely from above, in sunlight from straight above.
inline view::FrameView floorView() {
    view::FrameView view;
    view.camera.eye = {0.0F, 3.0F, 5.0F};
    view.camera.target = {0.0F, 0.0F, 0.0F};
    view.light.direction = {0.0F, -1.0F, 0.0F};
    view.ground = view::Ground{};
    view.ground->gridSpacing = 0.0F;
    return view;
}

}  // namespace taut::render::test
