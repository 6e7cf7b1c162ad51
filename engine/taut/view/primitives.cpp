#include "taut/view/primitives.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "taut/core/error.h"

namespace taut::view {

namespace {

constexpr int roundSteps = 4;   // steps of a rounded edge's quarter turn
constexpr float bevel = 0.03F;  // rounding of the rims of cylinders and cones, as a part of the smaller size

// Corners of a circle, a multiple of four: as far as a shape is seen from its own size away or more, a polygon of these
// many corners stays within half a pixel. Small things are many; their triangles would cost more than their pixels.
int turnSteps(float radius) {
    const float wanted = 64.0F * std::sqrt(radius / 0.5F);
    return 4 * static_cast<int>(std::ceil(std::clamp(wanted, 20.0F, 64.0F) / 4.0F));
}

// One corner of the outline that a surface of revolution is made of, seen in the half plane (distance, height).
struct ProfilePoint {
    glm::vec2 at;      // [m]
    glm::vec2 normal;  // unit
};

// Appends an arc of the outline: normals turn from one angle to the other, measured from the horizontal.
void appendArc(std::vector<ProfilePoint>& profile, glm::vec2 centre, float radius, float from, float to, int steps) {
    for (int i = 0; i <= steps; ++i) {
        const float angle = from + (to - from) * static_cast<float>(i) / static_cast<float>(steps);
        const glm::vec2 normal(std::cos(angle), std::sin(angle));
        profile.push_back({centre + radius * normal, normal});
    }
}

void appendTriangle(Topology& topology, const Geometry& geometry, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = geometry.positions;
    if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
    topology.triangles.insert(topology.triangles.end(), {a, b, c});
}

Mesh meshOf(Topology topology, Geometry geometry) {
    return {std::make_shared<const Topology>(std::move(topology)),
            std::make_shared<const Geometry>(std::move(geometry))};
}

// Turns an outline, given from the bottom to the top, about the y axis.
Mesh revolved(const std::vector<ProfilePoint>& profile) {
    Topology topology;
    Geometry geometry;
    float along = 0.0F;
    float widest = 0.0F;
    for (const ProfilePoint& point : profile) widest = std::max(widest, point.at.x);
    const int steps = turnSteps(widest);
    for (std::size_t row = 0; row < profile.size(); ++row) {
        const auto& [at, normal] = profile[row];
        if (row > 0) along += glm::distance(at, profile[row - 1].at);
        const float distance = at.x > 1e-6F * widest ? at.x : 0.0F;
        for (int i = 0; i <= steps; ++i) {
            const float part = static_cast<float>(i) / static_cast<float>(steps);
            const float angle =
                2.0F * std::numbers::pi_v<float> * static_cast<float>(i % steps) / static_cast<float>(steps);
            const float x = std::cos(angle);
            const float z = -std::sin(angle);
            geometry.positions.emplace_back(distance * x, at.y, distance * z);
            geometry.normals.emplace_back(glm::normalize(glm::vec3(normal.x * x, normal.y, normal.x * z)));
            topology.uv.emplace_back(2.0F * std::numbers::pi_v<float> * widest * part, along);
        }
    }
    const auto stride = static_cast<std::uint32_t>(steps + 1);
    for (std::uint32_t row = 0; row + 1 < profile.size(); ++row) {
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(steps); ++i) {
            const std::uint32_t a = row * stride + i;
            appendTriangle(topology, geometry, a, a + 1, a + stride + 1);
            appendTriangle(topology, geometry, a, a + stride + 1, a + stride);
        }
    }
    return meshOf(std::move(topology), std::move(geometry));
}

// Where the grid lines of a rounded box cross one axis: dense in the edges, none between.
std::vector<float> boxLines(float halfSize, float edgeRadius) {
    std::vector<float> lines;
    const float inner = halfSize - edgeRadius;
    if (edgeRadius > 0.0F) {
        for (int i = roundSteps; i > 0; --i) {
            const float angle =
                0.25F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(roundSteps);
            lines.push_back(i == roundSteps ? halfSize : inner + edgeRadius * std::tan(angle));
        }
    }
    if (inner > 0.0F) lines.push_back(inner);
    const std::size_t count = lines.size();
    if (inner <= 0.0F) lines.push_back(0.0F);
    for (std::size_t i = count; i-- > 0;) lines.push_back(-lines[i]);
    std::reverse(lines.begin(), lines.end());
    return lines;
}

// One side of a rounded box: a grid on the cube's face, pushed onto the rounded surface.
void appendBoxSide(Topology& topology, Geometry& geometry, glm::vec3 halfSize, float edgeRadius, bool stands, int axis,
                   float sign) {
    const int axisU = (axis + 1) % 3;
    const int axisV = (axis + 2) % 3;
    const std::vector<float> linesU = boxLines(halfSize[axisU], edgeRadius);
    const std::vector<float> linesV = boxLines(halfSize[axisV], edgeRadius);
    const auto first = static_cast<std::uint32_t>(geometry.positions.size());
    const glm::vec3 inner = halfSize - glm::vec3(edgeRadius), low(-inner.x, stands ? -halfSize.y : -inner.y, -inner.z);
    const bool isFlat = edgeRadius == 0.0F || (stands && axis == 1 && sign < 0.0F);
    for (const float v : linesV) {
        for (const float u : linesU) {
            glm::vec3 onCube(0.0F);
            onCube[axis] = sign * halfSize[axis];
            onCube[axisU] = u;
            onCube[axisV] = v;
            glm::vec3 normal(0.0F);
            normal[axis] = sign;
            const glm::vec3 core = glm::clamp(onCube, low, inner);
            glm::vec3 out(0.0F);  // from the core, up to 1 on the edge of a flat side
            if (core != onCube) {
                const glm::vec3 part = glm::abs(onCube - core) / (halfSize - inner);
                out = std::max({part.x, part.y, part.z}) * glm::normalize(onCube - core);
            }
            if (!isFlat) normal = out;
            geometry.positions.push_back(core + edgeRadius * out);
            geometry.normals.push_back(normal);
            topology.uv.emplace_back(sign * u, v);
        }
    }
    const auto width = static_cast<std::uint32_t>(linesU.size());
    for (std::uint32_t row = 0; row + 1 < linesV.size(); ++row) {
        for (std::uint32_t column = 0; column + 1 < width; ++column) {
            const std::uint32_t a = first + row * width + column;
            const std::uint32_t b = sign > 0.0F ? a + 1 : a + width;
            const std::uint32_t d = sign > 0.0F ? a + width : a + 1;
            appendTriangle(topology, geometry, a, b, a + width + 1);
            appendTriangle(topology, geometry, a, a + width + 1, d);
        }
    }
}

}  // namespace

