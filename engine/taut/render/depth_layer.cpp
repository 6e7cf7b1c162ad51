#include "taut/render/depth_layer.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/image/image.h"
#include "taut/render/camera_axes.h"

namespace taut::render {

namespace {

// Where the camera's rays meet the ground.
class GroundRays {
  public:
    GroundRays(const view::FrameView& view, int width, int height) : view_(view) {
        const CameraAxes axes = axesOf(view.camera);
        const double pixel = 2.0 * std::tan(0.5 * static_cast<double>(view.camera.fieldOfView)) / height;  // 1 m ahead
        right_ = pixel * glm::dvec3(axes.right);
        up_ = pixel * glm::dvec3(axes.up);
        first_ = glm::dvec3(axes.forward) - 0.5 * width * right_ - 0.5 * height * up_;
        reach_ = fadeOf(view).end;
    }
    // [m] along the camera's axis; infinite where no ground is drawn. Pixels from below.
    double ahead(int x, int y) const {
        if (!view_.ground) return INFINITY;
        const glm::dvec3 way = first_ + (x + 0.5) * right_ + (y + 0.5) * up_;
        const glm::dvec3 eye(view_.camera.eye), middle(view_.camera.target);
        const double t = (static_cast<double>(view_.ground->height) - eye.y) / way.y;
        if (!(t > 0.0)) return INFINITY;
        return std::hypot(eye.x + t * way.x - middle.x, eye.z + t * way.z - middle.z) <= reach_ ? t : INFINITY;
    }

  private:
    const view::FrameView& view_;
    glm::dvec3 first_{}, right_{}, up_{};
    double reach_ = 0.0;
};

std::uint16_t units(double ahead, double unit) {
    constexpr double farthest = image::farDepth - 1;
    return std::isfinite(ahead) ? static_cast<std::uint16_t>(std::clamp(std::round(ahead / unit), 0.0, farthest))
                                : image::farDepth;
}

}  // namespace

std::vector<std::uint16_t> depthLayer(const view::FrameView& view, const DrawnDepth& drawn, double unit) {
    const GroundRays ground(view, drawn.width, drawn.height);
    const PixelBox& part = drawn.part;
    std::vector<std::uint16_t> depth;
    depth.reserve(static_cast<std::size_t>(drawn.width) * static_cast<std::size_t>(drawn.height));
    for (int y = drawn.height - 1; y >= 0; --y) {
        for (int x = 0; x < drawn.width; ++x) {
            double ahead = ground.ahead(x, y);
            const int column = x - part.x, row = y - part.y;
            if (column >= 0 && row >= 0 && column < part.width && row < part.height) {
                const auto i = static_cast<std::size_t>(row * part.width + column);
                if (drawn.depth[i] < 1.0F) ahead = std::min(ahead, 1.0 / static_cast<double>(drawn.nearness[i]));
            }
            depth.push_back(units(ahead, unit));
        }
    }
    return depth;
}

}  // namespace taut::render
