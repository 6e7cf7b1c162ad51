#include "taut/render/private/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "taut/render/private/shadow_map.h"

namespace taut::render {

namespace {

constexpr int halfCells = 20;  // cells from the middle to the rim

constexpr int piecesAcross = 3;  // of a cell, where shadows are looked for more closely

// Grid lines: dense near the middle.
float gridLine(int i) {
    const float t = static_cast<float>(i) / static_cast<float>(halfCells);
    return t * (0.15F + 0.85F * t * t);
}

// A rectangle of the ground.
struct Footprint {
    glm::vec2 low, high;
};

// How much larger than what throws it a shadow is on the ground, along x and z: a disc across the light becomes an
// ellipse, which is long along the light.
glm::vec2 grownBy(float radius, const glm::vec3& towards, float sine) {
    const glm::vec2 flat(towards.x, towards.z);
    const float length = glm::length(flat);
    if (length < 1e-4F) return glm::vec2(radius);
    const glm::vec2 along = flat / length;
    const glm::vec2 across(along.y, along.x);
    return radius * glm::sqrt(along * along / (sine * sine) + across * across);
}

// Where the light may be kept from the ground, with the widest penumbra and `beyond`, a part of the map, around it.
Footprint shadowOf(const Bounds& caster, const Shadower& light, float height, float beyond) {
    const LightBox& box = light.box;
    const glm::vec3 towards = towardsLight(box);
    const float sine = towards.y;  // of the sun's elevation
    if (sine < 0.05F) return {glm::vec2(-INFINITY), glm::vec2(INFINITY)};
    Footprint shadow{glm::vec2(INFINITY), glm::vec2(-INFINITY)};
    for (const glm::vec3& corner : caster.corners()) {
        const float above = std::max(corner.y - height, 0.0F);
        const glm::vec2 place = glm::vec2(corner.x, corner.z) - above / sine * glm::vec2(towards.x, towards.z);
        shadow.low = glm::min(shadow.low, place);
        shadow.high = glm::max(shadow.high, place);
    }
    const float radius = light.softness * (caster.high.y - height) / sine + beyond * glm::max(box.size.x, box.size.y);
    const glm::vec2 grow = grownBy(radius, towards, sine);
    return {shadow.low - grow, shadow.high + grow};
}

constexpr float readAround = 0.02F;  // of the map: as far as a penumbra is looked for, and more

// Of the map: a block and a half more than bounds are gathered from, and more.
float boundsAround(const Shadower& light) {
    return std::max(0.03F, (static_cast<float>(light.blocks) + 1.5F) / static_cast<float>(boundsEdge));
}

enum class Light : std::uint8_t { open, darkened, shaded };

// The cells of the disc, row by row.
class Cells {
  public:
    Cells(glm::vec2 middle, float radius) : light_(cellsAcross * cellsAcross, Light::open) {
        for (int i = -halfCells; i <= halfCells; ++i) {
            const float place = i < 0 ? -gridLine(-i) : gridLine(i);
            lines_[static_cast<std::size_t>(i + halfCells)] = radius * place;
        }
        middle_ = middle;
    }
    glm::vec2 corner(int row, int column) const {
        return middle_ + glm::vec2(lines_[static_cast<std::size_t>(column)], lines_[static_cast<std::size_t>(row)]);
    }
    Light light(int row, int column) const { return light_[static_cast<std::size_t>(row * cellsAcross + column)]; }

    // What touches the rectangle is at least as dark.
    void mark(const Footprint& footprint, Light light) {
        const auto [left, right] = range(footprint.low.x - middle_.x, footprint.high.x - middle_.x);
        const auto [low, high] = range(footprint.low.y - middle_.y, footprint.high.y - middle_.y);
        for (int row = low; row <= high; ++row) {
            for (int column = left; column <= right; ++column) {
                Light& cell = light_[static_cast<std::size_t>(row * cellsAcross + column)];
                cell = std::max(cell, light);
            }
        }
    }

    static constexpr int cellsAcross = 2 * halfCells;

  private:
    // The first and the last cell between two places.
    std::pair<int, int> range(float from, float to) const {
        const auto first = std::upper_bound(lines_.begin(), lines_.end(), from) - lines_.begin() - 1;
        const auto last = std::upper_bound(lines_.begin(), lines_.end(), to) - lines_.begin() - 1;
        return {std::max(static_cast<int>(first), 0), std::min(static_cast<int>(last), cellsAcross - 1)};
    }

