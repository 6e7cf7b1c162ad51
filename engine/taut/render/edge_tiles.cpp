#include "taut/render/private/edge_tiles.h"

#include <algorithm>

#include "taut/render/private/edge_kernels.h"

namespace taut::render {

std::vector<PixelBox> edgeTiles(const ShadedPixels& pixels) {
    const EdgeKernels kernels = edgeKernels();
    const PixelBox& box = pixels.box;
    const int columns = (box.width + edgeTileSize - 1) / edgeTileSize;
    std::vector<PixelBox> tiles;
    std::vector<std::uint8_t> isEdge(static_cast<std::size_t>(box.width)), hasEdge(static_cast<std::size_t>(columns));
    if (box.width < 3 || box.height < 3) return {box};
    const auto row = [&](const auto& plane, int y) {
        return plane.data() + static_cast<std::ptrdiff_t>(y) * box.width;
    };
    for (int low = 0; low < box.height; low += edgeTileSize) {
        const int high = std::min(low + edgeTileSize, box.height);
        std::fill(hasEdge.begin(), hasEdge.end(), std::uint8_t{0});
        for (int y = low; y < high; ++y) {
            // The outermost rows and columns have a neighbour on one side only, which finds the edge between the two.
            const int middle = std::clamp(y, 1, box.height - 2);
            const std::uint32_t* const colours[]{row(pixels.colour, middle - 1), row(pixels.colour, middle),
                                                 row(pixels.colour, middle + 1)};
            const float* const depths[]{row(pixels.depth, middle - 1), row(pixels.depth, middle),
                                        row(pixels.depth, middle + 1)};
            kernels.findEdges(colours, depths, 1, box.width - 1, isEdge.data());
            isEdge.front() = isEdge[1];
            isEdge.back() = isEdge[isEdge.size() - 2];
            for (int x = 0; x < box.width; ++x)
                hasEdge[static_cast<std::size_t>(x / edgeTileSize)] |= isEdge[static_cast<std::size_t>(x)];
        }
        // Neighbouring tiles become one box.
        for (int from = 0; from < columns; ++from) {
            if (!hasEdge[static_cast<std::size_t>(from)]) continue;
            int to = from + 1;
            while (to < columns && hasEdge[static_cast<std::size_t>(to)]) ++to;
            const int left = from * edgeTileSize, right = std::min(to * edgeTileSize, box.width);
            tiles.push_back({box.x + left, box.y + low, right - left, high - low});
            from = to;
        }
    }
    return tiles;
}

}  // namespace taut::render
