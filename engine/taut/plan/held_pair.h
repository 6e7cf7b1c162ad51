// A pair that a constraint holds (Constraint::Pair), with ends in the points of the plan.
#pragma once

#include <glm/geometric.hpp>

#include "taut/plan/constraint.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

struct HeldPair {
    struct End {
        Spot spot;                                 // of the plan; without meaning on a collider
        const Constraint::Place* place = nullptr;  // on a collider
        int point() const { return place != nullptr ? -1 : spot.nearest(); }
        // [m] x: (points of the plan), at t [s].
        dvec3 at(const IslandPlan& plan, std::span<const dvec3> x, double t) const {
            if (place == nullptr) return spot.of(x);
            const mechanics::PosePath::Frame frame = pathOf(plan, place->collider).at(t);
            return frame.place + frame.arm(place->offset);
        }
    };
    // [m] The ends; of a line on which b slides, a is the place nearest to b.
    std::array<dvec3, 2> ends(const IslandPlan& plan, std::span<const dvec3> x, double t) const {
        std::array<dvec3, 2> at{a.at(plan, x, t), b.at(plan, x, t)};
        if (line) at[0] += glm::dot(at[1] - at[0], along(plan, x, t)) * along(plan, x, t);
        return at;
    }
    // Unit, of that line. Expects one.
    dvec3 along(const IslandPlan& plan, std::span<const dvec3> x, double t) const {
        return glm::normalize(line->at(plan, x, t) - a.at(plan, x, t));
    }

    End a, b;
    JointTie::Part by;    // that bears it
    double length = 0;    // [m]
    bool isMost = false;  // of the length: they may be nearer
    std::optional<End> line{};
};

}  // namespace taut::world
