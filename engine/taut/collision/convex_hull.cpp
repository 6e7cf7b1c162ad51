#include "taut/collision/private/convex_hull.h"

#include <algorithm>
#include <array>

namespace taut::collision {

namespace {

__extension__ using Wide = __int128;

class Builder {
  public:
    explicit Builder(std::span<const dvec3> points) {
        core::Aabb box;
        for (const dvec3& p : points) box.add(p);
        const dvec3 size = box.high - box.low;
        const double longest = std::max({size.x, size.y, size.z});
        const double scale = longest > 0.0 ? 0x1p40 / longest : 0.0;
        for (const dvec3& p : points) points_.push_back(glm::floor((p - box.low) * scale + 0.5));
        faceFrom_.resize(points.size());
    }

    std::vector<std::uint32_t> build() {
        std::vector<std::uint32_t> triangles;
        if (!start()) return triangles;
        for (std::size_t f = 0; f < faces_.size(); ++f)
            if (faces_[f].exists && !faces_[f].above.empty()) grow(f);
        for (const Face& face : faces_)
            if (face.exists) triangles.insert(triangles.end(), face.corners.begin(), face.corners.end());
        return triangles;
    }

  private:
    struct Face {
        std::array<std::uint32_t, 3> corners;
        std::array<std::size_t, 3> beyond{};  // the face on the other side of the edge from corner k to the next
        std::vector<std::uint32_t> above{};   // points outside this face that no other face lists
        bool exists = true;
    };

    // Six times the volume of the tetrahedron, above zero if d is on the side from which a, b, c turn
    // counter-clockwise. Its sign is exact: if rounding leaves it open, it is computed again in whole numbers of 128
    // bits. They are wide enough for products of three differences of 41 bits.
    double heightOver(const std::array<std::uint32_t, 3>& corners, std::uint32_t d) const {
        const dvec3& a = points_[corners[0]];
        const dvec3 u = points_[corners[1]] - a;
        const dvec3 v = points_[corners[2]] - a;
        const dvec3 w = points_[d] - a;
        const double volume = glm::dot(glm::cross(u, v), w);
        const auto largest = [](const dvec3& e) { return std::max({std::abs(e.x), std::abs(e.y), std::abs(e.z)}); };
        if (std::abs(volume) > 0x1p-47 * largest(u) * largest(v) * largest(w)) return volume;
        const auto whole = [](double e) { return static_cast<Wide>(e); };
        const Wide x = whole(u.y) * whole(v.z) - whole(u.z) * whole(v.y);
        const Wide y = whole(u.z) * whole(v.x) - whole(u.x) * whole(v.z);
        const Wide z = whole(u.x) * whole(v.y) - whole(u.y) * whole(v.x);
        return static_cast<double>(x * whole(w.x) + y * whole(w.y) + z * whole(w.z));
    }

    // Starts with a tetrahedron of points far from each other. False if all points lie in one plane.
    bool start() {
        const auto count = static_cast<std::uint32_t>(points_.size());
        if (count < 4) return false;
        const auto farthest = [&](const auto& measure) {
            std::uint32_t best = 0;
            for (std::uint32_t i = 1; i < count; ++i)
                if (measure(i) > measure(best)) best = i;
            return best;
        };
        const auto square = [](const dvec3& e) { return glm::dot(e, e); };
        const std::uint32_t a = farthest([&](std::uint32_t i) { return square(points_[i] - points_[0]); });
        const std::uint32_t b = farthest([&](std::uint32_t i) { return square(points_[i] - points_[a]); });
        const dvec3 ab = points_[b] - points_[a];
        const std::uint32_t c =
            farthest([&](std::uint32_t i) { return square(glm::cross(ab, points_[i] - points_[a])); });
        const std::uint32_t d = farthest([&](std::uint32_t i) { return std::abs(heightOver({a, b, c}, i)); });
        const double height = heightOver({a, b, c}, d);
        if (height == 0.0) return false;
        const std::array<std::uint32_t, 4> p = height < 0.0 ? std::array{a, b, c, d} : std::array{a, c, b, d};
        faces_ = {{{p[0], p[1], p[2]}, {1, 2, 3}},
                  {{p[1], p[0], p[3]}, {0, 3, 2}},
                  {{p[2], p[1], p[3]}, {0, 1, 3}},
                  {{p[0], p[2], p[3]}, {0, 2, 1}}};
        std::vector<std::uint32_t> all(count);
        for (std::uint32_t i = 0; i < count; ++i) all[i] = i;
        share(all, 0);
        return true;
    }

    // Gives each point to the first face, from `first` on, that it is above.
    void share(const std::vector<std::uint32_t>& points, std::size_t first) {
        for (const std::uint32_t point : points) {
            for (std::size_t f = first; f < faces_.size(); ++f) {
                if (!(heightOver(faces_[f].corners, point) > 0.0)) continue;
                faces_[f].above.push_back(point);
                break;
            }
        }
    }

    // Removes all faces that the highest point over a face sees. New faces lead from the border of the hole to this
    // point. The point does not see faces in whose plane it lies, so every new face has an area.
    void grow(std::size_t from) {
        std::uint32_t apex = faces_[from].above[0];
        double highest = 0.0;
        for (const std::uint32_t point : faces_[from].above) {
            const double height = heightOver(faces_[from].corners, point);
            if (!(height > highest)) continue;
            highest = height;
            apex = point;
        }

        // The faces that the apex sees, from neighbour to neighbour, and the border of the hole.
        struct Edge {
            std::uint32_t from, to;
            std::size_t beyond;
        };
        std::vector<Edge> border;
        std::vector<std::size_t> seen{from};
        std::vector<std::uint32_t> left;
        faces_[from].exists = false;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const std::size_t f = seen[i];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t beyond = faces_[f].beyond[k];
                if (!faces_[beyond].exists) continue;
                if (heightOver(faces_[beyond].corners, apex) > 0.0) {
                    faces_[beyond].exists = false;
                    seen.push_back(beyond);
                } else {
                    border.push_back({faces_[f].corners[k], faces_[f].corners[(k + 1) % 3], beyond});
                }
            }
            left.insert(left.end(), faces_[f].above.begin(), faces_[f].above.end());
            faces_[f].above = {};
        }

        // A new face for each border edge. It gets its neighbours, and the points above the removed faces.
        const std::size_t first = faces_.size();
        for (const Edge& edge : border) {
            faceFrom_[edge.from] = faces_.size();
            Face& old = faces_[edge.beyond];
            for (std::size_t k = 0; k < 3; ++k)
                if (old.corners[k] == edge.to && old.corners[(k + 1) % 3] == edge.from) old.beyond[k] = faces_.size();
            faces_.push_back({{edge.from, edge.to, apex}, {edge.beyond, 0, 0}});
        }
        for (std::size_t f = first; f < faces_.size(); ++f) {
            const std::size_t next = faceFrom_[faces_[f].corners[1]];
            faces_[f].beyond[1] = next;
            faces_[next].beyond[2] = f;
        }
        share(left, first);
    }

    std::vector<dvec3> points_;  // whole numbers from 0 to 2⁴⁰
    std::vector<Face> faces_;
    std::vector<std::size_t> faceFrom_;  // (points) the new face whose border edge starts there
};

}  // namespace

std::vector<std::uint32_t> convexHull(std::span<const dvec3> points) {
    return Builder(points).build();
}

}  // namespace taut::collision
