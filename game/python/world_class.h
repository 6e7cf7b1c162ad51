// The class taut.World, and what it gives.
#pragma once

#include <pybind11/pybind11.h>

namespace taut::python {

void addWorld(pybind11::module_& module);

}  // namespace taut::python
