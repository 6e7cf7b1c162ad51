#include "game/python/arrays.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "game/python/errors.h"

namespace py = pybind11;

namespace taut::python {
namespace {

static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::string shapeOf(const py::array& array) {
    return py::repr(array.attr("shape")).cast<std::string>();
}

// The numbers, of that shape; `want` tells of it.
Doubles numbersOf(const py::handle& value, const std::string& what, const std::vector<py::ssize_t>& shape,
                  const std::string& want) {
    if (value.is_none()) refuse(fmt::format("{} is None; it must be an array of shape {}", what, want));
    const py::array array = py::array::ensure(value);
    if (!array) {
        PyErr_Clear();
        refuse(fmt::format("{} is {}, no array of numbers; it must be an array of shape {}", what,
                           py::str(py::type::of(value).attr("__name__")).cast<std::string>(), want));
    }
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u')
        refuse(fmt::format("{} is an array of {}; it must be one of real numbers, such as float64", what,
                           py::str(array.dtype()).cast<std::string>()));
    const std::vector<py::ssize_t> has(array.shape(), array.shape() + array.ndim());
    if (has != shape) refuse(fmt::format("{} has the shape {}; it must have {}", what, shapeOf(array), want));
    return Doubles::ensure(array);
}

}  // namespace

py::array arrayOf(std::span<const glm::dvec3> list) {
    Doubles array({static_cast<py::ssize_t>(list.size()), py::ssize_t{3}});
    if (!list.empty()) std::memcpy(array.mutable_data(), list.data(), list.size_bytes());
    return array;
}

py::array arrayOf(std::span<const double> list) {
    return Doubles(static_cast<py::ssize_t>(list.size()), list.data());
}

void take(const py::handle& value, const std::string& what, std::span<glm::dvec3> into) {
    const auto n = static_cast<py::ssize_t>(into.size());
    const Doubles numbers = numbersOf(value, what, {n, 3}, fmt::format("({}, 3)", n));
    if (!into.empty()) std::memcpy(into.data(), numbers.data(), into.size_bytes());
}

void take(const py::handle& value, const std::string& what, std::span<double> into) {
    const auto n = static_cast<py::ssize_t>(into.size());
    const Doubles numbers = numbersOf(value, what, {n}, fmt::format("({},)", n));
    if (!into.empty()) std::memcpy(into.data(), numbers.data(), into.size_bytes());
}

glm::dvec3 vectorOf(const py::handle& value, const std::string& what) {
    const Doubles numbers = numbersOf(value, what, {3}, "(3,)");
    const glm::dvec3 vector(numbers.at(0), numbers.at(1), numbers.at(2));
    if (!std::isfinite(vector.x) || !std::isfinite(vector.y) || !std::isfinite(vector.z))
        refuse(what + " is not finite");
    return vector;
}

}  // namespace taut::python
