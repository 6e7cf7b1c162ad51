// Sun and lamps in the terms of formats. Independent of formats.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "taut/geometry/private/poses.h"
#include "taut/view/frame_view.h"

namespace taut::geometry {

struct FarLight {
    std::string name;        // "sun", "lamp.fill"
    glm::mat4 pose{1.0F};    // shines along its own -z
    glm::vec3 colour{1.0F};  // the largest part is 1
    float brightness = 1.0F;
    float softness = 0.0F;  // [rad] apparent size
    bool shadow = true;
};

inline std::vector<FarLight> farLightsOf(const view::FrameView& view) {
    std::vector<FarLight> lights;
    const auto add = [&](const std::string& name, glm::vec3 direction, glm::vec3 colour, float softness, bool shadow) {
        const float brightness = std::max({colour.x, colour.y, colour.z, 1e-6F});
        lights.push_back({name, looking(glm::vec3(0.0F), direction, glm::vec3(0.0F, 1.0F, 0.0F)), colour / brightness,
                          brightness, softness, shadow});
    };
    add("sun", view.light.direction, view.light.colour, view.light.softness, true);
    for (const view::Lamp& lamp : view.lamps)
        add("lamp." + lamp.name, lamp.direction, lamp.colour, lamp.softness, lamp.shadow);
    return lights;
}

}  // namespace taut::geometry
