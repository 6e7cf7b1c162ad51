// A batch of pairs: the kernels find their closest points together. Slots count from 0.
#pragma once

#include <array>
#include <deque>
#include <glm/vec3.hpp>
#include <span>

#include "taut/contact/closest_kernel.h"

namespace taut::contact {

class ClosestBatch {
  public:
    void clear() { count_ = 0; }
    int count() const { return count_; }

    // The places [m] of these points, as ClosestLanes::at. Returns the slot.
    int add(std::span<const glm::dvec3> x, const std::array<int, 4>& points) {
        if (count_ == static_cast<int>(lanes_.size()) * closestBatch) lanes_.emplace_back();
        ClosestLanes& into = lanes_[static_cast<std::size_t>(count_ / closestBatch)];
        const int lane = count_ % closestBatch;
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec3& place = x[static_cast<std::size_t>(points[i])];
            for (int k = 0; k < 3; ++k) into.at[i][k][lane] = place[k];
        }
        return count_++;
    }

    // One of ClosestKernels.
    void solve(void (*kernel)(ClosestLanes&, int)) {
        for (int from = 0; from < count_; from += closestBatch)
            kernel(lanes_[static_cast<std::size_t>(from / closestBatch)],
                   count_ - from < closestBatch ? count_ - from : closestBatch);
    }

    // After solve().
    std::array<double, 4> weights(int slot) const {
        const ClosestLanes& from = lanesOf(slot);
        const int lane = slot % closestBatch;
        return {from.weights[0][lane], from.weights[1][lane], from.weights[2][lane], from.weights[3][lane]};
    }
    glm::dvec3 separation(int slot) const {
        const ClosestLanes& from = lanesOf(slot);
        const int lane = slot % closestBatch;
        return {from.separation[0][lane], from.separation[1][lane], from.separation[2][lane]};
    }
    double distance(int slot) const { return lanesOf(slot).distance[slot % closestBatch]; }
    std::int64_t where(int slot) const { return lanesOf(slot).where[slot % closestBatch]; }

  private:
    const ClosestLanes& lanesOf(int slot) const { return lanes_[static_cast<std::size_t>(slot / closestBatch)]; }

    std::deque<ClosestLanes> lanes_;
    int count_ = 0;
};

}  // namespace taut::contact
