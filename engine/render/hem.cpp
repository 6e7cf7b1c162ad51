#include "taut/render/hem.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace taut::render {

namespace {

// Rows of vertices around the rim, from the front (0) to the back. The middle row is there twice, for the front half
// and the back half have each the normals of the side that they go on from:
//
//        n              row 0, the border itself
//     ---*--.           rows 1 … 4, the front half
//            )  out
//     ---*--'           rows 4 … 8, the back half
constexpr std::uint32_t halfRows = 4, lastRow = 2 * halfRows;

// The vertices that are added: `count` on the border, after `first` of the surface.
struct Rows {
    std::uint32_t first, count;
    std::uint32_t front(std::uint32_t row, std::uint32_t i) const { return first + (row - 1) * count + i; }
    std::uint32_t back(std::uint32_t row, std::uint32_t i) const { return first + row * count + i; }
};

float angleOf(std::uint32_t row) {
    return std::numbers::pi_v<float> * static_cast<float>(row) / static_cast<float>(lastRow);
}

template <class Vector>
Vector unitOrZero(const Vector& v) {
    const float square = glm::dot(v, v);
    return square > 1e-24F ? v / std::sqrt(square) : Vector(0.0F);
}

// Along the material, away from the cloth at the edge from a to b of a triangle with c.
glm::vec2 outwards(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    const glm::vec2 along = unitOrZero(b - a);
    return -unitOrZero(c - a - along * glm::dot(c - a, along));
}

// What of the thickness is shown where it is seen so many pixels wide.
float shown(float pixels) {
    return std::clamp(2.0F * (pixels - 1.0F), 0.0F, 1.0F);
}

}  // namespace

Hems::Plan Hems::planOf(const view::Surface& surface) {
    const std::vector<std::uint32_t>& triangles = surface.topology->triangles;
    const std::vector<glm::vec2>& uv = surface.topology->uv;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;  // of directed edges: the third corner
    for (std::size_t t = 0; t < triangles.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i)
            opposite[{triangles[t + i], triangles[t + (i + 1) % 3]}] = triangles[t + (i + 2) % 3];

    Plan plan;
    plan.owner = surface.topology;
    plan.hem = surface.hem;
    constexpr std::uint32_t inside = ~0U;
    std::vector<std::uint32_t> numberOf(uv.size(), inside);  // in the border
    std::vector<glm::vec2> out;                              // (border) along the material
    for (const auto& [edge, third] : opposite) {
        if (opposite.contains({edge.second, edge.first})) continue;
        const glm::vec2 away = outwards(uv[edge.first], uv[edge.second], uv[third]);
        std::array<std::uint32_t, 2> ends{};
        for (std::size_t end = 0; end < 2; ++end) {
            const std::uint32_t vertex = end == 0 ? edge.first : edge.second;
            if (numberOf[vertex] == inside) {
                numberOf[vertex] = static_cast<std::uint32_t>(plan.border.size());
                plan.border.push_back(vertex);
                out.emplace_back(0.0F);
            }
            ends[end] = numberOf[vertex];
            out[ends[end]] += away;
        }
        plan.edges.push_back(ends);
    }
    if (plan.border.empty()) return plan;

    auto topology = std::make_shared<view::Topology>(*surface.topology);
    const Rows rows{static_cast<std::uint32_t>(uv.size()), static_cast<std::uint32_t>(plan.border.size())};
    const auto addRow = [&](float arc) {
        for (std::uint32_t i = 0; i < rows.count; ++i)
            topology->uv.push_back(uv[plan.border[i]] + arc * 0.5F * surface.hem * unitOrZero(out[i]));
    };
    for (std::uint32_t row = 1; row <= halfRows; ++row) addRow(angleOf(row));
    for (std::uint32_t row = halfRows; row <= lastRow; ++row) addRow(angleOf(lastRow - row));
    const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        topology->triangles.insert(topology->triangles.end(), {a, b, c});
    };
    // The back of what lies along the border.
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        std::array<std::uint32_t, 3> corners{triangles[t], triangles[t + 1], triangles[t + 2]};
        bool isBeside = false;
        for (std::uint32_t& corner : corners) {
            if (numberOf[corner] == inside) continue;
            corner = rows.back(lastRow, numberOf[corner]);
            isBeside = true;
        }
        if (isBeside) addTriangle(corners[0], corners[1], corners[2]);
    }
    for (const auto& [a, b] : plan.edges) {
        for (std::uint32_t row = 0; row < halfRows; ++row) {
            const std::uint32_t first = row == 0 ? plan.border[a] : rows.front(row, a);
            const std::uint32_t second = row == 0 ? plan.border[b] : rows.front(row, b);
            addTriangle(first, rows.front(row + 1, a), rows.front(row + 1, b));
            addTriangle(first, rows.front(row + 1, b), second);
        }
        for (std::uint32_t row = halfRows; row < lastRow; ++row) {
            addTriangle(rows.back(row, a), rows.back(row + 1, b), rows.back(row + 1, a));
            addTriangle(rows.back(row, a), rows.back(row, b), rows.back(row + 1, b));
        }
    }
    plan.topology = topology;
    return plan;
}

