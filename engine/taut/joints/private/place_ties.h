// The springs of an island that end between points. They hold nothing: the island has a force for them
// (mechanics/place_springs.h). As a constraint they break, are released and saved.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/plan/constraint.h"
#include "taut/plan/private/tie_ends.h"

namespace taut::world {

class PlaceTies final : public ConstraintOf<PlaceTies> {
  public:
    // Spots of the plan; those of `pull` are set to them.
    template <class End>
    void tie(const Spot& a, const End& b, Pull pull) {
        pull.a = ends_.of(a, pulls_);
        if constexpr (std::is_same_v<End, Spot>)
            pull.b = ends_.of(b, pulls_);
        else
            pull.b = ends_.of(b);
        pulls_.push_back(pull);
    }

    std::span<const int> points() const override { return ends_.points; }
    std::span<const Place> places() const override { return ends_.places; }
    bool projectPositions(const Moment&) override { return false; }
    bool projectVelocities(const Moment&) override { return false; }
    std::optional<std::vector<Pair>> joinedFrom(double) const override { return std::vector<Pair>(); }
    int size() const override { return static_cast<int>(pulls_.size()); }
    double strain(std::span<const dvec3> x, const std::vector<bool>& counts) const override {
        double most = 0;
        for (const Pull& pull : pulls()) {
            const auto all = TieEnds::difference(pull.a, pull.b);
            const bool isCounted = std::all_of(all.begin(), all.end(), [&](const Spot::Share& own) {
                return counts[static_cast<std::size_t>(own.point)];
            });
            const dvec3 d = pull.a.of(x) - pull.b.of(x);
            if (isCounted && pull.stiffness > 0 && pull.length > 0)
                most = std::max(most, std::abs(std::sqrt(glm::dot(d, d)) / pull.length - 1.0));
        }
        return most;
    }
    std::vector<Pull> pulls() const override {
        std::vector<Pull> all = pulls_;
        for (std::size_t tie = 0; tie < all.size(); ++tie)
            if (!holds(static_cast<int>(tie))) all[tie].stiffness = all[tie].damping = 0;
        return all;
    }

  private:
    TieEnds ends_;
    std::vector<Pull> pulls_;
};

}  // namespace taut::world
