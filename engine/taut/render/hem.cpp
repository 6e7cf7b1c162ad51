#include "taut/render/private/hem.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
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

// Of a triangle, which lies to its left.
struct Side {
    std::uint32_t from, to, third;
};

// Those that no other triangle has the other way round.
std::vector<Side> freeSides(const std::vector<std::uint32_t>& triangles) {
    std::vector<Side> sides, free;
    for (std::size_t t = 0; t < triangles.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i)
            sides.push_back({triangles[t + i], triangles[t + (i + 1) % 3], triangles[t + (i + 2) % 3]});
    const auto before = [](const Side& a, const Side& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); };
    std::sort(sides.begin(), sides.end(), before);
    for (const Side& side : sides)
        if (!std::binary_search(sides.begin(), sides.end(), Side{side.to, side.from, 0}, before)) free.push_back(side);
    return free;
}

constexpr std::uint32_t inside = ~0U;  // of a vertex: on no free side

struct Border {
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> numberOf;              // (vertices of the surface) in the border, or `inside`
    std::vector<glm::vec2> out;                       // (border) unit, along the material
    std::vector<std::array<std::uint32_t, 2>> edges;  // numbers in the border
};

Border borderOf(const view::Topology& topology) {
    Border border;
    border.numberOf.assign(topology.uv.size(), inside);
    for (const Side& side : freeSides(topology.triangles)) {
        const glm::vec2 away = outwards(topology.uv[side.from], topology.uv[side.to], topology.uv[side.third]);
        std::array<std::uint32_t, 2> ends{side.from, side.to};
        for (std::uint32_t& end : ends) {
            std::uint32_t& number = border.numberOf[end];
            if (number == inside) {
                number = static_cast<std::uint32_t>(border.vertices.size());
                border.vertices.push_back(end);
                border.out.emplace_back(0.0F);
            }
            border.out[number] += away;
            end = number;
        }
        border.edges.push_back(ends);
    }
    for (glm::vec2& out : border.out) out = unitOrZero(out);
    return border;
}

// Of the surface with its rim and, along the border, its back.
view::Topology rimmed(const view::Topology& plain, const Border& border, float hem) {
    view::Topology topology = plain;
    const Rows rows{static_cast<std::uint32_t>(plain.uv.size()), static_cast<std::uint32_t>(border.vertices.size())};
    const auto addRow = [&](float arc) {
        for (std::size_t i = 0; i < border.vertices.size(); ++i)
            topology.uv.push_back(plain.uv[border.vertices[i]] + arc * 0.5F * hem * border.out[i]);
    };
    for (std::uint32_t row = 1; row <= halfRows; ++row) addRow(angleOf(row));
    for (std::uint32_t row = halfRows; row <= lastRow; ++row) addRow(angleOf(lastRow - row));
    const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        topology.triangles.insert(topology.triangles.end(), {a, b, c});
    };
    for (std::size_t t = 0; t < plain.triangles.size(); t += 3) {
        std::array<std::uint32_t, 3> corners{plain.triangles[t], plain.triangles[t + 1], plain.triangles[t + 2]};
        bool isBeside = false;
        for (std::uint32_t& corner : corners) {
            if (border.numberOf[corner] == inside) continue;
            corner = rows.back(lastRow, border.numberOf[corner]);
            isBeside = true;
        }
        if (isBeside) addTriangle(corners[0], corners[1], corners[2]);
    }
    for (const auto& [a, b] : border.edges) {
        for (std::uint32_t row = 0; row < halfRows; ++row) {
            const std::uint32_t first = row == 0 ? border.vertices[a] : rows.front(row, a);
            const std::uint32_t second = row == 0 ? border.vertices[b] : rows.front(row, b);
            addTriangle(first, rows.front(row + 1, a), rows.front(row + 1, b));
            addTriangle(first, rows.front(row + 1, b), second);
        }
        for (std::uint32_t row = halfRows; row < lastRow; ++row) {
            addTriangle(rows.back(row, a), rows.back(row + 1, b), rows.back(row + 1, a));
            addTriangle(rows.back(row, a), rows.back(row, b), rows.back(row + 1, b));
        }
    }
    return topology;
}

