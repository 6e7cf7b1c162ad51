// Anti-aliasing: where a surface ends, the coverage of four samples per pixel is recomputed, and each sample takes its
// colour from the picture that was shaded with one. It works on the result of GL, without GL: a software renderer
// shades a multisampled target several times per pixel, hidden surfaces included.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "taut/render/private/edge_coverage.h"
#include "taut/render/private/edge_triangles.h"
#include "taut/render/private/mesh_cache.h"
#include "taut/view/frame_view.h"

namespace taut::render {

// The mark of an item that shaders write beside its colour, 1/255 … 254/255; 0 is ground and sky.
float itemMark(std::size_t item);
inline constexpr std::uint32_t nothingMark = 255;  // where nothing has been drawn

// The part of a picture in which the items can be seen; all of it if one of them reaches behind the camera.
PixelBox pixelBox(std::span<const DrawItem> items, const glm::mat4& viewProjection, int width, int height);

// Calls each for every tile with the coverage of the triangles; tiles run in parallel.
void forEachTile(const EdgeTriangles& triangles,
                 const std::function<void(const PixelBox& tile, const CoveredTile& covered)>& each);

// Smooths the part of a picture (rows from below, as wide as view.size says) that shows the items. `shaded` is that
// part as it was drawn, `triangles` room for those of the items; where it has alpha, `alpha` is that of the picture.
void smoothEdges(std::span<const DrawItem> items, const EdgeView& view, const ShadedPixels& shaded,
                 EdgeTriangles& triangles, std::span<std::uint32_t> picture, std::span<std::uint8_t> alpha = {});

// The background of the visible surfaces: the ground.
glm::vec4 seenSideOf(const view::FrameView& view);

}  // namespace taut::render
