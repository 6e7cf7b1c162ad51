// Building a triangle mesh: checks, the inside of a closed one, the cells that answer from afar.
#include <algorithm>
#include <array>
#include <string>

#include "taut/collision/triangle_mesh.h"
#include "taut/core/error.h"

namespace taut::collision {

namespace {

constexpr std::size_t mostTriangles = 2'000'000;  // Bullet numbers a mesh's triangles with 21 bits
constexpr int cellsAlongLongest = 24;

[[noreturn]] void failMesh(const std::string& what) {
    throw core::Error(core::ErrorKind::badContent, "collider mesh: " + what);
}

}  // namespace

TriangleMesh::TriangleMesh(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles) {
    takeTriangles(vertices, triangles);
    findOutside(vertices);
    tree_ = MeshTree(vertices, corners_);
    measureCells();
}

void TriangleMesh::takeTriangles(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles) {
    if (triangles.empty()) failMesh("has no triangles");
    if (triangles.size() % 3 != 0) failMesh("the number of its corners is not a multiple of three");
    if (triangles.size() / 3 > mostTriangles) failMesh("has more than two million triangles");
    for (const dvec3& v : vertices)
        if (!isFinite(v)) failMesh("a vertex is not finite");
    for (const std::uint32_t corner : triangles)
        if (corner >= vertices.size())
            failMesh("a triangle names vertex " + std::to_string(corner) + ", there are " +
                     std::to_string(vertices.size()));
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const dvec3& a = vertices[triangles[i]];
        const dvec3 ab = vertices[triangles[i + 1]] - a;
        const dvec3 ac = vertices[triangles[i + 2]] - a;
        const dvec3 bc = ac - ab;
        const dvec3 across = glm::cross(ab, ac);
        const double twiceArea = std::sqrt(glm::dot(across, across));
        const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
        if (!(twiceArea > 1e-12 * longest)) continue;  // a line or a point: its neighbours cover it
        triangles_.push_back({a, ab, ac, across / twiceArea});
        for (std::size_t k = 0; k < 3; ++k) {
            corners_.push_back(triangles[i + k]);
            bounds_.add(vertices[triangles[i + k]]);
        }
    }
    if (triangles_.empty()) failMesh("all its triangles have no area");
}

void TriangleMesh::findOutside(std::span<const dvec3> vertices) {
    // Files repeat a vertex where its texture or normal differs: vertices at one place count as one.
    std::vector<std::uint32_t> order(vertices.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto key = [&](std::uint32_t i) { return std::array{vertices[i].x, vertices[i].y, vertices[i].z}; };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    std::vector<std::uint32_t> same(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        same[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? same[order[i - 1]] : order[i];

    // Closed: the directed edges, sorted, are the same as their reverses, and none comes twice.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> reverses;
    for (std::size_t i = 0; i < corners_.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = same[corners_[i + k]];
            const std::uint32_t b = same[corners_[i + (k + 1) % 3]];
            edges.emplace_back(a, b);
            reverses.emplace_back(b, a);
        }
    }
    std::sort(edges.begin(), edges.end());
    std::sort(reverses.begin(), reverses.end());
    closed_ = edges == reverses && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
    if (!closed_) return;

    double sixVolumes = 0.0;
    for (const Triangle& t : triangles_) {
        const dvec3 a = t.corner - bounds_.low;
        sixVolumes += glm::dot(a, glm::cross(a + t.ab, a + t.ac));
    }
    if (sixVolumes >= 0.0) return;
    for (Triangle& t : triangles_) {
        std::swap(t.ab, t.ac);
        t.normal = -t.normal;
    }
}

void TriangleMesh::measureCells() {
    const dvec3 size = bounds_.high - bounds_.low;
    cellSize_ = std::max({size.x, size.y, size.z}) / cellsAlongLongest;
    for (int k = 0; k < 3; ++k)
        cellCount_[k] = std::clamp(static_cast<int>(size[k] / cellSize_) + 1, 1, cellsAlongLongest + 1);

    // From cell to cell the distance changes by no more than the way, which bounds the search.
    double known = std::sqrt(glm::dot(size, size)) + 2.0 * cellSize_;
    dvec3 last = bounds_.low;
    cells_.reserve(static_cast<std::size_t>(cellCount_.x * cellCount_.y * cellCount_.z));
    for (int z = 0; z < cellCount_.z; ++z) {
        for (int y = 0; y < cellCount_.y; ++y) {
            for (int x = 0; x < cellCount_.x; ++x) {
                const dvec3 middle = bounds_.low + (dvec3(x, y, z) + 0.5) * cellSize_;
                const double radius = (known + glm::length(middle - last)) * (1.0 + 1e-6) + 1e-9 * cellSize_;
                const double distance = nearestFrom(middle, footWithin(middle, radius)).distance;
                cells_.push_back(distance);
                known = std::abs(distance);
                last = middle;
            }
        }
    }
}

}  // namespace taut::collision
