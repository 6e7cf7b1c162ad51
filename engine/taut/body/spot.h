// A place that moves with points of bodies: the weighted sum of one to four of them. An impulse there acts on each by
// its weight, which adds the same momentum and, as the place is where the sum is, the same angular momentum.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <span>

namespace taut::world {

class Spot {
  public:
    struct Share {
        int point;
        double weight;  // these sum to 1
        bool operator==(const Share&) const = default;
    };
    Spot(int point) : shares_{{{point, 1.0}}} {}
    // Expects one to four.
    explicit Spot(std::span<const Share> shares) : size_(shares.size()) {
        std::copy(shares.begin(), shares.end(), shares_.begin());
    }
    Spot(std::initializer_list<Share> shares) : Spot(std::span(shares.begin(), shares.size())) {}

    std::span<const Share> shares() const { return std::span(shares_).first(size_); }
    bool isPoint() const { return size_ == 1; }
    // The point with the largest weight.
    int nearest() const {
        const Share* best = shares_.data();
        for (const Share& share : shares())
            if (share.weight > best->weight) best = &share;
        return best->point;
    }
    bool has(int point) const {
        for (const Share& share : shares())
            if (share.point == point) return true;
        return false;
    }
    // The same with other numbers of its points.
    template <class NumberOf>
    Spot renumbered(const NumberOf& numberOf) const {
        Spot other = *this;
        for (std::size_t k = 0; k < size_; ++k) other.shares_[k].point = numberOf(shares_[k].point);
        return other;
    }
    bool operator==(const Spot& other) const {
        for (std::size_t k = 0; k < size_; ++k)
            if (other.size_ != size_ || !(shares_[k] == other.shares_[k])) return false;
        return true;
    }

    // Arrays by the numbers of its points.
    glm::dvec3 of(std::span<const glm::dvec3> x) const {
        const auto part = [&](const Share& own) { return own.weight * x[own.point]; };
        glm::dvec3 sum = part(shares_[0]);
        for (std::size_t k = 1; k < size_; ++k) sum += part(shares_[k]);
        return sum;
    }
    // [1/kg] By how much an impulse of 1 N s there changes its velocity.
    double ease(std::span<const double> inverseMass) const {
        double sum = 0;
        for (const auto& [point, weight] : shares()) sum += weight * weight * inverseMass[point];
        return sum;
    }
    void push(std::span<glm::dvec3> x, std::span<const double> inverseMass, const glm::dvec3& impulse) const {
        for (const auto& [point, weight] : shares()) x[point] += (weight * inverseMass[point]) * impulse;
    }

  private:
    std::array<Share, 4> shares_{};
    std::size_t size_ = 1;
};

}  // namespace taut::world
