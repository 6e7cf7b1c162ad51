#include "taut/render/private/depth_layer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/image/image.h"
#include "taut/render/private/layer_pass.h"
#include "taut/view/camera_axes.h"

namespace taut::render {

namespace {

// Where the camera's rays meet the ground.
class GroundRays {
  public:
    GroundRays(const view::FrameView& view, int width, int height) : view_(view) {
        const view::CameraAxes axes = axesOf(view.camera);
        const double pixel = 2.0 * std::tan(0.5 * static_cast<double>(verticalField(view.camera, {width, height}))) /
                             height;  // 1 m ahead
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

// What was drawn of surfaces in a part of a picture of that size, rows from below.
struct DrawnDepth {
    glm::ivec2 size;
    PixelBox part;
    std::span<const float> depth;     // (part.width · part.height) 0 … 1; 1: nothing
    std::span<const float> nearness;  // (part.width · part.height) 1 / [m] along the camera's axis, where there is any
};

// (width · height) rows from the top.
std::vector<std::uint16_t> unitsOf(const view::FrameView& view, const DrawnDepth& drawn, double unit) {
    const GroundRays ground(view, drawn.size.x, drawn.size.y);
    const PixelBox& part = drawn.part;
    std::vector<std::uint16_t> depth;
    depth.reserve(static_cast<std::size_t>(drawn.size.x) * static_cast<std::size_t>(drawn.size.y));
    for (int y = drawn.size.y - 1; y >= 0; --y) {
        for (int x = 0; x < drawn.size.x; ++x) {
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

class DepthPass : public LayerPass {
  public:
    DepthPass(const Gl& gl, double unit, std::string comment) : gl_(&gl), unit_(unit), comment_(std::move(comment)) {}

    void draw(const LayerScene& scene, image::Layer& layer) override {
        scene.targets.bindSurfaces();
        gl_->DepthMask(GL_TRUE);
        gl_->Clear(GL_DEPTH_BUFFER_BIT);
        scene.surfaces.draw(scene.items, scene.meshes);
        std::vector<float> depths;
        scene.targets.depths(scene.part, depths);
        const std::vector<float> nearness = scene.targets.nearness(scene.part);
        layer.numbers = unitsOf(scene.view, {scene.size, scene.part, depths, nearness}, unit_);
        layer.comment = comment_;
    }

  private:
    const Gl* gl_;
    double unit_;
    std::string comment_;
};

class DepthLayer : public Layer {
  public:
    explicit DepthLayer(double unit) : unit_(unit) {}

    std::string name() const override { return "depth"; }

    LayerFacts facts() const override {
        return {{"metres_per_unit", unit_},
                {"range_m", std::vector<double>{0.0, range()}},
                {"background", std::int64_t{image::farDepth}}};
    }

    std::unique_ptr<LayerPass> pass(const Gl& gl, const ShaderFolder&, glm::ivec2) const override {
        return std::make_unique<DepthPass>(
            gl, unit_,
            fmt::format("depth ahead of the camera along its axis; metres per unit: {:.9g}; range: 0 to {:.9g} m; "
                        "65535: background",
                        unit_, range()));
    }

  private:
    double range() const { return unit_ * (image::farDepth - 1); }

    double unit_;  // [m]
};

}  // namespace

std::shared_ptr<const Layer> depthLayer(double unit) {
    return std::make_shared<DepthLayer>(unit);
}

LayerKind depthKind() {
    LayerKind kind{"depth",
                   "Write a 16-bit grey NAME.depth.png beside each frame: 0-65534 is 0 to --depth-range ahead of the "
                   "camera along its axis, by default 1 mm a step; 65535 is the background"};
    kind.number = {.name = "depth-range",
                   .help = "Depth of the value 65534 in --depth [m]; larger depths are clamped",
                   .unit = "METRES",
                   .standard = 65.534,  // a millimetre a step
                   .least = 1e-3,
                   .most = 1e6};
    kind.ask = [](double range, const view::FrameView&) { return depthLayer(range / (image::farDepth - 1)); };
    return kind;
}

}  // namespace taut::render
