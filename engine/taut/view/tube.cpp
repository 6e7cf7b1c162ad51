#include "taut/view/private/tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "taut/core/error.h"

namespace taut::view {

namespace {

// Rings that a cap adds between its pole and the tube's first ring.
int capRings(int sides) {
    return std::max(2, sides / 4) - 1;
}

int lineRings(int points, int subdivisions) {
    return (points - 1) * subdivisions + 1;
}

// Angle of a cap's ring from the plane of the tube's end ring [rad]; ring 0 lies next to the pole.
float capAngle(int ring, int sides) {
    const int rings = capRings(sides);
    return 0.5F * std::numbers::pi_v<float> * static_cast<float>(rings - ring) / static_cast<float>(rings + 1);
}

// Of a ring, which ends where it begins.
bool isRing(std::span<const glm::vec3> line) {
    return line.size() > 3 && line.front() == line.back();
}

// Uniform Catmull-Rom; beyond the ends the line goes on straight, or round.
std::vector<glm::vec3> smoothLine(std::span<const glm::vec3> line, int subdivisions) {
    std::vector<glm::vec3> smooth;
    smooth.reserve(static_cast<std::size_t>(lineRings(static_cast<int>(line.size()), subdivisions)));
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::vec3 b = line[i];
        const glm::vec3 c = line[i + 1];
        const glm::vec3 a = i > 0 ? line[i - 1] : isRing(line) ? line[line.size() - 2] : 2.0F * b - c;
        const glm::vec3 d = i + 2 < line.size() ? line[i + 2] : isRing(line) ? line[1] : 2.0F * c - b;
        for (int k = 0; k < subdivisions; ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(subdivisions);
            smooth.push_back(
                b + 0.5F * t * ((c - a) + t * ((2.0F * a - 5.0F * b + 4.0F * c - d) + t * (3.0F * (b - c) + d - a))));
        }
    }
    smooth.push_back(line.back());
    return smooth;
}

// Unit direction of the line at each point; where points coincide, that of the point before.
std::vector<glm::vec3> tangentsOf(const std::vector<glm::vec3>& line) {
    std::vector<glm::vec3> tangents(line.size(), glm::vec3(0.0F));
    glm::vec3 last(0.0F);
    const std::size_t end = line.size() - 1, before = isRing(line) ? end - 1 : 0, after = isRing(line) ? 1 : end;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const glm::vec3 across = line[i < end ? i + 1 : after] - line[i > 0 ? i - 1 : before];
        const float length = glm::length(across);
        if (length > 1e-9F) last = across / length;
        tangents[i] = last;
    }
    // Points before the first direction take it over; without any the tube stands upright.
    const auto known = std::find_if(tangents.begin(), tangents.end(), [](glm::vec3 t) { return t != glm::vec3(0.0F); });
    std::fill(tangents.begin(), known, known == tangents.end() ? glm::vec3(0.0F, 1.0F, 0.0F) : *known);
    return tangents;
}

glm::vec3 reflected(glm::vec3 v, glm::vec3 mirror) {
    const float square = glm::dot(mirror, mirror);
    return square > 1e-18F ? v - (2.0F * glm::dot(mirror, v) / square) * mirror : v;
}

// A vector across the line at each point, carried along without twist by double reflection
// (Wang, Jüttler, Zheng, Liu: Computation of Rotation Minimizing Frames, 2008).
std::vector<glm::vec3> sidewaysOf(const std::vector<glm::vec3>& line, const std::vector<glm::vec3>& tangents) {
    std::vector<glm::vec3> sideways;
    sideways.reserve(line.size());
    const glm::vec3 t = tangents.front();
    const glm::vec3 helper = std::abs(t.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    sideways.push_back(glm::normalize(glm::cross(t, helper)));
    for (std::size_t i = 1; i < line.size(); ++i) {
        const glm::vec3 step = line[i] - line[i - 1];
        const glm::vec3 turned = reflected(tangents[i - 1], step);
        const glm::vec3 carried = reflected(reflected(sideways.back(), step), tangents[i] - turned);
        // Rounding would let the frame lean out of the ring's plane over many rings.
        const glm::vec3 level = carried - glm::dot(carried, tangents[i]) * tangents[i];
        sideways.push_back(glm::length(level) > 1e-6F ? glm::normalize(level) : sideways.back());
    }
    return sideways;
}

// Appends one ring of corners; `lift` [rad] turns its normals from across the line towards the tangent.
void appendRing(Geometry& tube, glm::vec3 centre, glm::vec3 tangent, glm::vec3 side, float lift, int sides,
                float radius) {
    const glm::vec3 other = glm::cross(tangent, side);
    for (int k = 0; k < sides; ++k) {
        const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(sides);
        const glm::vec3 across = std::cos(angle) * side + std::sin(angle) * other;
        const glm::vec3 normal = glm::normalize(std::cos(lift) * across + std::sin(lift) * tangent);
        tube.positions.push_back(centre + radius * normal);
        tube.normals.push_back(normal);
    }
}

}  // namespace

