#include "game/python/toml_text.h"

#include <fmt/format.h>

#include "game/python/errors.h"

namespace py = pybind11;

namespace taut::python {
namespace {

std::string quoted(const std::string& text) {
    std::string all = "\"";
    for (const char c : text)
        if (c == '"' || c == '\\')
            all += '\\', all += c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            all += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
        else
            all += c;
    return all + '"';
}

std::string nested(const py::handle& value, const std::string& what, int depth) {
    constexpr int most = 32;
    if (depth > most)
        refuse(fmt::format("{}: lists and dicts stand in each other more than {} deep, or one in itself", what, most));
    const auto inner = [&](const py::handle& item) { return nested(item, what, depth + 1); };
    if (py::hasattr(value, "tolist")) return inner(value.attr("tolist")());  // of numpy
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
    if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value))
        return py::repr(value).cast<std::string>();
    if (py::isinstance<py::str>(value)) return quoted(value.cast<std::string>());
    std::string all;
    if (py::isinstance<py::dict>(value)) {
        for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value))
            all += fmt::format("{}{} = {}", all.empty() ? "" : ", ", quoted(py::str(key)), inner(item));
        return "{ " + all + " }";
    }
    if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
        for (const py::handle item : value) all += (all.empty() ? "" : ", ") + inner(item);
        return "[" + all + "]";
    }
    refuse(fmt::format("{}: {} is no value of a scene; take a number, a text, a bool, or lists and dicts of such", what,
                       py::repr(value).cast<std::string>()));
}

}  // namespace

std::string tomlOf(const py::handle& value, const std::string& what) {
    return nested(value, what, 0);
}

std::vector<std::string> overridesOf(const py::handle& set) {
    if (set.is_none()) return {};
    if (py::isinstance<py::str>(set)) return {set.cast<std::string>()};
    std::vector<std::string> overrides;
    if (py::isinstance<py::dict>(set)) {
        for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(set)) {
            const std::string name = py::str(key);
            overrides.push_back(name + "=" + tomlOf(value, "set " + name));
        }
        return overrides;
    }
    if (!py::isinstance<py::iterable>(set)) refuse("set must be a dict, or a list of texts such as \"run.fps=30\"");
    for (const py::handle item : set) {
        if (!py::isinstance<py::str>(item))
            refuse("set: " + py::repr(item).cast<std::string>() + " is no text such as \"run.fps=30\"");
        overrides.push_back(item.cast<std::string>());
    }
    return overrides;
}

}  // namespace taut::python
