#include "taut/render/private/ground_fill.h"

#include <algorithm>
#include <cmath>

#include "taut/core/private/parallel.h"
#include "taut/render/private/edge_pass.h"
#include "taut/render/private/surface_pass.h"

namespace taut::render {

namespace {

constexpr int rowsATask = 16;

template <std::size_t count, class Vector>
void put(const Vector& from, float (&to)[count]) {
    for (std::size_t i = 0; i < count; ++i) to[i] = from[static_cast<glm::length_t>(i)];
}

// The depth of a level plane is linear over the picture.
void putDepth(const glm::dmat4& projection, double height, glm::dvec2 size, GroundArgs& args) {
    const glm::dvec4 plane = glm::transpose(glm::inverse(projection)) * glm::dvec4(0.0, 1.0, 0.0, -height);
    const glm::dvec2 slope = -glm::dvec2(plane) / plane.z / size;
    args.depthAlong = static_cast<float>(slope.x);
    args.depthUp = static_cast<float>(slope.y);
    args.depthStart =
        static_cast<float>(0.5 + 0.5 * (plane.x + plane.y - plane.w) / plane.z + 0.5 * (slope.x + slope.y));
}

}  // namespace

GroundArgs groundArgs(const view::FrameView& view, const FrameBlock& block, const LightSet& lights,
                      const glm::mat4& projection, glm::ivec2 size, glm::vec2 shift, std::span<const float> hidden) {
    GroundArgs args{};
    const Rays rays = raysOf(view.camera, size, shift);
    put(block.eye, args.eye);
    put(rays.first, args.firstWay);
    put(rays.right, args.rightWay);
    put(rays.up, args.upWay);
    args.height = INFINITY;
    args.depthStart = 2.0F;
    if (view.ground) {
        args.height = view.ground->height;
        putDepth(projection, args.height, size, args);
    }
    if (block.groundColour.w > 0.0F) {
        args.lines = 1.0F / block.groundColour.w;
        args.lineShade = 0.3F;
    }
    glm::vec3 direct = glm::vec3(block.lightColour) * std::max(block.lightWay.y, 0.0F);
    for (std::size_t i = 0; i < lights.lamps.size(); ++i)
        direct += glm::vec3(block.lamps[i].colour) * std::max(block.lamps[i].way.y, 0.0F);
    put(block.fade, args.fade);
    put(block.groundColour, args.albedo);
    put(direct, args.direct);
    put(block.skyLight, args.sky);
    put(block.backgroundHorizon, args.horizon);
    put(block.backgroundTop, args.top);
    if (!hidden.empty()) {
        args.hidden = hidden.data();
        args.hiddenEdge = occlusionEdge;
        put(glm::vec2(block.occlusionArea.x, block.occlusionArea.y), args.hiddenLow);
        put(glm::vec2(block.occlusionArea.z, block.occlusionArea.w), args.hiddenScale);
    }
    args.nothing = nothingMark;
    return args;
}

void fillGround(const GroundArgs& args, const PixelBox& part, std::span<float> depths, std::span<std::uint32_t> colours,
                int width) {
    const GroundKernels kernels = groundKernels();
    const int height = static_cast<int>(colours.size()) / width;
    core::parallelFor(height, rowsATask, [&](int y) {
        std::uint32_t* row = colours.data() + static_cast<std::ptrdiff_t>(y) * width;
        const auto fill = [&](int from, int to, float* depth) {
            if (from < to) kernels.fill(args, from, y, to - from, row + from, depth);
        };
        if (y < part.y || y >= part.y + part.height) return fill(0, width, nullptr);
        fill(0, part.x, nullptr);
        fill(part.x, part.x + part.width, depths.data() + static_cast<std::ptrdiff_t>(y - part.y) * part.width);
        fill(part.x + part.width, width, nullptr);
    });
}

}  // namespace taut::render
