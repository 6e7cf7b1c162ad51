#include "game/python/world_class.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>

#include "game/python/arrays.h"
#include "game/python/errors.h"
#include "game/python/live_world.h"
#include "game/python/toml_text.h"
#include "taut/core/trig.h"
#include "taut/island/metric_table.h"

namespace py = pybind11;
using namespace py::literals;

namespace taut::python {
namespace {

using Class = py::class_<LiveWorld, std::shared_ptr<LiveWorld>>;

// Functions of Python that a world calls may refer to the world: Python's collector has to see them.
void collectCycles(PyHeapTypeObject* heap) {
    PyTypeObject& type = heap->ht_type;
    const auto worldOf = [](PyObject* self) -> LiveWorld* {
        const auto* instance = reinterpret_cast<py::detail::instance*>(self);
        if (!instance->simple_layout || !instance->simple_holder_constructed) return nullptr;
        return static_cast<LiveWorld*>(instance->simple_value_holder[0]);
    };
    static const auto find = worldOf;
    type.tp_flags |= Py_TPFLAGS_HAVE_GC;
    type.tp_traverse = [](PyObject* self, visitproc visit, void* arg) -> int {
        Py_VISIT(Py_TYPE(self));
        if (const LiveWorld* world = find(self))
            for (const Held& function : world->functions()) Py_VISIT(function->ptr());
        return 0;
    };
    type.tp_clear = [](PyObject* self) -> int {
        if (const LiveWorld* world = find(self))
            for (const Held& function : world->functions()) *function = py::none();
        return 0;
    };
}

py::dict energiesOf(const world::Metrics& m) {
    return py::dict("kinetic"_a = m.kinetic, "elastic"_a = m.elastic, "gravitational"_a = m.gravitational,
                    "total"_a = m.energy());
}

world::Metrics metricsOf(const LiveWorld& world, const std::string& bodies) {
    if (bodies.empty()) return world.asked().metrics();
    world.requireBodies(bodies);
    return world.asked().metrics(bodies);
}

py::dict measuresOf(const world::Metrics& m) {
    const auto list = [](const glm::dvec3& v) { return arrayOf(std::span(&v.x, 3)); };
    py::dict all("broken_springs"_a = m.brokenSprings, "volume"_a = m.volume, "rest_volume"_a = m.restVolume);
    for (const world::Metric& metric : world::metricTable()) {
        const py::str name(std::string(metric.function.empty() ? metric.columns : metric.function));
        if (all.contains(name)) continue;
        const world::MetricValue value = metric.value(m);
        if (const auto* v = std::get_if<glm::dvec3>(&value)) all[name] = list(*v);
        if (const auto* number = std::get_if<double>(&value)) all[name] = *number;
        if (const auto* count = std::get_if<std::int64_t>(&value)) all[name] = *count;
    }
    return all;
}

py::list islandsOf(const LiveWorld& world) {
    py::list all;
    for (const world::IslandInfo& island : world.asked().islands())
        all.append(py::dict("name"_a = island.name, "bodies"_a = island.bodies, "points"_a = island.points,
                            "springs"_a = island.springs, "mass"_a = island.mass, "method"_a = island.method,
                            "step"_a = island.step, "step_limit"_a = island.stepLimit, "substeps"_a = island.substeps));
    return all;
}

py::list jointsOf(const LiveWorld& world) {
    py::list all;
    for (const world::JointInfo& joint : world.asked().joints()) {
        int points = 0;
        for (const auto& pair : joint.pairs) points += pair.points;
        all.append(py::dict("name"_a = joint.name, "kind"_a = joint.kind, "a"_a = joint.a, "b"_a = joint.b,
                            "points"_a = points, "left"_a = joint.left));
    }
    return all;
}

// A surface as it is drawn.
struct Surface {
    // As a world's: of an object that holds none.
    static void* operator new(std::size_t) { refuse("this Surface is empty; World.surfaces() returns surfaces"); }
    std::string name;
    py::array positions, normals, triangles;
};

std::shared_ptr<Surface> surfaceOf(const view::Surface& surface) {
    const auto n = static_cast<py::ssize_t>(surface.geometry->positions.size());
    py::array_t<float> positions({n, py::ssize_t{3}}), normals({n, py::ssize_t{3}});
    for (py::ssize_t i = 0; i < n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const glm::vec4 x = surface.transform * glm::vec4(surface.geometry->positions[at], 1.0F);
        const glm::vec4 normal = surface.transform * glm::vec4(surface.geometry->normals[at], 0.0F);
        for (int p = 0; p < 3; ++p) positions.mutable_at(i, p) = x[p], normals.mutable_at(i, p) = normal[p];
    }
    const std::vector<std::uint32_t>& corners = surface.topology->triangles;
    py::array_t<std::uint32_t> triangles({static_cast<py::ssize_t>(corners.size() / 3), py::ssize_t{3}});
    std::copy(corners.begin(), corners.end(), triangles.mutable_data());
    return std::make_shared<Surface>(
        Surface{surface.name, std::move(positions), std::move(normals), std::move(triangles)});
}

std::vector<std::shared_ptr<Surface>> surfacesOf(const LiveWorld& world) {
    std::vector<std::shared_ptr<Surface>> all;
    for (const view::Surface& surface : world.asked().view(false).surfaces) all.push_back(surfaceOf(surface));
    return all;
}

py::array pictureOf(LiveWorld& world, const std::optional<std::pair<int, int>>& size, const std::string& camera,
                    std::optional<int> samples, bool debug) {
    world::PictureSpec picture = world.spec().picture;
    if (size) picture.size = {size->first, size->second};
    if (samples) picture.samples = *samples;
    if (!camera.empty()) picture.camera = camera;
    constexpr int least = 16, most = 8192;
    if (picture.size.x < least || picture.size.y < least || picture.size.x > most || picture.size.y > most)
        refuse(fmt::format("a picture of {} x {} pixels; it must have {} to {} each way", picture.size.x,
                           picture.size.y, least, most));
    if (picture.samples != 1 && picture.samples != 4 && picture.samples != 8 && picture.samples != 16)
        refuse(fmt::format("{} samples a pixel; there are 1, 4, 8 or 16", picture.samples));
    const image::Image image = world.draw(picture, debug);
    py::array_t<std::uint8_t> array(
        {static_cast<py::ssize_t>(image.height), static_cast<py::ssize_t>(image.width), py::ssize_t{3}});
    std::copy(image.rgb.begin(), image.rgb.end(), array.mutable_data());
    return array;
}

void runUntil(LiveWorld& world, double until) {
    const double tick = world.asked().tickSeconds();
    const double ticks = std::ceil(until / tick - 1e-6) - static_cast<double>(world.asked().tick());
    if (!std::isfinite(ticks) || ticks > 1e15) refuse("until must be a moment [s]");
    if (ticks < 0)
        refuse(fmt::format("until = {:.6g} s is over: the world is at {:.6g} s", until, world.asked().time()));
    world.step(static_cast<std::int64_t>(ticks));
}

std::vector<std::string> targetsOf(const py::object& on) {
    if (on.is_none()) return {};
    if (py::isinstance<py::str>(on)) return {on.cast<std::string>()};
    return on.cast<std::vector<std::string>>();
}

std::string addForce(LiveWorld& world, const py::function& force, const py::object& on, const py::object& energy,
                     std::string name, double stiffness, double damping) {
    if (name.empty() && py::hasattr(force, "__name__")) name = py::str(force.attr("__name__"));
    if (name.empty() || name == "<lambda>") name = "function";
    ForceWishes wishes;
    wishes.name = "force." + name;
    wishes.stiffness = stiffness;
    wishes.dampingRate = damping;
    return world.addForce(force, targetsOf(on), energy, wishes);
}

std::optional<glm::dvec3> anglesOf(const py::object& degrees) {
    if (degrees.is_none()) return std::nullopt;
    return vectorOf(degrees, "rotation_deg") * core::radians(1.0);
}

void addAsking(Class& type) {
    type.def_property_readonly(
        "tick", [](const LiveWorld& w) { return w.asked().tick(); }, "How many ticks there have been.");
    type.def_property_readonly(
        "time", [](const LiveWorld& w) { return w.asked().time(); }, "The time of the world [s].");
    type.def_property_readonly(
        "tick_seconds", [](const LiveWorld& w) { return w.asked().tickSeconds(); }, "The length of a tick [s].");
    type.def_property_readonly(
        "ticks_per_frame", [](const LiveWorld& w) { return w.asked().ticksPerFrame(); },
        "Ticks from one picture of the scene's frame rate to the next.");
    type.def_property_readonly(
        "hash", [](const LiveWorld& w) { return fmt::format("{:016x}", w.asked().stateHash()); },
        "The state hash, chained over the ticks, as 16 hexadecimal digits; the program's at the same tick.");
    type.def_property_readonly(
        "bodies",
        [](const LiveWorld& w) {
            std::vector<std::string> names;
            for (const world::BodyHash& body : w.asked().bodyHashes()) names.push_back(body.name);
            return names;
        },
        "The names of the bodies that are there, such as \"cloth.flag\".");
    type.def_property_readonly(
        "warnings",
        [](const LiveWorld& w) {
            std::vector<std::string> all = w.warnings();
            for (std::string& warning : printed(w.asked().warnings())) all.push_back(std::move(warning));
            return all;
        },
        "Warnings of the scene, its steps and its callbacks.");
    type.def_property_readonly(
        "equal_bits", [](const LiveWorld& w) { return w.asked().callbacks().empty(); },
        "Whether the bits are promised to be the same on every machine: not with forces or systems of Python.");
    type.def_property_readonly("islands", &islandsOf,
                               "Of each island a dict: name, bodies, points, springs, mass [kg], method, step [s], "
                               "step_limit [s], substeps.");
    type.def_property_readonly("joints", &jointsOf,
                               "A dict per joint: name, kind, a, b, points (tied at the start), and left (still tied). "
                               "apply({\"do\": \"release\", \"id\": name}) releases a joint.");
    type.def_property_readonly(
        "methods",
        [](const LiveWorld& w) {
            py::dict all;
            for (const world::IslandInfo& island : w.asked().islands())
                for (const std::string& body : island.bodies) all[py::str(body)] = island.method;
            return all;
        },
        "The method that integrates each body, by its name.");
}

void addArrays(Class& type) {
    type.def(
        "positions", [](const LiveWorld& w, const std::string& t) { return arrayOf(w.asked().positions(w.select(t))); },
        "target"_a,
        "Where points are [m]: a copy, (n, 3) of float64, in the order of authoring, body by body.\n\n"
        "target: \"cloth.flag\", \"cloth.*\", or with a selector \"cloth.flag@left\".");
    type.def(
        "velocities", [](const LiveWorld& w, const std::string& t) { return arrayOf(w.asked().points(w.select(t)).v); },
        "target"_a,
        "Velocities [m/s] at the time of the positions: a copy, (n, 3) of float64. May cost an evaluation of the "
        "forces.");
    type.def(
        "masses", [](const LiveWorld& w, const std::string& t) { return arrayOf(w.asked().points(w.select(t)).mass); },
        "target"_a, "Masses [kg], also of held points: a copy, (n,) of float64.");
    type.def(
        "energies", [](const LiveWorld& w, const std::string& b) { return energiesOf(metricsOf(w, b)); },
        "bodies"_a = "",
        "A dict of the energies [J] of the bodies, of all if none are named: kinetic, elastic, gravitational, total.");
    type.def(
        "measures", [](const LiveWorld& w, const std::string& b) { return measuresOf(metricsOf(w, b)); },
        "bodies"_a = "",
        "A dict of all that is measured, by the names of claims, else by those of metrics.csv: momentum [kg m/s] and\n"
        "angular_momentum [kg m²/s] as (3,), max_strain, contacts, penetration [m], body_contacts, crossings, …;\n"
        "besides broken_springs, volume and rest_volume [m³].");
    type.def("surfaces", &surfacesOf, "Drawn surfaces, a list of Surface: bodies and colliders.");
    type.def("render", &pictureOf, "size"_a = py::none(), py::kw_only(), "camera"_a = "", "samples"_a = py::none(),
             "debug"_a = false,
             "A picture, (height, width, 3) of uint8, sRGB, rows from top to bottom.\n\n"
             "size: (width, height) [px], samples: 1, 4, 8 or 16 a pixel, camera: its name; the scene's if not given.\n"
             "debug: with springs, points and contacts.\n"
             "A process that was forked from one that had drawn cannot: let multiprocessing \"spawn\" it.");
}

void addDoing(Class& type) {
    type.def("step", &LiveWorld::step, "ticks"_a = 1,
             "Advances by so many ticks; other threads of Python run meanwhile. Raises taut.Diverged, and the "
             "exceptions of forces and systems, which undo the tick.");
    type.def("run", &runUntil, py::kw_only(), "until"_a, "Goes on to the first tick at or after a moment [s].");
    type.def(
        "apply", [](LiveWorld& w, const py::dict& action) { w.apply(tomlOf(action, "apply()")); }, "action"_a,
        "Performs an action of the timeline now: {\"do\": \"push\", \"target\": \"cloth.flag\", \"impulse_Ns\": [0, 0, "
        "1]}.\n\n"
        "Keys and units are those of the scene format, without t; `taut schema` has them all. Raises taut.Error for an "
        "impossible action, and changes nothing then.");
    type.def(
        "place",
        [](LiveWorld& w, const std::string& collider, const py::object& position, const py::object& rotation) {
            std::optional<glm::dvec3> to;
            if (!position.is_none()) to = vectorOf(position, "position");
            w.place(collider, to, anglesOf(rotation));
        },
        "collider"_a, "position"_a = py::none(), "rotation_deg"_a = py::none(),
        "Moves a collider, \"collider.ball\", to a position [m] and angles [degrees] about x, then y, then z, at the "
        "end of the next tick, or in a system of this one. It sweeps points in its path along.");
    type.def(
        "place_of",
        [](const LiveWorld& w, const std::string& collider) {
            const collision::Pose pose = w.poseOf(collider);
            const std::array<double, 4> q{pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z};
            return std::pair(arrayOf(std::span(&pose.position.x, 3)), arrayOf(std::span(q)));
        },
        "collider"_a,
        "Where a collider is: its position (3,) [m] and its rotation (4,), a unit quaternion w, x, y, z.");
    type.def("add_force", &addForce, "force"_a, "on"_a = py::none(), py::kw_only(), "energy"_a = py::none(),
             "name"_a = "", "stiffness"_a = 0.0, "damping_per_s"_a = 0.0,
             "Adds force(t, x, v, mass) -> (n, 3) [N] to the points of targets, by default of all bodies.\n\n"
             "Its arguments are the time [s], positions (n, 3) [m], velocities (n, 3) [m/s] and masses (n,) [kg] of "
             "the points of one island, body by body in the order of the scene. It is called at every evaluation, one "
             "island after the other in their order, and again if a tick is repeated in shorter steps.\n"
             "energy(t, x, v, mass) -> (n,) [J] counts as elastic energy. stiffness [N/m] and damping_per_s [1/s] are "
             "upper bounds of its effect on a point, for \"auto\" steps.\n"
             "During a call the world cannot be used, by this or other threads.\n"
             "An exception undoes the tick. With such a force equal bits are not promised: see equal_bits. Returns its "
             "name, \"force.NAME\".");
    type.def("add_system", &LiveWorld::addSystem, "system"_a,
             "Calls system(world, t, dt) at the start of every tick, with the time at its end and its length [s]. It "
             "may query the world, place() colliders and apply() actions. An exception undoes the tick.");
}

void addSaving(Class& type) {
    type.def(
        "save", [](const LiveWorld& w) { return py::bytes(w.save()); },
        "The state as bytes, which restore() takes and no other version of taut may.");
    type.def(
        "restore", [](LiveWorld& w, const py::bytes& bytes) { w.restore(bytes); }, "state"_a,
        "Goes to a state that save() gave, of a world of the same scene and with the same forces and systems; it goes "
        "on bit for bit. Raises taut.Error for bytes that do not fit, and then nothing has changed.");
    type.def(py::pickle([](const LiveWorld& w) { return py::bytes(w.pickled()); },
                        [](const py::bytes& bytes) { return LiveWorld::from(bytes); }));
    type.def("__repr__", [](const LiveWorld& w) {
        int points = 0;
        for (const world::IslandInfo& island : w.asked().islands()) points += island.points;
        return fmt::format("<taut.World at {:.6g} s, {} bodies, {} points>", w.asked().time(),
                           w.asked().bodyHashes().size(), points);
    });
}

}  // namespace

void addWorld(py::module_& module) {
    auto surface = py::class_<Surface, std::shared_ptr<Surface>>(module, "Surface", "A surface as it is drawn.");
    surface.attr("__module__") = "taut";
    surface.def_readonly("name", &Surface::name, "\"cloth.flag\", of a collider \"ball\"");
    surface.def_readonly("positions", &Surface::positions, "(n, 3) of float32 [m]");
    surface.def_readonly("normals", &Surface::normals, "(n, 3) of float32, unit");
    surface.def_readonly("triangles", &Surface::triangles, "(m, 3) of uint32, counter-clockwise seen from the front");
    Class world(module, "World", py::custom_type_setup(collectCycles),
                "A scene in motion, made by load() or loads(). It may be pickled: the pickle holds its state and where "
                "the scene is read from.");
    world.attr("__module__") = "taut";
    addAsking(world);
    addArrays(world);
    addDoing(world);
    addSaving(world);
}

}  // namespace taut::python
