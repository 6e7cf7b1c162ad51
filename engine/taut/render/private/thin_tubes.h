// Ropes and rods that are seen thinner than a pixel: drawn a pixel wide, and laid over the picture by as much as they
// cover of it. It works beside GL, like edge_pass.h.
#pragma once

#include <span>
#include <vector>

#include "taut/render/private/edge_triangles.h"
#include "taut/render/private/mesh_cache.h"
#include "taut/render/private/picture_mean.h"
#include "taut/view/frame_view.h"

namespace taut::render {

// [pixels] The radii with which a thin tube covers pixels, which also with ten sides meets a sample in every column,
// and with which it is shaded, so that its sides all show in the pixels around.
inline constexpr float coveringRadius = 0.6F, shadedRadius = 1.5F;

// How large things are seen.
class PixelScale {
  public:
    PixelScale(const view::Camera& camera, glm::ivec2 size);  // of the picture

    float ahead(glm::vec3 place) const { return glm::dot(place - eye_, forward_); }  // [m] along the camera's axis
    float pixels(float length, float ahead) const { return length * focal_ / ahead; }
    float length(float pixels, float ahead) const { return pixels * ahead / focal_; }  // [m]

  private:
    glm::vec3 eye_, forward_;
    float focal_;  // [pixels] that 1 m has 1 m ahead
};

// Whether a part of it may be seen thinner than a pixel.
bool isThin(const DrawItem& item, const PixelScale& scale);

// The same, with such a radius [pixels] where it would be thinner.
view::Surface widened(const view::Surface& tube, const PixelScale& scale, float radius);

// The drawing of thin tubes only, with the radius of shading; the tubes with the radius of covering, and things that
// may hide them.
struct ThinLayer {
    std::span<const DrawItem> tubes, others;
    const ShadedPixels& shaded;
    const PixelScale& scale;
};

// Lays them over a picture (rows from below).
void layThinTubes(const ThinLayer& layer, const EdgeView& view, EdgeTriangles& triangles, Drawn& picture);

}  // namespace taut::render
