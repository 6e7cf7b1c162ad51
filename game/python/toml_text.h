// Values of Python as TOML, for overrides and actions.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace taut::python {

// Of a bool, a number, a text, a sequence or an array of these, a dict of these. Throws core::Error(usage), which names
// the subject, for anything else and for too deep nesting.
std::string tomlOf(const pybind11::handle& value, const std::string& what);

// The argument `set=`: a text "cloth.flag.cells=[72,48]", a sequence of these, or a dict {"cloth.flag.cells": [72,
// 48]}.
std::vector<std::string> overridesOf(const pybind11::handle& set);

}  // namespace taut::python
