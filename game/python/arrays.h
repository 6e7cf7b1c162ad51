// Lists of the engine as NumPy arrays and back. Arrays from Python are checked before use.
#pragma once

#include <pybind11/numpy.h>

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace taut::python {

// Copies: (n, 3) and (n,) of float64.
pybind11::array arrayOf(std::span<const glm::dvec3> list);
pybind11::array arrayOf(std::span<const double> list);

// Copies an array of real numbers of just this shape, (n, 3) or (n,). Throws core::Error(usage), which begins with the
// given name, for anything else.
void take(const pybind11::handle& value, const std::string& what, std::span<glm::dvec3> into);
void take(const pybind11::handle& value, const std::string& what, std::span<double> into);

// Three numbers, of any sequence of them; throws the same.
glm::dvec3 vectorOf(const pybind11::handle& value, const std::string& what);

}  // namespace taut::python
