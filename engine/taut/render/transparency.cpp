#include "taut/render/private/transparency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "taut/image/private/srgb_curve.h"

namespace taut::render {

namespace {

// What the ground shows in full light, as bytes: filmic() of shaders/tone.glsl.
std::array<float, 3> litGround(const view::FrameView& view) {
    if (!view.ground) return {};
    const float facing = std::max(-glm::normalize(view.light.direction).y, 0.0F);
    const glm::vec3 light =
        view.ground->colour * (facing / std::numbers::pi_v<float> * view.light.colour + view.light.sky);
    const image::SrgbCurve curve;
    std::array<float, 3> bytes{};
    for (int c = 0; c < 3; ++c) {
        const float x = 0.75F * light[c];
        const float shown = std::clamp((x * (2.51F * x + 0.03F)) / (x * (2.43F * x + 0.59F) + 0.14F), 0.0F, 1.0F);
        bytes[static_cast<std::size_t>(c)] = static_cast<float>(curve.byte(shown));
    }
    return bytes;
}

}  // namespace

std::vector<std::uint8_t> takeShadows(const view::FrameView& view, std::span<std::uint32_t> colours) {
    const std::array<float, 3> ground = litGround(view);
    std::vector<std::uint8_t> alpha(colours.size(), 255);
    for (std::size_t i = 0; i < colours.size(); ++i) {
        if (colours[i] >> 24 != 0) continue;
        const std::array<std::uint32_t, 3> left{colours[i] & 255U, colours[i] >> 8 & 255U, colours[i] >> 16 & 255U};
        const std::uint32_t least = std::min({left[0], left[1], left[2]});
        alpha[i] = static_cast<std::uint8_t>(255U - least);
        colours[i] = 0;
        if (least == 255U) continue;
        // What the least leaves out of the other channels is the shadow's own colour.
        for (std::size_t c = 0; c < 3; ++c) {
            const float own = ground[c] * static_cast<float>(left[c] - least) / static_cast<float>(255U - least);
            colours[i] |= static_cast<std::uint32_t>(own + 0.5F) << (8 * c);
        }
    }
    return alpha;
}

}  // namespace taut::render