// What of the thickness is shown where it is seen so many pixels wide.
float shown(float pixels) {
    return std::clamp(2.0F * (pixels - 1.0F), 0.0F, 1.0F);
}

}  // namespace

const Hems::Plan& Hems::plan(const view::Surface& surface) {
    std::erase_if(plans_, [](const auto& entry) { return entry.second.owner.expired(); });
    const auto known = plans_.find(surface.topology.get());
    if (known != plans_.end() && known->second.hem == surface.hem) return known->second;
    Border border = borderOf(*surface.topology);
    auto topology = std::make_shared<const view::Topology>(rimmed(*surface.topology, border, surface.hem));
    return plans_[surface.topology.get()] = {surface.topology, surface.hem, std::move(border.edges),
                                             std::move(border.vertices), std::move(topology)};
}

// `radius` [m] of the rim at each vertex of the border.
std::shared_ptr<const view::Geometry> Hems::shapeOf(const view::Geometry& plain, const Plan& own,
                                                    const std::vector<float>& radius) {
    auto geometry = std::make_shared<view::Geometry>(plain);
    const std::vector<glm::vec3>& positions = plain.positions;
    const std::vector<glm::vec3>& normals = plain.normals;
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
    return geometry;
}

std::vector<view::Surface> Hems::addTo(std::vector<DrawItem>& items, const PixelScale& scale, MeshCache& meshes) {
    std::vector<Rim> rims;
    for (DrawItem& item : items)
        if (std::optional<Rim> rim = rimOf(item, scale)) rims.push_back(std::move(*rim));
    leaveOutSeams(rims);
    std::vector<view::Surface> surfaces;
    for (const Rim& rim : rims) {
        view::Surface& surface = surfaces.emplace_back(*rim.item->surface);
        surface.topology = rim.plan->topology;
        surface.geometry = shapeOf(*rim.item->surface->geometry, *rim.plan, rim.radius);
    }
    const std::vector<DrawItem> hems = meshes.items(surfaces);
    for (std::size_t k = 0; k < rims.size(); ++k) *rims[k].item = hems[k];
    return surfaces;
}

std::optional<Hems::Rim> Hems::rimOf(DrawItem& item, const PixelScale& scale) {
    const view::Surface& surface = *item.surface;
    if (!(surface.hem > 0.0F) || !surface.twoSided) return std::nullopt;
    const auto shownAhead = [&](float ahead) { return ahead > 0.0F ? shown(scale.pixels(surface.hem, ahead)) : 1.0F; };
    float nearest = INFINITY;
    for (const glm::vec3& corner : item.bounds.corners()) nearest = std::min(nearest, scale.ahead(corner));
    if (shownAhead(nearest) == 0.0F) return std::nullopt;
    Rim rim{&item, &plan(surface), {}, {}};
    for (const std::uint32_t vertex : rim.plan->border) {
        rim.places.emplace_back(surface.transform * glm::vec4(surface.geometry->positions[vertex], 1.0F));
        rim.radius.push_back(0.5F * surface.hem * shownAhead(scale.ahead(rim.places.back())));
    }
    const bool isShown = std::any_of(rim.radius.begin(), rim.radius.end(), [](float radius) { return radius > 0.0F; });
    return isShown ? std::optional(std::move(rim)) : std::nullopt;
}

// Where two borders are in one place they are sewn, and no free edges.
void Hems::leaveOutSeams(std::vector<Rim>& rims) {
    constexpr float samePlace = 2e-5F;         // [m]
    const glm::vec3 way(0.57F, 0.71F, 0.41F);  // along which few are side by side
    struct Vertex {
        float along;
        glm::vec3 place;
        float* radius;
    };
    std::vector<Vertex> vertices;
    for (Rim& rim : rims)
        for (std::size_t i = 0; i < rim.places.size(); ++i)
            vertices.push_back({glm::dot(way, rim.places[i]), rim.places[i], &rim.radius[i]});
    std::stable_sort(vertices.begin(), vertices.end(),
                     [](const Vertex& a, const Vertex& b) { return a.along < b.along; });
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::size_t j = i + 1; j < vertices.size() && vertices[j].along - vertices[i].along < samePlace; ++j)
            if (glm::distance(vertices[i].place, vertices[j].place) < samePlace)
                *vertices[i].radius = *vertices[j].radius = 0.0F;
}

}  // namespace taut::render
