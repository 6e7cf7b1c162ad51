#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "taut/core/error.h"
#include "taut/view/primitives.h"

namespace taut::view {

namespace {

constexpr glm::vec3 upwards(0.0F, 1.0F, 0.0F);

// Unit vector, or upwards if there is no direction. Scaled first: the square of a small area may underflow.
glm::vec3 direction(glm::vec3 sum) {
    const float largest = std::max({std::abs(sum.x), std::abs(sum.y), std::abs(sum.z)});
    if (!(largest > 0.0F) || !std::isfinite(largest)) return upwards;
    return glm::normalize(sum / largest);
}

// Twice the area of a triangle along its normal.
glm::vec3 areaNormal(std::span<const glm::vec3> positions, const std::uint32_t* corner) {
    const glm::vec3 a = positions[corner[0]];
    return glm::cross(positions[corner[1]] - a, positions[corner[2]] - a);
}

// Which triangles meet at each point: those of point p are triangles[first[p]] … triangles[first[p + 1] - 1].
struct Fans {
    std::vector<std::size_t> first;      // (points + 1)
    std::vector<std::size_t> triangles;  // (3 · triangles)
};

Fans fansOf(std::size_t points, std::span<const std::uint32_t> triangles) {
    Fans fans;
    fans.first.assign(points + 1, 0);
    for (const std::uint32_t p : triangles) ++fans.first[p + 1];
    for (std::size_t p = 0; p < points; ++p) fans.first[p + 1] += fans.first[p];
    std::vector<std::size_t> next(fans.first.begin(), fans.first.end() - 1);
    fans.triangles.resize(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) fans.triangles[next[triangles[i]]++] = i / 3;
    return fans;
}

// Metres along the two axes that the surface faces least.
glm::vec2 boxProjection(glm::vec3 position, glm::vec3 normal) {
    const glm::vec3 size = glm::abs(normal);
    if (size.y >= size.x && size.y >= size.z) return {position.x, -position.z};
    if (size.x >= size.z) return {-position.z, position.y};
    return {position.x, position.y};
}

}  // namespace

void smoothNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles,
                   std::span<glm::vec3> normals) {
    TAUT_EXPECTS(normals.size() == positions.size() && triangles.size() % 3 == 0);
    std::fill(normals.begin(), normals.end(), glm::vec3(0.0F));
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const glm::vec3 area = areaNormal(positions, &triangles[i]);
        for (std::size_t k = 0; k < 3; ++k) normals[triangles[i + k]] += area;
    }
    for (glm::vec3& normal : normals) normal = direction(normal);
}

Mesh creasedMesh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles, float creaseAngle) {
    TAUT_EXPECTS(triangles.size() % 3 == 0);
    for (const std::uint32_t corner : triangles) TAUT_EXPECTS(corner < positions.size());
    std::vector<glm::vec3> areas;  // (triangles)
    for (std::size_t i = 0; i < triangles.size(); i += 3) areas.push_back(areaNormal(positions, &triangles[i]));
    const Fans fans = fansOf(positions.size(), triangles);
    const float leastCosine = std::cos(creaseAngle);

    Topology topology;
    Geometry geometry;
    topology.triangles.resize(triangles.size());
    std::vector<std::vector<std::uint32_t>> copies(positions.size());  // vertices made of each point so far
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        // The triangles of the fan that this one passes into smoothly.
        const std::uint32_t point = triangles[i];
        const glm::vec3 own = direction(areas[i / 3]);
        glm::vec3 sum(0.0F);
        for (std::size_t k = fans.first[point]; k < fans.first[point + 1]; ++k) {
            const glm::vec3 other = areas[fans.triangles[k]];
            if (fans.triangles[k] == i / 3 || glm::dot(own, direction(other)) > leastCosine) sum += other;
        }
        const glm::vec3 normal = direction(sum);

        // Corners with the same point and the same normal share a vertex.
        auto& known = copies[point];
        const auto same = std::find_if(known.begin(), known.end(), [&](std::uint32_t vertex) {
            return glm::dot(geometry.normals[vertex], normal) > 0.9999F;
        });
        if (same != known.end()) {
            topology.triangles[i] = *same;
            continue;
        }
        topology.triangles[i] = static_cast<std::uint32_t>(geometry.positions.size());
        known.push_back(topology.triangles[i]);
        geometry.positions.push_back(positions[point]);
        geometry.normals.push_back(normal);
        topology.uv.push_back(boxProjection(positions[point], normal));
    }
    return {std::make_shared<const Topology>(std::move(topology)),
            std::make_shared<const Geometry>(std::move(geometry))};
}

}  // namespace taut::view
