#include "taut/render/frame_block.h"

#include <numbers>

#include "taut/render/camera_axes.h"

namespace taut::render {

FrameBlock blockOf(const view::FrameView& view, const glm::mat4& projection, const LightBox& box, int texels,
                   const std::optional<OcclusionArea>& occlusion) {
    FrameBlock block{};
    block.viewProjection = projection;
    block.toMap = box.toMap;
    block.toLight = glm::mat4(box.toLight);
    block.eye = glm::vec4(view.camera.eye, 1.0F);
    block.lightWay = glm::vec4(-glm::normalize(view.light.direction), view.light.softness);
    block.lightColour = glm::vec4(view.light.colour / std::numbers::pi_v<float>, 0.0F);
    block.skyLight = glm::vec4(view.light.sky, 0.0F);
    block.groundLight = glm::vec4(view.light.ground, 0.0F);
    block.backgroundTop = glm::vec4(view.background.top, 0.0F);
    block.backgroundHorizon = glm::vec4(view.background.horizon, 0.0F);
    const Fade fade = fadeOf(view);
    block.fade = {view.camera.target.x, view.camera.target.z, fade.start, fade.end};
    block.mapSize = glm::vec4(box.size, glm::max(box.size.x, box.size.y) / static_cast<float>(texels));
    if (occlusion) block.occlusionArea = glm::vec4(occlusion->low, 1.0F / (occlusion->high - occlusion->low));
    if (view.ground) block.groundColour = glm::vec4(view.ground->colour, view.ground->gridSpacing);
    block.debug = glm::vec4(view.showMarks ? 1.0F : 0.0F);
    return block;
}

}  // namespace taut::render
