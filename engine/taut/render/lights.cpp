#include "taut/render/private/lights.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/render/private/shadow_map.h"

namespace taut::render {

namespace {

constexpr int mostBlocks = 32;  // a quarter of the map

// [m] The longest way of light between things, and from them to the ground.
float longestWay(const view::FrameView& view, const LightBox& box, std::span<const Bounds> casters) {
    float way = box.size.z;
    if (!view.ground) return way;
    for (const Bounds& caster : casters)
        if (!caster.empty) way = std::max(way, (caster.high.y - view.ground->height) / towardsLight(box).y);
    return way;
}

// [m] To each side of an edge.
float widestPenumbra(const view::FrameView& view, const LightBox& box, std::span<const Bounds> casters,
                     float softness) {
    const float largest = std::max(box.size.x, box.size.y);
    return std::min(std::tan(0.5F * softness) * longestWay(view, box, casters), largest);
}

// So many blocks that a penumbra is within them.
int blocksFor(const LightBox& box, float penumbra) {
    const float blocks = penumbra * static_cast<float>(boundsEdge) / std::min(box.size.x, box.size.y);
    return std::clamp(static_cast<int>(std::ceil(blocks + 0.5F)), Shadower{}.blocks, mostBlocks);
}

}  // namespace

std::vector<std::string> definitionsOf(const LightKind& kind) {
    std::vector<std::string> definitions{"LAMPS " + std::to_string(kind.lamps),
                                         "LAMP_SHADOWS " + std::to_string(kind.lampShadows)};
    if (kind.isWide) definitions.emplace_back("WIDE");
    if (kind.isAround) definitions.emplace_back("ENVIRONMENT");
    return definitions;
}

LightSet lightsOf(const view::FrameView& view, std::span<const Bounds> casters, float aspect, int texels) {
    TAUT_EXPECTS(view.lamps.size() <= view::mostLamps);
    LightSet lights;
    lights.kind.isAround = view.environment.has_value();
    const auto shadower = [&](glm::vec3 direction, float softness) {
        const LightBox box = lightBox(view, direction, casters, aspect, texels);
        if (softness <= widestNarrow) return Shadower{box, softness};
        // What is not above the map is lit: it reaches as far as penumbrae do.
        lights.kind.isWide = true;
        const float penumbra = widestPenumbra(view, box, casters, softness);
        const LightBox wide = lightBox(view, direction, casters, aspect, texels, penumbra);
        return Shadower{wide, softness, blocksFor(wide, penumbra)};
    };
    lights.sun = shadower(view.light.direction, view.light.softness);
    lights.lamps = view.lamps;
    std::stable_partition(lights.lamps.begin(), lights.lamps.end(), [](const view::Lamp& lamp) { return lamp.shadow; });
    for (const view::Lamp& lamp : lights.lamps)
        if (lamp.shadow) lights.lampShadows.push_back(shadower(lamp.direction, lamp.softness));
    lights.kind.lamps = static_cast<int>(lights.lamps.size());
    lights.kind.lampShadows = static_cast<int>(lights.lampShadows.size());
    return lights;
}

}  // namespace taut::render
