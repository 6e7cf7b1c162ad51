// An axis-aligned bounding box. Independent of its contents.
#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace taut::core {

// Empty until a point is added.
struct Aabb {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Aabb& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    void grow(double by) {
        low -= by;
        high += by;
    }
    glm::dvec3 centre() const { return 0.5 * (low + high); }
    glm::dvec3 halfSize() const { return 0.5 * (high - low); }
    bool contains(const glm::dvec3& p) const {
        return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
    }
    // Whether boxes are no further apart than `within` along each axis.
    // 0 … 7: on the high side of axis k if bit k is set.
    glm::dvec3 corner(int i) const {
        return {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
    }
    bool overlaps(const Aabb& other, double within) const {
        return low.x <= other.high.x + within && other.low.x <= high.x + within && low.y <= other.high.y + within &&
               other.low.y <= high.y + within && low.z <= other.high.z + within && other.low.z <= high.z + within;
    }
};

}  // namespace taut::core
