// The actions of the engine as plain data. actions/ has their effects, action_spec.h their times.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/spec/action_spec.h"

namespace taut::world {

struct SceneSpec;

// The names of a live player's hands begin with this. HandSpec::anywhere makes steps allow for them.
inline constexpr const char* liveHand = "mouse";

// An action on points of bodies.
struct PointsAction : ActionSpec {
    std::string target;  // KIND.NAME@SELECTOR; all points without @
    // If set, only the point nearest to this place at that moment.
    std::optional<glm::dvec3> near;  // [m]
};

// A hand takes hold of points at their places.
struct GrabAction final : SpecOf<GrabAction, PointsAction> {
    static constexpr std::string_view kindName = "grab";
    void perform(World& world) const override;

    std::string id;                  // of the hand
    double radius = 0.0;             // [m] also points of the target's bodies this near to a point of the target
    bool rigid = false;              // points follow exactly; else springs draw them
    double strength = 200.0;         // [N/m] of the whole hand, shared by mass
    double dampingRatio = 0.3;       // of the grabbed mass on the hand's spring [-]
    std::optional<double> maxForce;  // [N] largest force of the whole hand, shared by mass; none: no limit
};

// Moves a hand or a collider from its present place.
struct MoveAction final : SpecOf<MoveAction, ActionSpec> {
    static constexpr std::string_view kindName = "move";
    void perform(World& world) const override;

    std::string id;                // of the hand; empty: a collider
    std::string target;            // "collider.NAME"
    std::optional<glm::dvec3> to;  // [m]
    // [rad] about x, then y, then z. A collider turns the short way. A hand turns by these angles, counted from its
    // grab.
    std::optional<glm::dvec3> rotation;
    double over = 0.0;  // [s]; 0: at once
    Ease ease = Ease::smooth;
};

struct ReleaseAction final : SpecOf<ReleaseAction, ActionSpec> {
    static constexpr std::string_view kindName = "release";
    void perform(World& world) const override;

    std::string id;  // of the hand, or name of joints
};

struct PushAction final : SpecOf<PushAction, PointsAction> {
    static constexpr std::string_view kindName = "push";
    void perform(World& world) const override;

    glm::dvec3 impulse{0.0};  // [N s] of the whole target, shared by mass: all points change their velocity alike
};

// From then on the points stay in place, move with a collider, or are free.
struct HoldAction final : SpecOf<HoldAction, PointsAction> {
    static constexpr std::string_view kindName = "hold";
    void perform(World& world) const override;

    std::string holdOn;  // "collider.pole"; empty: they stay in place
};
struct FreeAction final : SpecOf<FreeAction, PointsAction> {
    static constexpr std::string_view kindName = "free";
    void perform(World& world) const override;
};

// Cuts the springs of bodies: all springs, or the springs that cross …
struct CutAction final : SpecOf<CutAction, ActionSpec> {
    static constexpr std::string_view kindName = "cut";
    void perform(World& world) const override;

    std::string target;                                 // KIND.NAME
    std::optional<glm::dvec3> planePoint, planeNormal;  // … a plane of the world [m], or
    std::optional<glm::dvec2> from,
        upTo;  // … a segment on a grid cloth, in shares of width and height from the top left
};

// The points keep their velocities.
struct AddMassAction final : SpecOf<AddMassAction, PointsAction> {
    static constexpr std::string_view kindName = "add-mass";
    void perform(World& world) const override;

    double mass = 1.0;  // [kg] of the whole target, shared evenly
};

// A number or a vector of the scene that a ramp changes during a run.
struct RampField {
    fields::Affects affects = fields::Affects::forces;
    std::string owner;  // "material.nylon", "rope.rail", "wind.breeze", "world", …

    virtual ~RampField() = default;
    virtual std::vector<double> read(
        const SceneSpec& scene) const = 0;  // in the units of the file, as write() takes them
    virtual void write(SceneSpec& scene, const std::vector<double>& value) const = 0;
};

// A field goes from its present value to another one. A later ramp of the same field starts from its value at that
// time.
struct RampAction final : SpecOf<RampAction, ActionSpec> {
    static constexpr std::string_view kindName = "ramp";
    void perform(World& world) const override;

    std::string key;            // "wind.breeze.velocity"
    std::vector<double> value;  // in the units of the file
    double over = 0.0;          // [s]; 0: at once
    Ease ease = Ease::smooth;
    std::shared_ptr<const RampField> field;  // the field that the key names
};

// A body appears that was not there from the start.
struct SpawnAction final : SpecOf<SpawnAction, ActionSpec> {
    static constexpr std::string_view kindName = "spawn";
    void perform(World& world) const override;

    std::string target;  // KIND.NAME
};

}  // namespace taut::world