    glm::vec2 middle_;
    std::array<float, 2 * halfCells + 1> lines_{};
    std::vector<Light> light_;
};

}  // namespace

GroundMesh groundMesh(glm::vec3 middle, float height, float radius, std::span<const Shadower> lights,
                      std::span<const Bounds> casters, const std::optional<OcclusionArea>& occlusion,
                      std::span<const Bounds> moving) {
    Cells cells({middle.x, middle.z}, radius), changes({middle.x, middle.z}, radius);
    const auto mark = [&](Cells& which, const Bounds& caster, bool isMoving) {
        if (caster.empty) return;
        for (const Shadower& light : lights) {
            if (caster.high.y < height) break;
            const float beyond = isMoving ? boundsAround(light) : readAround;
            which.mark(shadowOf(caster, light, height, beyond), Light::shaded);
        }
        if (!occlusion || caster.low.y > height + occlusionCeiling) return;
        const glm::vec2 reach = occlusionReach(*occlusion);
        which.mark({glm::vec2(caster.low.x, caster.low.z) - reach, glm::vec2(caster.high.x, caster.high.z) + reach},
                   Light::darkened);
    };
    for (const Bounds& caster : casters) mark(cells, caster, false);
    for (const Bounds& caster : moving) mark(changes, caster, true);
    GroundMesh mesh;
    for (int row = 0; row <= Cells::cellsAcross; ++row) {
        for (int column = 0; column <= Cells::cellsAcross; ++column) {
            const glm::vec2 place = cells.corner(row, column);
            mesh.positions.emplace_back(place.x, height, place.y);
        }
    }
    mesh.changes.resize(mesh.positions.size());
    for (int row = 0; row < Cells::cellsAcross; ++row) {
        for (int column = 0; column < Cells::cellsAcross; ++column) {
            // Cells wholly outside the disc are faded away anyway.
            const glm::vec2 low = cells.corner(row, column) - glm::vec2(middle.x, middle.z);
            const glm::vec2 high = cells.corner(row + 1, column + 1) - glm::vec2(middle.x, middle.z);
            const glm::vec2 nearest = glm::min(glm::abs(low), glm::abs(high));
            if (glm::dot(nearest, nearest) > radius * radius) continue;
            const auto a = static_cast<std::uint32_t>(row * (Cells::cellsAcross + 1) + column);
            const std::uint32_t b = a + 1, d = a + Cells::cellsAcross + 1, c = d + 1;
            const Light light = cells.light(row, column);
            std::vector<std::uint32_t>& triangles = light == Light::shaded     ? mesh.shaded
                                                    : light == Light::darkened ? mesh.darkened
                                                                               : mesh.open;
            triangles.insert(triangles.end(), {a, d, c, a, c, b});
            mesh.changes[a] = changes.light(row, column) != Light::open ? 1 : 0;
        }
    }
    return mesh;
}

void leaveShaded(GroundMesh& mesh, const std::function<bool(std::span<const glm::vec3, 4> corners)>& isLit) {
    std::vector<std::uint32_t> left;
    for (std::size_t i = 0; i < mesh.shaded.size(); i += 6) {
        const glm::vec3 low = mesh.positions[mesh.shaded[i]], high = mesh.positions[mesh.shaded[i + 2]];
        // The same places on both sides of a border between cells.
        const auto at = [&](float from, float to, int piece) {
            return glm::mix(from, to, static_cast<float>(piece) / piecesAcross);
        };
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int row = 0; row <= piecesAcross; ++row)
            for (int column = 0; column <= piecesAcross; ++column)
                mesh.positions.emplace_back(at(low.x, high.x, column), low.y, at(low.z, high.z, row));
        for (int row = 0; row < piecesAcross; ++row) {
            for (int column = 0; column < piecesAcross; ++column) {
                const auto a = first + static_cast<std::uint32_t>(row * (piecesAcross + 1) + column);
                const std::uint32_t b = a + 1, d = a + piecesAcross + 1, c = d + 1;
                const std::array<glm::vec3, 4> corners{mesh.positions[a], mesh.positions[b], mesh.positions[c],
                                                       mesh.positions[d]};
                if (!isLit(corners)) left.insert(left.end(), {a, d, c, a, c, b});
            }
        }
    }
    mesh.shaded = std::move(left);
}

}  // namespace taut::render
