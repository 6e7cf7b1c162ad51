// The joints of the engine.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "taut/spec/joint_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

// Points made one, or kept in one place.
struct WeldJoint final : SpecOf<WeldJoint, JointSpec> {
    static constexpr std::string_view kindName = "weld";
    double furthest = 0.02;  // [m] apart that points may be

    std::string_view title() const override { return "a weld"; }
    double reach() const override { return furthest; }
    bool isWeld() const override { return true; }
    void tie(IslandPlan& plan, int a, int b, double distance) const override;
    void carry(IslandPlan& plan, Grip grip) const override;
};

// Springs, as long as points are apart if not said.
struct SpringJoint final : SpecOf<SpringJoint, JointSpec> {
    static constexpr std::string_view kindName = "spring";
    double stiffness = 1e4;     // [N/m] of each spring
    double dampingTime = 1e-4;  // [s]
    std::optional<double> restLength;  // [m]; none: the distance as the scene starts

    std::string_view title() const override { return "a spring joint"; }
    void tie(IslandPlan& plan, int a, int b, double distance) const override;
    void carry(IslandPlan& plan, Grip grip) const override;
};

// A distance that stays, between points or from a place on a collider.
struct RodJoint final : SpecOf<RodJoint, JointSpec> {
    static constexpr std::string_view kindName = "rod";
    std::optional<glm::dvec3> place;  // [m] on the collider as the scene starts; none: its centre

    std::string_view title() const override { return "a rod"; }
    bool tiesWithin() const override { return true; }
    void tie(IslandPlan& plan, int a, int b, double distance) const override;
    void carry(IslandPlan& plan, Grip grip) const override;
};

}  // namespace taut::world
