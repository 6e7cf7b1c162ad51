// taut._taut: the module behind `import taut`.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "game/python/errors.h"
#include "game/python/live_world.h"
#include "game/python/toml_text.h"
#include "game/python/world_class.h"
#include "taut/ode/method_table.h"

namespace py = pybind11;
using namespace py::literals;

namespace taut::python {
namespace {

std::shared_ptr<LiveWorld> made(SceneSource source, const py::object& set, int threads) {
    constexpr int most = 1024;
    if (threads < 0 || threads > most)
        refuse(fmt::format("threads = {}; it must be 1 to {}, or 0 for as many as the machine has", threads, most));
    source.overrides = overridesOf(set);
    return std::make_shared<LiveWorld>(std::move(source), threads);
}

std::shared_ptr<LiveWorld> load(const py::object& path, const py::object& set, int threads, bool isConfined) {
    SceneSource source;
    source.file = py::module_::import("os").attr("fsencode")(path).cast<std::string>();
    source.isConfined = isConfined;
    return made(std::move(source), set, threads);
}

std::shared_ptr<LiveWorld> loads(const std::string& text, const py::object& set, int threads, const std::string& name) {
    SceneSource source;
    source.isText = true;
    source.text = text;
    source.file = name;
    return made(std::move(source), set, threads);
}

std::vector<std::string> methods() {
    std::vector<std::string> names;
    for (const ode::MethodInfo& method : ode::methods()) names.emplace_back(method.name);
    return names;
}

}  // namespace
}  // namespace taut::python

PYBIND11_MODULE(_taut, module) {
    using namespace taut::python;
    module.attr("__version__") = TAUT_VERSION;
    addErrors(module);
    addWorld(module);
    module.def("load", &load, "path"_a, "set"_a = py::none(), py::kw_only(), "threads"_a = 0, "confined"_a = false,
               "A world of a scene file, or of a shipped scene by its name, such as \"flag\".\n\n"
               "set: values in the place of the file's, {\"cloth.flag.cells\": [72, 48]} or "
               "[\"cloth.flag.cells=[72,48]\"], checked like the file.\n"
               "threads: how many may work at it, at most 1024; 0: as many as the machine has.\n"
               "confined: the scene reads files below its own folder and the shipped assets only.\n"
               "Raises taut.Error with file, line, column and remedy.");
    module.def("loads", &loads, "text"_a, "set"_a = py::none(), py::kw_only(), "threads"_a = 0, "name"_a = "scene.toml",
               "The same of a text; `name` is used in messages, and its folder to find models and textures.");
    module.def("methods", &methods, "The names of the methods that a scene's integrator may be.");
}
