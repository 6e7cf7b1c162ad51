#include "game/python/callbacks.h"

#include <fmt/format.h>

#include "game/python/arrays.h"
#include "game/python/errors.h"

namespace py = pybind11;

namespace taut::python {
namespace {

// Calls function(t, x, v, mass) and takes its result.
template <class Item>
void ask(const Held& function, const std::string& what, Activity& activity, const world::CallbackPoints& points,
         std::span<Item> into) {
    const py::gil_scoped_acquire lock;
    struct Asking {
        int& count;
        explicit Asking(int& of) : count(of) { ++count; }
        ~Asking() { --count; }
    } asking(activity.asking);
    try {
        const py::object answer = (*function)(points.t, arrayOf(points.x), arrayOf(points.v), arrayOf(points.mass));
        take(answer, fmt::format("{}: its return value", what), into);
    } catch (py::error_already_set& error) {
        addNote(error, fmt::format("in {} at {:.6g} s, asked for {} points{}", what, points.t, points.x.size(),
                                   activity.phase == Activity::Phase::inTick ? "; the tick is undone" : ""));
        throw;
    }
}

}  // namespace

Held held(py::object object) {
    return {new py::object(std::move(object)),
            [](py::object* own) {
                const py::gil_scoped_acquire lock;
                delete own;
            }};
}

world::CallbackSpec pythonForce(const ForceWishes& wishes, const Held& force, const Held& energy,
                                const std::shared_ptr<Activity>& activity) {
    world::CallbackSpec spec;
    spec.name = wishes.name;
    spec.targets = wishes.targets;
    spec.stiffness = wishes.stiffness;
    spec.dampingRate = wishes.dampingRate;
    spec.force = [force, activity, name = wishes.name](const world::CallbackPoints& points, std::span<glm::dvec3> f) {
        ask(force, name, *activity, points, f);
    };
    if (energy)
        spec.energy = [energy, activity, name = wishes.name](const world::CallbackPoints& points, std::span<double> e) {
            ask(energy, "the energy of " + name, *activity, points, e);
        };
    return spec;
}

void addNote(py::error_already_set& error, const std::string& text) {
    if (!py::hasattr(error.value(), "add_note")) return;  // before Python 3.11
    error.value().attr("add_note")("taut: " + text);
}

}  // namespace taut::python
