// A force that is a function of the program that uses the engine, in any language. The function gets the points that it
// acts on as plain lists, in the order of authoring.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "taut/forces/force.h"

namespace taut::world {

// The points of the targets in one island at a moment of a step: body by body as in the state hash, each body's in the
// order of authoring. A point that two bodies share is there twice.
struct CallbackPoints {
    double t = 0;                  // [s]
    std::span<const dvec3> x, v;   // (points) [m], [m/s]
    std::span<const double> mass;  // (points) [kg], also of held points
};

struct CallbackSpec {
    std::string name{};                  // "force.pull", of a kind that scenes do not have
    std::vector<std::string> targets{};  // KIND.NAME@SELECTOR; empty: all points of all bodies

    // Writes the force on every point into f (points) [N]. Forces on held points do not count; of a shared point the
    // first entry counts. Called once an evaluation for each island that has such points, in the order of the islands
    // and never for two at a time. Called again for the same moment where a tick is repeated in shorter steps, and
    // where velocities are synchronised. An exception ends the tick.
    std::function<void(const CallbackPoints& points, std::span<dvec3> f)> force{};
    // Writes the potential energy of every point into e (points) [J]. Without it the force has none.
    std::function<void(const CallbackPoints& points, std::span<double> e)> energy{};

    // What the steps are to allow for, on every point: how steeply the force rises with distance, and how fast it
    // damps.
    double stiffness = 0.0;    // [N/m]
    double dampingRate = 0.0;  // [1/s]
};

// A force or an energy that is not finite throws core::Error(badContent) with the body, the point and the moment.
std::shared_ptr<const Force> callbackForce(CallbackSpec spec);

}  // namespace taut::world
