#include "taut/render/private/light_box.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/view/camera_axes.h"

namespace taut::render {

namespace {

// What the camera sees up to where the ground has faded away.
Bounds seenPart(const view::FrameView& view, const glm::mat3& toLight, float aspect) {
    const view::Camera& camera = view.camera;
    const view::CameraAxes axes = axesOf(camera);
    const float tangent = std::tan(0.5F * verticalField(camera, aspect));
    const float far = std::min(farPlaneOf(camera), glm::distance(camera.eye, camera.target) + fadeOf(view).end);
    Bounds seen;
    seen.include(toLight * camera.eye);
    for (const float x : {-1.0F, 1.0F}) {
        for (const float y : {-1.0F, 1.0F}) {
            seen.include(toLight *
                         (camera.eye + far * (axes.forward + tangent * (aspect * x * axes.right + y * axes.up))));
        }
    }
    return seen;
}

// The next larger of four sizes a doubling.
float steppedSize(float size) {
    return std::exp2(std::ceil(4.0F * std::log2(std::max(size, 0.05F))) / 4.0F);
}

}  // namespace

void Bounds::include(glm::vec3 point) {
    low = empty ? point : glm::min(low, point);
    high = empty ? point : glm::max(high, point);
    empty = false;
}

std::array<glm::vec3, 8> Bounds::corners() const {
    std::array<glm::vec3, 8> result{};
    for (std::size_t i = 0; i < 8; ++i)
        result[i] = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
    return result;
}

Bounds Bounds::transformed(const glm::mat4& transform) const {
    Bounds result;
    if (empty) return result;
    for (const glm::vec3& corner : corners()) result.include(glm::vec3(transform * glm::vec4(corner, 1.0F)));
    return result;
}

LightBox lightBox(const view::FrameView& view, glm::vec3 direction, std::span<const Bounds> casters, float aspect,
                  int texels, float margin) {
    TAUT_EXPECTS(glm::length(direction) > 0.0F);
    const glm::vec3 towards = -glm::normalize(direction);
    const glm::vec3 helper = std::abs(towards.y) < 0.99F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(0.0F, 0.0F, 1.0F);
    const glm::vec3 right = glm::normalize(glm::cross(helper, towards));
    const glm::vec3 up = glm::cross(towards, right);
    LightBox box;
    box.toLight = glm::transpose(glm::mat3(right, up, towards));

    Bounds across;
    for (const Bounds& caster : casters) {
        if (!caster.empty)
            for (const glm::vec3& corner : caster.corners()) across.include(box.toLight * corner);
    }
    if (across.empty) across.include(box.toLight * view.camera.target);
    const Bounds seen = seenPart(view, box.toLight, aspect);
    glm::vec3 low = across.low;
    glm::vec3 high = across.high;
    for (int axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(std::max(low[axis], seen.low[axis]), high[axis]);
        high[axis] = std::max(std::min(high[axis], seen.high[axis]), low[axis]);
        low[axis] -= margin;
        high[axis] += margin;
    }

    // Sizes in steps, the middle on a raster of whole texels within the 6 % to spare: the box stays where it is while
    // things move a little, and texels do when it moves.
    glm::vec3 middle = 0.5F * (low + high);
    for (int axis = 0; axis < 3; ++axis) {
        box.size[axis] = steppedSize(1.06F * (high[axis] - low[axis]));
        const float step = box.size[axis] * static_cast<float>(texels / 32) / static_cast<float>(texels);
        middle[axis] = std::round(middle[axis] / step) * step;
    }

    glm::mat4 toMap(1.0F);
    const glm::vec3 scale(1.0F / box.size.x, 1.0F / box.size.y, -1.0F / box.size.z);
    for (int column = 0; column < 3; ++column) toMap[column] = glm::vec4(scale * box.toLight[column], 0.0F);
    toMap[3] = glm::vec4(glm::vec3(0.5F) - scale * middle, 1.0F);
    box.toMap = toMap;
    return box;
}

}  // namespace taut::render
