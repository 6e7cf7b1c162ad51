#include "game/python/errors.h"

namespace py = pybind11;

namespace taut::python {
namespace {

constexpr const char* errorHelp =
    "An error of taut with its remedy.\n\n"
    "kind: \"usage\", \"content\" (of a scene or of bytes), \"diverged\", \"file\", \"renderer\" or \"interrupted\".";
constexpr const char* divergedHelp =
    "The motion has left all bounds; the world keeps the last good state, to be looked at.\n\n"
    "tick: that failed; time: [s]; body: \"cloth.flag\"; point: its number in the order of authoring;\n"
    "spring: the stiffest there; safe_step: largest step that would hold [s].";

const char* nameOf(core::ErrorKind kind) {
    switch (kind) {
        case core::ErrorKind::usage: return "usage";
        case core::ErrorKind::badContent: return "content";
        case core::ErrorKind::diverged: return "diverged";
        case core::ErrorKind::inputOutput: return "file";
        case core::ErrorKind::noRenderer: return "renderer";
        case core::ErrorKind::interrupted: return "interrupted";
    }
    return "";
}

// Exceptions live as long as the process.
struct Types {
    py::object error, diverged;
};
const Types& types() {
    static const Types* const all = [] {
        auto* made = new Types;
        made->error = py::reinterpret_steal<py::object>(
            PyErr_NewExceptionWithDoc("taut.Error", errorHelp, PyExc_Exception, nullptr));
        made->diverged = py::reinterpret_steal<py::object>(
            PyErr_NewExceptionWithDoc("taut.Diverged", divergedHelp, made->error.ptr(), nullptr));
        return made;
    }();
    return *all;
}

// Paths in it may be no UTF-8.
py::object textOf(const std::string& message) {
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(message.data(), static_cast<Py_ssize_t>(message.size()), "surrogateescape"));
}

void raise(const py::object& type, const core::Error& error, const world::Divergence* divergence) {
    const py::object value = type(textOf(error.what()));
    value.attr("kind") = nameOf(error.kind());
    if (divergence != nullptr) {
        value.attr("tick") = divergence->tick;
        value.attr("time") = divergence->time;
        value.attr("body") = divergence->body;
        value.attr("point") = divergence->point;
        value.attr("spring") = divergence->spring;
        value.attr("safe_step") = divergence->safeStep;
    }
    PyErr_SetObject(type.ptr(), value.ptr());
}

}  // namespace

void addErrors(py::module_& module) {
    module.attr("Error") = types().error;
    module.attr("Diverged") = types().diverged;
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const DivergedError& error) {
            raise(types().diverged, error, &error.divergence);
        } catch (const core::Error& error) {
            raise(types().error, error, nullptr);
        }
    });
}

}  // namespace taut::python
