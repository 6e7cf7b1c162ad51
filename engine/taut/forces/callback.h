// A force that is a function of the program that uses the engine, in any language. The function gets the points on
// which it acts as plain lists, in the order of authoring.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "taut/forces/force.h"

namespace taut::world {

// The points of the targets in one island, at a moment of a step. Bodies come in the order of the state hash, and the
// points of each in the order of authoring. A point that two bodies share appears twice.
struct CallbackPoints {
    double t = 0;                  // [s]
    std::span<const dvec3> x, v;   // (points) [m], [m/s]
    std::span<const double> mass;  // (points) [kg], of held points too
};

struct CallbackSpec {
    std::string name{};                  // "force.pull", of a kind that scenes do not have
    std::vector<std::string> targets{};  // KIND.NAME@SELECTOR; empty: all points of all bodies

    // Writes the force on every point into f (points) [N]. Forces on held points do not count. Of a shared point the
    // first entry counts. Called once in an evaluation for each island with such points, in the order of the islands,
    // never for two at a time. Called again for the same moment if a tick is repeated in shorter steps or velocities
    // are synchronised. An exception ends the tick.
    std::function<void(const CallbackPoints& points, std::span<dvec3> f)> force{};
    // Writes the potential energy of every point into e (points) [J]. Without it the force has none.
    std::function<void(const CallbackPoints& points, std::span<double> e)> energy{};

    // Upper bounds for the step at every point: how steeply the force rises with distance, and how fast it damps.
    double stiffness = 0.0;    // [N/m]
    double dampingRate = 0.0;  // [1/s]
};

// Such a force throws core::Error(badContent), with body, point and moment, if a force or an energy is not finite.
std::shared_ptr<const Force> callbackForce(CallbackSpec spec);

}  // namespace taut::world
