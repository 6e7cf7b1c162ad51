// What happens in a scene at a moment: the timeline of a scenario, as plain data. It knows neither files nor how it is
// done; a hand at a mouse makes the same actions.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "taut/fields/field.h"
#include "taut/world/source.h"

namespace taut::world {

struct SceneSpec;

// How hands of somebody who plays live are called, from its first letter on; HandSpec::anywhere allows for them.
inline constexpr const char* liveHand = "mouse";

enum class Do { grab, move, release, push, hold, free, cut, addMass, ramp, spawn };

// A number or a vector of the scene that a ramp changes while it runs.
struct RampField {
    fields::Affects affects = fields::Affects::forces;
    std::string owner;  // "material.nylon", "rope.rail", "wind.breeze", "world", …
    std::function<std::vector<double>(const SceneSpec&)> read;  // in the units of the file, as write takes them
    std::function<void(SceneSpec&, const std::vector<double>&)> write;
};

// Happens at the start of tick ⌊t · ticks per second + ½⌋, those of one tick in the order of the list. Which members
// count depends on `what`.
struct ActionSpec {
    Do what = Do::grab;
    Source source;
    double t = 0.0;  // [s]

    std::string id;      // grab, move, release: the name of a hand
    std::string target;  // points KIND.NAME@SELECTOR; of move "collider.NAME"; of spawn a body KIND.NAME
    // Of the target only the point that is nearest to this place when it happens, and those within `radius` of it.
    std::optional<glm::dvec3> near;  // [m]
    double radius = 0.0;             // [m] grab: points of the target's bodies this near to a point of the target too

    // grab
    bool rigid = false;         // led exactly; else drawn by springs
    double strength = 200.0;    // [N/m] of the whole hand, shared by mass
    double dampingRatio = 0.3;  // of the grabbed mass on the hand's spring [-]

    // move: a hand's or a collider's way from where it is; ramp: from the value at that moment
    std::optional<glm::dvec3> to;        // [m]
    std::optional<glm::dvec3> rotation;  // [rad] of a collider, about x, then y, then z
    double over = 0.0;                   // [s]; 0: at once
    Ease ease = Ease::smooth;

    // push
    glm::dvec3 impulse{0.0};  // [N s] of the whole target, shared by mass: every point changes its velocity alike

    // cut: springs of the target's bodies that cross …
    std::optional<glm::dvec3> planePoint, planeNormal;  // … a plane of the world [m], or
    std::optional<glm::dvec2> from,
        upTo;  // … a segment on a grid cloth, in shares of width and height from the top left

    double mass = 1.0;  // [kg] addMass: of the whole target, shared evenly

    // ramp
    std::string key;            // "wind.breeze.velocity"
    std::vector<double> value;  // in the units of the file, see RampField
    RampField field;
};

}  // namespace taut::world
