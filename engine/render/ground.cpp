#include "taut/render/ground.h"

#include <algorithm>
#include <cmath>

namespace taut::render {

namespace {

constexpr int halfCells = 20;  // cells from the middle to the rim

// Grid lines: dense near the middle.
float gridLine(int i) {
    const float t = static_cast<float>(i) / static_cast<float>(halfCells);
    return t * (0.15F + 0.85F * t * t);
}

// Casters as rectangles across the light, each grown by the widest penumbra it can throw.
struct Footprint {
    glm::vec2 low, high;
};

std::vector<Footprint> footprintsOf(std::span<const Bounds> casters, const LightBox& box, float height,
                                    float softness) {
    const float sine = std::max(glm::transpose(box.toLight)[2].y, 0.05F);  // of the sun's elevation
    std::vector<Footprint> footprints;
    for (const Bounds& caster : casters) {
        if (caster.empty || caster.high.y < height) continue;
        const Bounds across = caster.transformed(glm::mat4(box.toLight));
        const float grow = softness * (caster.high.y - height) / sine + 0.02F * glm::max(box.size.x, box.size.y);
        footprints.push_back({glm::vec2(across.low) - grow, glm::vec2(across.high) + grow});
    }
    return footprints;
}

bool overlap(glm::vec2 lowA, glm::vec2 highA, glm::vec2 lowB, glm::vec2 highB) {
    return lowA.x <= highB.x && lowB.x <= highA.x && lowA.y <= highB.y && lowB.y <= highA.y;
}

}  // namespace

GroundMesh groundMesh(glm::vec3 middle, float height, float radius, const LightBox& box,
                      std::span<const Bounds> casters, float softness, const std::optional<OcclusionArea>& occlusion) {
    const std::vector<Footprint> footprints = footprintsOf(casters, box, height, softness);
    GroundMesh mesh;
    const auto place = [&](int i) { return i < 0 ? -gridLine(-i) : gridLine(i); };
    for (int row = -halfCells; row <= halfCells; ++row)
        for (int column = -halfCells; column <= halfCells; ++column)
            mesh.positions.emplace_back(middle.x + radius * place(column), height, middle.z + radius * place(row));
    for (int row = -halfCells; row < halfCells; ++row) {
        for (int column = -halfCells; column < halfCells; ++column) {
            // Cells wholly outside the disc are faded away anyway.
            const float nearX = std::min(std::abs(place(column)), std::abs(place(column + 1)));
            const float nearZ = std::min(std::abs(place(row)), std::abs(place(row + 1)));
            if (nearX * nearX + nearZ * nearZ > 1.0F) continue;
            const auto a = static_cast<std::uint32_t>((row + halfCells) * (2 * halfCells + 1) + column + halfCells);
            const std::uint32_t c = a + 2 * halfCells + 2;
            const std::uint32_t b = a + 1;
            const std::uint32_t d = c - 1;
            Bounds cell;
            for (const std::uint32_t corner : {a, b, c, d}) cell.include(box.toLight * mesh.positions[corner]);
            bool shaded = std::any_of(footprints.begin(), footprints.end(), [&](const Footprint& footprint) {
                return overlap(cell.low, cell.high, footprint.low, footprint.high);
            });
            if (occlusion) {
                const glm::vec3 low = mesh.positions[a];
                const glm::vec3 high = mesh.positions[c];
                shaded = shaded || overlap({low.x, low.z}, {high.x, high.z}, occlusion->low, occlusion->high);
            }
            std::vector<std::uint32_t>& triangles = shaded ? mesh.shaded : mesh.open;
            triangles.insert(triangles.end(), {a, d, c, a, c, b});
        }
    }
    return mesh;
}

}  // namespace taut::render
