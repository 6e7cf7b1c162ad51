// Pairs of which the nearest places are found together; slots are counted from 0.
#pragma once

#include <array>
#include <deque>
#include <glm/vec3.hpp>

#include "taut/contact/nearest_kernel.h"

namespace taut::contact {

class NearestBatch {
  public:
    void clear() { count_ = 0; }
    int count() const { return count_; }

    // [m], as NearestLanes::at. Returns the slot.
    int add(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, const glm::dvec3& s) {
        if (count_ == static_cast<int>(lanes_.size()) * nearestBatch) lanes_.emplace_back();
        NearestLanes& into = lanes_[static_cast<std::size_t>(count_ / nearestBatch)];
        const int lane = count_ % nearestBatch;
        for (int k = 0; k < 3; ++k) {
            into.at[0][k][lane] = p[k];
            into.at[1][k][lane] = q[k];
            into.at[2][k][lane] = r[k];
            into.at[3][k][lane] = s[k];
        }
        return count_++;
    }

    // One of NearestKernels.
    void solve(void (*kernel)(NearestLanes&, int)) {
        for (int from = 0; from < count_; from += nearestBatch)
            kernel(lanes_[static_cast<std::size_t>(from / nearestBatch)],
                   count_ - from < nearestBatch ? count_ - from : nearestBatch);
    }

    // After that.
    std::array<double, 4> weights(int slot) const {
        const NearestLanes& from = lanesOf(slot);
        const int lane = slot % nearestBatch;
        return {from.weights[0][lane], from.weights[1][lane], from.weights[2][lane], from.weights[3][lane]};
    }
    glm::dvec3 apart(int slot) const {
        const NearestLanes& from = lanesOf(slot);
        const int lane = slot % nearestBatch;
        return {from.apart[0][lane], from.apart[1][lane], from.apart[2][lane]};
    }
    double distance(int slot) const { return lanesOf(slot).distance[slot % nearestBatch]; }
    long where(int slot) const { return lanesOf(slot).where[slot % nearestBatch]; }

  private:
    const NearestLanes& lanesOf(int slot) const { return lanes_[static_cast<std::size_t>(slot / nearestBatch)]; }

    std::deque<NearestLanes> lanes_;
    int count_ = 0;
};

}  // namespace taut::contact
