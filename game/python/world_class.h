// The class taut.World, and the classes of its results.
#pragma once

#include <pybind11/pybind11.h>

namespace taut::python {

void addWorld(pybind11::module_& module);

}  // namespace taut::python