Mesh sphereMesh(float radius) {
    TAUT_EXPECTS(radius > 0.0F);
    std::vector<ProfilePoint> profile;
    appendArc(profile, {0.0F, 0.0F}, radius, -0.5F * std::numbers::pi_v<float>, 0.5F * std::numbers::pi_v<float>,
              turnSteps(radius) / 2);
    return revolved(profile);
}

Mesh boxMesh(glm::vec3 halfSize, float edgeRadius, bool stands) {
    const float smallest = std::min({halfSize.x, halfSize.y, halfSize.z});
    TAUT_EXPECTS(smallest > 0.0F && edgeRadius >= 0.0F);
    const float rounded = std::min(edgeRadius, smallest);
    Topology topology;
    Geometry geometry;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0F, -1.0F}) appendBoxSide(topology, geometry, halfSize, rounded, stands, axis, sign);
    return meshOf(std::move(topology), std::move(geometry));
}

Mesh cylinderMesh(float radius, float height) {
    TAUT_EXPECTS(radius > 0.0F && height > 0.0F);
    const float half = 0.5F * height;
    const float rim = bevel * std::min(radius, half);
    std::vector<ProfilePoint> profile{{{0.0F, -half}, {0.0F, -1.0F}}};
    appendArc(profile, {radius - rim, rim - half}, rim, -0.5F * std::numbers::pi_v<float>, 0.0F, roundSteps);
    appendArc(profile, {radius - rim, half - rim}, rim, 0.0F, 0.5F * std::numbers::pi_v<float>, roundSteps);
    profile.push_back({{0.0F, half}, {0.0F, 1.0F}});
    return revolved(profile);
}

Mesh coneMesh(float radius, float height) {
    TAUT_EXPECTS(radius > 0.0F && height > 0.0F);
    const float half = 0.5F * height;
    const float slope = std::atan2(radius, height);  // of the side's normal above the horizontal
    // The rim is a small arc that touches the base and the side from within.
    const float rim = bevel * std::min(radius, half);
    const float inset = rim * (1.0F + std::sin(slope)) / std::cos(slope);
    const glm::vec2 normal(std::cos(slope), std::sin(slope));
    std::vector<ProfilePoint> profile{{{0.0F, -half}, {0.0F, -1.0F}}};
    appendArc(profile, {radius - inset, rim - half}, rim, -0.5F * std::numbers::pi_v<float>, slope, 2 * roundSteps);
    // Rows between rim and tip keep the shading even where the triangles narrow.
    const glm::vec2 rimEnd = profile.back().at;
    for (int i = 1; i <= roundSteps; ++i) {
        const float part = static_cast<float>(i) / static_cast<float>(roundSteps);
        profile.push_back({glm::mix(rimEnd, glm::vec2(0.0F, half), part), normal});
    }
    return revolved(profile);
}

Mesh capsuleMesh(float radius, float height) {
    TAUT_EXPECTS(radius > 0.0F && height >= 0.0F);
    const float half = 0.5F * height;
    std::vector<ProfilePoint> profile;
    appendArc(profile, {0.0F, -half}, radius, -0.5F * std::numbers::pi_v<float>, 0.0F, turnSteps(radius) / 4);
    if (height == 0.0F) profile.pop_back();
    appendArc(profile, {0.0F, half}, radius, 0.0F, 0.5F * std::numbers::pi_v<float>, turnSteps(radius) / 4);
    return revolved(profile);
}

Mesh quadMesh(glm::vec3 normal, float halfSize) {
    TAUT_EXPECTS(glm::length(normal) > 0.0F && halfSize > 0.0F);
    const glm::vec3 n = glm::normalize(normal);
    const glm::vec3 helper = std::abs(n.x) < 0.9F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 0.0F, 1.0F);
    const glm::vec3 v = glm::normalize(glm::cross(n, helper));
    const glm::vec3 u = glm::cross(v, n);
    Topology topology{{0, 1, 2, 0, 2, 3}, {}};
    Geometry geometry;
    for (const glm::vec2 corner : {glm::vec2(-1.0F, -1.0F), {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
        const glm::vec2 uv = halfSize * corner;
        geometry.positions.push_back(uv.x * u + uv.y * v);
        geometry.normals.push_back(n);
        topology.uv.push_back(uv);
    }
    return meshOf(std::move(topology), std::move(geometry));
}

}  // namespace taut::view
