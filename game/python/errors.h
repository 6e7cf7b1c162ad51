// Errors of the engine as exceptions: taut.Error, and taut.Diverged with its details.
#pragma once

#include <pybind11/pybind11.h>

#include "taut/core/error.h"
#include "taut/island/report.h"

namespace taut::python {

// A run that has diverged.
struct DivergedError : core::Error {
    explicit DivergedError(const world::Divergence& what)
        : Error(core::ErrorKind::diverged, what.message), divergence(what) {}
    world::Divergence divergence;
};

[[noreturn]] inline void refuse(const std::string& message) {
    throw core::Error(core::ErrorKind::usage, message);
}

void addErrors(pybind11::module_& module);

}  // namespace taut::python
