// The joints of the engine.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "taut/body/spot.h"
#include "taut/spec/joint_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

// Merges points, or keeps them in one place.
struct WeldJoint final : SpecOf<WeldJoint, JointSpec> {
    static constexpr std::string_view kindName = "weld";
    double furthest = weldReach;  // [m] largest distance of points that it ties

    std::string_view title() const override { return "a weld"; }
    double reach() const override { return furthest; }
    bool isWeld() const override { return true; }
    void tie(IslandPlan& plan, const Spot& a, const Spot& b, double distance) const override;
    void carry(IslandPlan& plan, const Spot& end, Grip grip) const override;
};

// Springs; their rest length is the starting distance unless given.
struct SpringJoint final : SpecOf<SpringJoint, JointSpec> {
    static constexpr std::string_view kindName = "spring";
    double stiffness = 1e4;            // [N/m] of each spring
    double dampingTime = 1e-4;         // [s]
    std::optional<double> restLength;  // [m]; none: the distance at the start, to a collider 0

    std::string_view title() const override { return "a spring joint"; }
    void tie(IslandPlan& plan, const Spot& a, const Spot& b, double distance) const override;
    void carry(IslandPlan& plan, const Spot& end, Grip grip) const override;
};

// Keeps a distance, between points or from a place on a collider, its centre if not given.
struct RodJoint final : SpecOf<RodJoint, JointSpec> {
    static constexpr std::string_view kindName = "rod";
    std::string_view title() const override { return "a rod"; }
    bool tiesWithin() const override { return true; }
    void tie(IslandPlan& plan, const Spot& a, const Spot& b, double distance) const override;
    void carry(IslandPlan& plan, const Spot& end, Grip grip) const override;
};

// Holds two bodies together at a place. They turn about it by any rotation, or by one that leans their common direction
// `axis` less than a cone.
struct BallJoint final : SpecOf<BallJoint, JointSpec> {
    static constexpr std::string_view kindName = "ball";
    std::optional<double> cone;  // [rad] largest angle of the axis in both bodies; none: any
    dvec3 axis{0.0, 1.0, 0.0};   // in the axes of `place`

    std::string_view title() const override { return "a ball joint"; }
    bool isMounted() const override { return true; }
    void mount(IslandPlan& plan, const Mounting& at) const override;
    void tie(IslandPlan&, const Spot&, const Spot&, double) const override {}
    void carry(IslandPlan&, const Spot&, Grip) const override;
};

// Holds two bodies together at an axis, about which they turn.
struct HingeJoint final : SpecOf<HingeJoint, JointSpec> {
    static constexpr std::string_view kindName = "hinge";
    dvec3 axis{0.0, 1.0, 0.0};             // in the axes of `place`
    std::optional<glm::dvec2> limits;      // [rad] of the second body's turn about it since the start
    double friction = 0, damping = 0;      // [N m], [N m s]
    double motorSpeed = 0, motorMost = 0;  // [rad/s], [N m]; 0: no motor

    std::string_view title() const override { return "a hinge"; }
    bool isMounted() const override { return true; }
    void mount(IslandPlan& plan, const Mounting& at) const override;
    void tie(IslandPlan&, const Spot&, const Spot&, double) const override {}
    void carry(IslandPlan&, const Spot&, Grip) const override;
};

// Holds two bodies together so that the second slides along an axis of the first, without turning.
struct SliderJoint final : SpecOf<SliderJoint, JointSpec> {
    static constexpr std::string_view kindName = "slider";
    dvec3 axis{0.0, 1.0, 0.0};             // in the axes of `place`
    std::optional<glm::dvec2> limits;      // [m] of the second body's way along it since the start
    double friction = 0, damping = 0;      // [N], [N s/m]
    double motorSpeed = 0, motorMost = 0;  // [m/s], [N]; 0: no motor

    std::string_view title() const override { return "a slider"; }
    bool isMounted() const override { return true; }
    void mount(IslandPlan& plan, const Mounting& at) const override;
    void tie(IslandPlan&, const Spot&, const Spot&, double) const override {}
    void carry(IslandPlan&, const Spot&, Grip) const override;
};

// Draws two edges together, then keeps them together.
struct SeamJoint final : SpecOf<SeamJoint, JointSpec> {
    static constexpr std::string_view kindName = "seam";
    double over = 0;   // [s] from its start until it is closed; 0: it is as the scene starts
    double start = 0;  // [s] when it begins to close

    std::string_view title() const override { return "a seam"; }
    double reach() const override { return over > 0 ? HUGE_VAL : weldReach; }
    bool tiesWithin() const override { return true; }
    bool isWeld() const override { return !(over > 0); }
    bool isSeam() const override { return true; }
    void tie(IslandPlan& plan, const Spot& a, const Spot& b, double distance) const override;
    void carry(IslandPlan& plan, const Spot& end, Grip grip) const override;
};

// It is not among the kinds of [[joint]]: scenes have [[seam]].
Kind<JointSpec> seamKind();

}  // namespace taut::world
