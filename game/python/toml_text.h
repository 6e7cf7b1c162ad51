// Values of Python as TOML, for what scenes are set to and what is applied to them.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace taut::python {

// Of a bool, a number, a text, a sequence or an array of such, a dict of such. Throws core::Error(usage), which names
// `what`, for anything else and for what is nested too deeply.
std::string tomlOf(const pybind11::handle& value, const std::string& what);

// What `set=` may be: a text "cloth.flag.cells=[72,48]", a sequence of such, or a dict {"cloth.flag.cells": [72, 48]}.
std::vector<std::string> overridesOf(const pybind11::handle& set);

}  // namespace taut::python
