// The lights of a view, as drawing needs them: the sun, then the lamps. Pure geometry, it knows no GL.
#pragma once

#include <compare>
#include <span>
#include <string>
#include <vector>

#include "taut/render/private/light_box.h"
#include "taut/view/frame_view.h"

namespace taut::render {

// The lights that shaders are compiled for.
struct LightKind {
    int lamps = 0;
    int lampShadows = 0;    // that throw shadows
    bool isWide = false;    // penumbrae go beyond the bounds that narrow lights are content with
    bool isAround = false;  // from a picture of all that is around
    auto operator<=>(const LightKind&) const = default;
};

// The definitions for the shaders that light surfaces.
std::vector<std::string> definitionsOf(const LightKind& kind);

// The casters of shadows.
struct Shadower {
    LightBox box;
    float softness = 0.0F;  // [rad] apparent size of the light
    int blocks = 2;         // of the map of bounds, to each side, that are gathered for a wide light
    float reach() const { return static_cast<float>(blocks) - 0.5F; }  // [blocks] from any place that these bound
};

struct LightSet {
    LightKind kind;
    Shadower sun;
    std::vector<view::Lamp> lamps;      // casters of shadows first
    std::vector<Shadower> lampShadows;  // (kind.lampShadows)
};

// LightSet wider than this [rad] have penumbrae of the correct width; other penumbrae, some pixels wide in a picture,
// end at 1.2 % of the distance of the caster.
inline constexpr float widestNarrow = 0.07F;

// `casters` are boxes around all that throws shadows, `texels` the edge of each shadow map. Expects mostLamps lamps at
// most.
LightSet lightsOf(const view::FrameView& view, std::span<const Bounds> casters, float aspect, int texels);

}  // namespace taut::render
