// Functions of Python as forces and systems of a world. Each takes the interpreter's lock when it is called.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "taut/forces/callback.h"

namespace taut::python {

// An object of Python that threads without the interpreter's lock may hold.
using Held = std::shared_ptr<pybind11::object>;
Held held(pybind11::object object);

// The current task of a world, for its functions and for queries. Changes with the interpreter's lock held.
struct Activity {
    enum class Phase { still, inSystem, inTick };
    Phase phase = Phase::still;
    int asking = 0;  // forces and energies that have not answered yet
};

struct ForceWishes {
    std::string name;  // "force.pull"
    std::vector<std::string> targets;
    double stiffness = 0;    // [N/m]
    double dampingRate = 0;  // [1/s]
};

// force(t, x, v, mass) -> (n, 3), energy(t, x, v, mass) -> (n,) or null. Their exceptions pass through the engine, with
// a note of the place.
world::CallbackSpec pythonForce(const ForceWishes& wishes, const Held& force, const Held& energy,
                                const std::shared_ptr<Activity>& activity);

// Adds a line to the text of an exception of Python.
void addNote(pybind11::error_already_set& error, const std::string& text);

}  // namespace taut::python
