// Points of a group that go with others, as the surface of a block with the corners of its cells: place and velocity
// are the same sum of theirs, and an impulse on such a point acts on them by the same weights.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "taut/core/private/parallel.h"

namespace taut::contact {

using glm::dvec3;

struct CarriedPoint {
    std::array<int, 8> by;          // none of them carried, or of a solid
    std::array<double, 8> weights;  // their sum is 1
};

class CarriedPoints {
  public:
    CarriedPoints() = default;
    // first: number of the first in the group, where the others follow.
    CarriedPoints(int first, std::vector<CarriedPoint> points) : first_(first), points_(std::move(points)) {}

    bool isEmpty() const { return points_.empty(); }
    bool has(int point) const { return point >= first_ && point < end(); }
    int first() const { return first_; }
    int end() const { return first_ + static_cast<int>(points_.size()); }

    // Calls each(point, weight) for the movers of a point of the group: itself, if it is not carried.
    template <class Each>
    void forEachMover(int point, Each&& each) const {
        if (!has(point)) return each(point, 1.0);
        const CarriedPoint& own = points_[static_cast<std::size_t>(point - first_)];
        for (std::size_t k = 0; k < own.by.size(); ++k)
            if (own.weights[k] != 0) each(own.by[k], own.weights[k]);
    }
    // The value of a field (points) at a carried point, from its movers.
    dvec3 valueAt(int point, std::span<const dvec3> field) const {
        const CarriedPoint& own = points_[static_cast<std::size_t>(point - first_)];
        dvec3 sum(0.0);
        for (std::size_t k = 0; k < own.by.size(); ++k)
            sum += own.weights[k] * field[static_cast<std::size_t>(own.by[k])];
        return sum;
    }
    // Updates all of them from their movers.
    void follow(std::span<dvec3> x, std::span<dvec3> v) const {
        constexpr int atOnce = 512;
        core::parallelFor(static_cast<int>(points_.size()), atOnce, [&](int k) {
            const auto i = static_cast<std::size_t>(first_ + k);
            x[i] = valueAt(first_ + k, x);
            v[i] = valueAt(first_ + k, v);
        });
    }

  private:
    int first_ = 0;
    std::vector<CarriedPoint> points_;
};

}  // namespace taut::contact
