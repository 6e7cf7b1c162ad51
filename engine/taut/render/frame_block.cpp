#include "taut/render/private/frame_block.h"

#include <cmath>
#include <numbers>

#include "taut/view/camera_axes.h"

namespace taut::render {

namespace {

// Radiance that a white surface which faces a light sends back.
glm::vec3 sentBack(glm::vec3 colour) {
    return colour / std::numbers::pi_v<float>;
}

// How wide a penumbra is 1 m behind what throws the shadow; of a narrow light as good as its size.
float penumbraOf(float softness) {
    return softness > widestNarrow ? 2.0F * std::tan(0.5F * softness) : softness;
}

glm::vec4 mapSizeOf(const LightBox& box, int texels) {
    return {box.size, glm::max(box.size.x, box.size.y) / static_cast<float>(texels)};
}

}  // namespace

FrameBlock blockOf(const view::FrameView& view, const glm::mat4& projection, const LightSet& lights, int texels,
                   const std::optional<OcclusionArea>& occlusion) {
    const LightBox& box = lights.sun.box;
    FrameBlock block{};
    block.viewProjection = projection;
    block.toMap = box.toMap;
    block.toLight = glm::mat4(box.toLight);
    block.eye = glm::vec4(view.camera.eye, 1.0F);
    block.lightWay = glm::vec4(-glm::normalize(view.light.direction), penumbraOf(view.light.softness));
    block.lightColour = glm::vec4(sentBack(view.light.colour), lights.sun.reach());
    block.skyLight = glm::vec4(view.light.sky, 0.0F);
    block.groundLight = glm::vec4(view.light.ground, 0.0F);
    block.backgroundTop = glm::vec4(view.background.top, 0.0F);
    block.backgroundHorizon = glm::vec4(view.background.horizon, 0.0F);
    const view::Fade fade = fadeOf(view);
    block.fade = {view.camera.target.x, view.camera.target.z, fade.start, fade.end};
    block.mapSize = mapSizeOf(box, texels);
    if (occlusion) block.occlusionArea = glm::vec4(occlusion->low, 1.0F / (occlusion->high - occlusion->low));
    if (view.ground) block.groundColour = glm::vec4(view.ground->colour, view.ground->gridSpacing);
    block.debug = glm::vec4(view.showMarks ? 1.0F : 0.0F);
    for (std::size_t i = 0; i < lights.lamps.size(); ++i) {
        const view::Lamp& lamp = lights.lamps[i];
        LampBlock& own = block.lamps[i];
        own.way = glm::vec4(-glm::normalize(lamp.direction), penumbraOf(lamp.softness));
        own.colour = glm::vec4(sentBack(lamp.colour), 0.0F);
        if (i >= lights.lampShadows.size()) continue;
        const Shadower& shadow = lights.lampShadows[i];
        own.colour.w = shadow.reach();
        own.toMap = shadow.box.toMap;
        own.toLight = glm::mat4(shadow.box.toLight);
        own.mapSize = mapSizeOf(shadow.box, texels);
    }
    return block;
}

}  // namespace taut::render