const Hems::Plan& Hems::plan(const view::Surface& surface) {
    std::erase_if(plans_, [](const auto& entry) { return entry.second.owner.expired(); });
    const auto known = plans_.find(surface.topology.get());
    if (known != plans_.end() && known->second.hem == surface.hem) return known->second;
    return plans_[surface.topology.get()] = planOf(surface);
}

std::vector<view::Surface> Hems::addTo(std::vector<DrawItem>& items, const PixelScale& scale, MeshCache& meshes) {
    std::vector<view::Surface> surfaces;
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < items.size(); ++i) {
        std::optional<view::Surface> surface = hemmed(*items[i].surface, items[i].bounds, scale);
        if (!surface) continue;
        surfaces.push_back(std::move(*surface));
        which.push_back(i);
    }
    const std::vector<DrawItem> hems = meshes.items(surfaces);
    for (std::size_t k = 0; k < which.size(); ++k) items[which[k]] = hems[k];
    return surfaces;
}

std::optional<view::Surface> Hems::hemmed(const view::Surface& surface, const Bounds& bounds, const PixelScale& scale) {
    if (!(surface.hem > 0.0F) || !surface.twoSided) return std::nullopt;
    const auto shownAhead = [&](float ahead) { return ahead > 0.0F ? shown(scale.pixels(surface.hem, ahead)) : 1.0F; };
    float nearest = INFINITY;
    for (const glm::vec3& corner : bounds.corners()) nearest = std::min(nearest, scale.ahead(corner));
    if (shownAhead(nearest) == 0.0F) return std::nullopt;
    const Plan& own = plan(surface);
    std::vector<float> radius;  // (border) [m]
    bool isShown = false;
    for (const std::uint32_t vertex : own.border) {
        const glm::vec4 place = surface.transform * glm::vec4(surface.geometry->positions[vertex], 1.0F);
        radius.push_back(0.5F * surface.hem * shownAhead(scale.ahead(glm::vec3(place))));
        isShown = isShown || radius.back() > 0.0F;
    }
    if (!isShown) return std::nullopt;

    auto geometry = std::make_shared<view::Geometry>(*surface.geometry);
    const std::vector<glm::vec3>& positions = surface.geometry->positions;
    const std::vector<glm::vec3>& normals = surface.geometry->normals;
    std::vector<glm::vec3> out(own.border.size(), glm::vec3(0.0F));
    for (const auto& [a, b] : own.edges) {
        const glm::vec3 along = positions[own.border[b]] - positions[own.border[a]];
        for (const std::uint32_t end : {a, b}) out[end] += unitOrZero(glm::cross(along, normals[own.border[end]]));
    }
    // Mitred: as far out at a corner as beside it.
    for (glm::vec3& way : out)
        way *= 2.0F / std::max(glm::dot(way, way), std::numbers::sqrt2_v<float> * glm::length(way) + 1e-6F);
    const auto addRow = [&](std::uint32_t row, float side) {
        const float c = std::cos(angleOf(row)), s = std::sin(angleOf(row));
        for (std::size_t i = 0; i < own.border.size(); ++i) {
            const glm::vec3 n = c * normals[own.border[i]];
            geometry->positions.push_back(positions[own.border[i]] + radius[i] * (n + s * out[i]));
            geometry->normals.push_back(side * unitOrZero(n + s * unitOrZero(out[i])));
        }
    };
    for (std::uint32_t row = 1; row <= halfRows; ++row) addRow(row, 1.0F);
    for (std::uint32_t row = halfRows; row <= lastRow; ++row) addRow(row, -1.0F);
    for (std::size_t i = 0; i < own.border.size(); ++i)
        geometry->positions[own.border[i]] += radius[i] * normals[own.border[i]];
    view::Surface result = surface;
    result.topology = own.topology;
    result.geometry = std::move(geometry);
    return result;
}

}  // namespace taut::render