Topology tubeTopology(int points, int subdivisions, int sides, float length, float radius) {
    TAUT_EXPECTS(points >= 2 && subdivisions >= 1 && sides >= 3);
    Topology tube;
    const int cap = capRings(sides);
    const int along = lineRings(points, subdivisions);
    const int rings = along + 2 * cap;

    // u runs along the rope, v around it: up one half and down the other, so that no pattern has a seam.
    tube.uv.emplace_back(-0.5F * std::numbers::pi_v<float> * radius, 0.0F);
    for (int ring = 0; ring < rings; ++ring) {
        float u = length * static_cast<float>(ring - cap) / static_cast<float>(along - 1);
        if (ring < cap) u = -radius * capAngle(ring, sides);
        if (ring >= cap + along) u = length + radius * capAngle(rings - 1 - ring, sides);
        for (int k = 0; k < sides; ++k) {
            const int steps = std::min(k, sides - k);
            tube.uv.emplace_back(
                u, 2.0F * std::numbers::pi_v<float> * radius * static_cast<float>(steps) / static_cast<float>(sides));
        }
    }
    tube.uv.emplace_back(length + 0.5F * std::numbers::pi_v<float> * radius, 0.0F);

    const auto vertex = [&](int ring, int k) { return static_cast<std::uint32_t>(1 + ring * sides + k % sides); };
    const auto lastPole = static_cast<std::uint32_t>(1 + rings * sides);
    for (int k = 0; k < sides; ++k) tube.triangles.insert(tube.triangles.end(), {0U, vertex(0, k + 1), vertex(0, k)});
    for (int ring = 0; ring + 1 < rings; ++ring) {
        for (int k = 0; k < sides; ++k) {
            tube.triangles.insert(tube.triangles.end(),
                                  {vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k + 1)});
            tube.triangles.insert(tube.triangles.end(),
                                  {vertex(ring, k), vertex(ring + 1, k + 1), vertex(ring + 1, k)});
        }
    }
    for (int k = 0; k < sides; ++k)
        tube.triangles.insert(tube.triangles.end(), {vertex(rings - 1, k), vertex(rings - 1, k + 1), lastPole});
    return tube;
}

Geometry tubeGeometry(std::span<const glm::vec3> line, int subdivisions, int sides, float radius) {
    TAUT_EXPECTS(line.size() >= 2 && subdivisions >= 1 && sides >= 3);
    const std::vector<glm::vec3> smooth = smoothLine(line, subdivisions);
    const std::vector<glm::vec3> tangents = tangentsOf(smooth);
    const std::vector<glm::vec3> sideways = sidewaysOf(smooth, tangents);
    const int cap = capRings(sides);

    Geometry tube;
    const std::size_t vertices =
        2 + (smooth.size() + 2 * static_cast<std::size_t>(cap)) * static_cast<std::size_t>(sides);
    tube.positions.reserve(vertices);
    tube.normals.reserve(vertices);
    tube.positions.push_back(smooth.front() - radius * tangents.front());
    tube.normals.push_back(-tangents.front());
    for (int ring = 0; ring < cap; ++ring)
        appendRing(tube, smooth.front(), tangents.front(), sideways.front(), -capAngle(ring, sides), sides, radius);
    for (std::size_t i = 0; i < smooth.size(); ++i)
        appendRing(tube, smooth[i], tangents[i], sideways[i], 0.0F, sides, radius);
    for (int ring = cap; ring-- > 0;)
        appendRing(tube, smooth.back(), tangents.back(), sideways.back(), capAngle(ring, sides), sides, radius);
    tube.positions.push_back(smooth.back() + radius * tangents.back());
    tube.normals.push_back(tangents.back());
    return tube;
}

}  // namespace taut::view
