// The field table, part two: materials, cloths, ropes, blocks and nets.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "taut/fields/field_list.h"
#include "taut/scene/sections.h"
#include "taut/scene/method_names.h"
#include "taut/fields/problems.h"

namespace taut::scene {

using namespace world;

namespace {

constexpr Range count{1.0, 1e9};        // of cells; what is too much is said with figures once all is read
constexpr Range dampingTime{0.0, 1e3};  // [s]
constexpr Range dragRate{0.0, 1e6};     // [1/s]
constexpr Range strain{1e-6, 1e3};      // |l - L|/L
constexpr Range copies{1.0, 100000.0};
constexpr double maxCopies = 100000;
constexpr auto springs = Affects::springs;

Section arraySection() {
    Section section;
    section.fields = FieldList<ArraySpec>()
                         .vector("count", &ArraySpec::count, "", copies, "Copies along the three directions.")
                         .required()
                         .vector("step_x", &ArraySpec::stepX, "m", placeRange, "From one copy to the next, first direction.")
                         .vector("step_y", &ArraySpec::stepY, "m", placeRange, "The same, second direction.")
                         .vector("step_z", &ArraySpec::stepZ, "m", placeRange, "The same, third direction.")
                         .take();
    section.check = [](const CheckInput& input, void* target) {
        auto& array = *static_cast<ArraySpec*>(target);
        const dvec3 steps[] = {array.stepX, array.stepY, array.stepZ};
        const char* names[] = {"step_x", "step_y", "step_z"};
        for (int i = 0; i < 3; ++i) {
            if (array.count[i] > 1 && steps[i] == dvec3(0.0) && input.isClean) {
                input.problems.addError(input.at("count"),
                                        fmt::format("the {} copies lie in the same place", array.count[i]),
                                        fmt::format("give {}", names[i]));
            }
        }
        const dvec3 counts(array.count);
        if (counts.x * counts.y * counts.z > maxCopies) {
            input.problems.addError(input.at("count"), fmt::format("an array has at most {} copies", maxCopies));
            array.count = ivec3(1);
        }
    };
    return section;
}

Section overrideSection() {
    Section section;
    section.fields = FieldList<SolverOverride>()
                         .choice("integrator", &SolverOverride::integrator, methodNames(), "As in [solver].")
                         .number("dt", &SolverOverride::dt, "s", Range{1e-9, 1.0}, "As in [solver].")
                         .number("safety", &SolverOverride::safety, "", Range{0.01, 1.0}, "As in [solver].")
                         .whole("newton_steps", &SolverOverride::newtonSteps, "", Range{1, 100}, "As in [solver].")
                         .number("cg_tolerance", &SolverOverride::cgTolerance, "", Range{1e-12, 0.1}, "As in [solver].")
                         .whole("cg_iterations", &SolverOverride::cgIterations, "", Range{1, 1e6}, "As in [solver].")
                         .take();
    return section;
}

// Appends what every body has.
template <class Spec>
std::vector<Field> withBodyFields(FieldList<Spec> list) {
    list.texts("hold", &Spec::hold, Role::selector, "Points that never move: a group, \"#12\", \"(u,v)\", \"50%\".")
        .vector("velocity", &Spec::velocity, "m/s", placeRange, "At the start.")
        .vector("spin_rad_per_s", &Spec::spin, "rad/s", placeRange, "At the start, about the centre of mass.")
        .number("jitter_m", &Spec::jitter, "m", Range{0.0, 1.0},
                "Random offset of the free points at the start, to break symmetry.")
        .whole("seed", &Spec::seed, "", Range{0.0, 1e12}, "Seed of the offsets.")
        .number("friction", &Spec::friction, "", Range{0.0, 100.0}, "Factor on the collider's friction.")
        .number("thickness", &Spec::thickness, "m", Range{0.0, 10.0}, "Distance kept from colliders.")
        .flag("collide", &Spec::collide, "Whether colliders stop it.")
        .table("finish", &Spec::finish, finishSection(), "How it looks.")
        .table("solver", &Spec::solver, overrideSection(), "Its own way to be computed.")
        .table("array", &Spec::array, arraySection(), "Copies, called NAME.0, NAME.1 and so on.");
    return list.take();
}

// Fields of all that stops being elastic.
template <class Spec>
FieldList<Spec> withPlasticity(FieldList<Spec> list) {
    list.number("yield_strain", &Spec::plasticity, &PlasticitySpec::yieldStrain, "", strain,
                "Strain beyond which springs keep part of it for good; never if not given.");
    list.number("break_strain", &Spec::plasticity, &PlasticitySpec::breakStrain, "", strain,
                "Strain of a stretched spring at which it tears; never if not given.");
    return list;
}

// Fields of all bodies that have a stiffness of their own.
template <class Spec>
FieldList<Spec> withLosses(FieldList<Spec> list) {
    list.number("damping_time_s", &Spec::dampingTime, "s", dampingTime,
                "Damping of a spring over its stiffness: inner friction.")
        .ramps(springs);
    list.number("drag_per_s", &Spec::drag, "1/s", dragRate, "Rate at which still air slows a point.").ramps(springs);
    return list;
}

}  // namespace

std::vector<std::string> lumpingNames() {
    return {"weighted", "uniform"};
}

Section finishSection() {
    Section section;
    section.variant = [](const Node& table) -> std::string {
        const Member* pattern = table.find("pattern");
        return pattern != nullptr && pattern->value.text == "image" ? "the pattern image" : "a painted pattern";
    };
    section.fields =
        FieldList<FinishSpec>()
            .colour("colour", &FinishSpec::colour, "Colour of the front.")
            .colour("back_colour", &FinishSpec::backColour, "Colour of the back; paler than the front if not given.")
            .colour("accent", &FinishSpec::accent, "Second colour of a pattern.")
            .choice("pattern", &FinishSpec::pattern, {"plain", "checker", "stripes", "tartan", "image"}, "Pattern.")
            .number("repeat_m", &FinishSpec::repeat, "m", lengthRange, "Length after which the pattern repeats.")
            .number("weave", &FinishSpec::weave, "", share, "Depth of the weave: 0 smooth, 1 coarse linen.")
            .number("thread_m", &FinishSpec::thread, "m", lengthRange, "Distance of two threads.")
            .number("roughness", &FinishSpec::roughness, "", share, "0 a mirror, 1 chalk.")
            .number("sheen", &FinishSpec::sheen, "", share, "Bright rim of fabric.")
            .text("texture", &FinishSpec::texture, Role::texture, "Picture file, PNG or JPEG.")
            .required()
            .only({"the pattern image"})
            .take();
    return section;
}

SceneSection materialSection() {
    SceneSection section;
    section.name = "material";
    section.layout = Layout::named;
    section.help = "What cloth is made of. Per metre of material: the number of cells does not change the stiffness.";
    section.enter = [](SceneSpec& scene, const std::string& name, const Source&) -> void* {
        return &scene.materials[name];
    };
    section.existing = [](SceneSpec& scene, const std::string& name) -> void* {
        const auto found = scene.materials.find(name);
        return found == scene.materials.end() ? nullptr : &found->second;
    };
    FieldList<MaterialSpec> list;
    list.number("density_kg_per_m2", &MaterialSpec::density, "kg/m²", positive, "Mass of a square metre.")
        .number("stretch_N_per_m", &MaterialSpec::stretch, "N/m", positive, "Spring constant along the threads.")
        .ramps(springs)
        .number("shear_N_per_m", &MaterialSpec::shear, "N/m", notNegative,
                "Spring constant along the diagonals; half of stretch_N_per_m, which is isotropic, if not given.")
        .ramps(springs)
        .number("bend_N_per_m", &MaterialSpec::bend, "N/m", notNegative, "Spring constant across two cells.")
        .ramps(springs);
    section.fields = withPlasticity(withLosses(list))
                         .choice("lumping", &MaterialSpec::lumping, lumpingNames(),
                                 "How mass is shared out: by area, or the same for every point.")
                         .take();
    return section;
}

SceneSection clothSection() {
    SceneSection section;
    section.name = "cloth";
    section.layout = Layout::named;
    section.help = "A cloth: a grid, or a mesh from an OBJ file.";
    section.enter = enterNamed(&SceneSpec::cloths);
    section.variant = [](const Node& table) -> std::string {
        return table.find("mesh") != nullptr ? "a cloth from a mesh" : "a cloth grid";
    };
    const std::vector<std::string> grid{"a cloth grid"}, mesh{"a cloth from a mesh"};
    section.fields =
        withBodyFields(FieldList<ClothSpec>()
                           .text("material", &ClothSpec::material, Role::material, "Name of its material.")
                           .required()
                           .vector("size", &ClothSpec::size, "m", lengthRange, "Across and down.")
                           .only(grid)
                           .vector("cells", &ClothSpec::cells, "", count, "Number of cells across and down.")
                           .only(grid)
                           .vector("origin", &ClothSpec::origin, "m", placeRange, "Top left corner.")
                           .only(grid)
                           .direction("across", &ClothSpec::across, "Direction from left to right; any length.")
                           .only(grid)
                           .direction("down", &ClothSpec::down, "Direction from top to bottom; any length.")
                           .only(grid)
                           .text("mesh", &ClothSpec::mesh, Role::mesh, "OBJ file.")
                           .only(mesh)
                           .vector("position", &ClothSpec::position, "m", placeRange, "Where the file's origin lies.")
                           .only(mesh)
                           .rotation("rotation_deg", &ClothSpec::rotation, "About x, then y, then z.")
                           .only(mesh)
                           .number("scale", &ClothSpec::scale, "", lengthRange, "Metres of a unit of the file.")
                           .only(mesh));
    section.check = [](const CheckInput& input, void* target) {
        auto& cloth = *static_cast<ClothSpec*>(target);
        if (input.table.find("across") == nullptr && input.table.find("down") == nullptr) return;
        cloth.across /= std::sqrt(glm::dot(cloth.across, cloth.across));
        cloth.down /= std::sqrt(glm::dot(cloth.down, cloth.down));
        const double slant = glm::dot(cloth.across, cloth.down);
        if (std::abs(slant) <= 1e-3) {
            cloth.down -= slant * cloth.across;
            cloth.down /= std::sqrt(glm::dot(cloth.down, cloth.down));
            return;
        }
        const bool namesDown = input.table.find("down") != nullptr;
        input.problems.addError(input.at(namesDown ? "down" : "across"), "across and down must be at right angles",
                                namesDown ? "" : "give down too; it is [0, -1, 0] now");
    };
    return section;
}

SceneSection ropeSection() {
    SceneSection section;
    section.name = "rope";
    section.layout = Layout::named;
    section.help = "A rope between two points.";
    section.enter = enterNamed(&SceneSpec::ropes);
    section.existing = findNamed(&SceneSpec::ropes);
    FieldList<RopeSpec> list;
    list.segment("ends", &RopeSpec::start, &RopeSpec::end, "Its two ends.")
        .required()
        .whole("segments", &RopeSpec::segments, "", count, "Number of segments.")
        .number("length_m", &RopeSpec::length, "m", Range{0.0, 1e6},
                "Natural length; 0 means the distance of the ends, more hangs slack.")
        .number("mass_kg", &RopeSpec::mass, "kg", positive, "Mass of the whole rope.")
        .number("stretch_N", &RopeSpec::stretch, "N", positive, "Stiffness EA: force that doubles its length.")
        .ramps(springs)
        .number("bend_N", &RopeSpec::bend, "N", notNegative, "The same of springs across two segments.")
        .ramps(springs);
    section.fields = withBodyFields(withPlasticity(withLosses(list))
                                        .number("radius", &RopeSpec::radius, "m", lengthRange, "As it is drawn.")
                                        .choice("lumping", &RopeSpec::lumping, lumpingNames(),
                                                "How mass is shared out: by length, or the same for every point."));
    section.check = [](const CheckInput& input, void* target) {
        const auto& rope = *static_cast<const RopeSpec*>(target);
        if (input.isClean && rope.start == rope.end) {
            input.problems.addError(input.at("ends"), "the two ends are the same point");
        }
    };
    return section;
}

SceneSection blockSection() {
    SceneSection section;
    section.name = "block";
    section.layout = Layout::named;
    section.help = "A deformable block.";
    section.enter = enterNamed(&SceneSpec::blocks);
    section.existing = findNamed(&SceneSpec::blocks);
    FieldList<BlockSpec> list;
    list.vector("size", &BlockSpec::size, "m", lengthRange, "Its three edges.")
        .vector("cells", &BlockSpec::cells, "", count, "Number of cells along each.")
        .vector("position", &BlockSpec::position, "m", placeRange, "Its centre.")
        .rotation("rotation_deg", &BlockSpec::rotation, "About x, then y, then z.")
        .number("density_kg_per_m3", &BlockSpec::density, "kg/m³", positive, "Mass of a cubic metre.")
        .number("young_Pa", &BlockSpec::young, "Pa", positive, "Young's modulus.")
        .ramps(springs)
        .number("bulk_Pa", &BlockSpec::bulk, "Pa", notNegative, "Resistance to a change of volume.")
        .ramps(springs)
        .number("working_stretch", &BlockSpec::workingStretch, "", Range{1.0, 100.0},
                "Stretch up to which the step must hold.");
    section.fields = withBodyFields(withPlasticity(withLosses(list))
                                        .choice("lumping", &BlockSpec::lumping, lumpingNames(),
                                                "How mass is shared out: by volume, or the same for every point."));
    return section;
}

namespace {

Section netPointSection() {
    Section section;
    section.fields = FieldList<NetPointSpec>()
                         .text("name", &NetPointSpec::name, Role::none, "Its name.")
                         .required()
                         .vector("position", &NetPointSpec::position, "m", placeRange, "Where it starts.")
                         .required()
                         .number("mass_kg", &NetPointSpec::mass, "kg", positive, "Mass.")
                         .flag("hold", &NetPointSpec::hold, "Whether it never moves.")
                         .take();
    section.check = [](const CheckInput& input, void* target) {
        const std::string& name = static_cast<const NetPointSpec*>(target)->name;
        if (input.table.find("name") == nullptr) return;
        if (!isName(name)) {
            input.problems.addError(input.at("name"), fmt::format("\"{}\" cannot be the name of a point", name),
                                    "a name has letters, digits, - and _");
        } else if (name == "all") {
            input.problems.addError(input.at("name"), "\"all\" cannot be the name of a point: it means all of them");
        }
    };
    return section;
}

Section netSpringSection() {
    Section section;
    section.fields =
        FieldList<NetSpringSpec>()
            .text("a", &NetSpringSpec::a, Role::none, "Name of the point at one end.")
            .required()
            .text("b", &NetSpringSpec::b, Role::none, "Name of the point at the other end.")
            .required()
            .number("stiffness_N_per_m", &NetSpringSpec::stiffness, "N/m", notNegative, "Spring constant.")
            .number("rest_length_m", &NetSpringSpec::restLength, "m", Range{0.0, 1e6},
                    "Length without force; the distance at the start if not given.")
            .number("damping_time_s", &NetSpringSpec::dampingTime, "s", dampingTime, "The net's if not given.")
            .take();
    return section;
}

void checkNet(const CheckInput& input, const NetSpec& net) {
    const auto report = [&](const char* list, std::size_t i, const char* key, const std::string& message,
                            const std::string& remedy) {
        const Node& item = input.table.find(list)->value.items[i];
        const Member* member = item.find(key);
        if (member != nullptr) input.problems.addError(member->value.place, message, remedy);
    };
    std::set<std::string> names;
    for (std::size_t i = 0; i < net.points.size(); ++i) {
        const std::string& name = net.points[i].name;
        if (names.insert(name).second) continue;
        report("points", i, "name", fmt::format("there is a point \"{}\" already", name), "");
    }
    const std::vector<std::string> known(names.begin(), names.end());
    for (std::size_t i = 0; i < net.springs.size(); ++i) {
        const NetSpringSpec& spring = net.springs[i];
        for (const auto& [key, end] : {std::pair{"a", spring.a}, std::pair{"b", spring.b}}) {
            if (names.contains(end)) continue;
            report("springs", i, key, fmt::format("there is no point \"{}\"", end), suggestion(end, known));
        }
        if (spring.a == spring.b) report("springs", i, "b", "a spring needs two different points", "");
    }
}

}  // namespace

SceneSection netSection() {
    SceneSection section;
    section.name = "net";
    section.layout = Layout::named;
    section.help = "Points and springs listed one by one.";
    section.enter = enterNamed(&SceneSpec::nets);
    section.existing = findNamed(&SceneSpec::nets);
    FieldList<NetSpec> list;
    list.tables("points", &NetSpec::points, netPointSection(), "Its point masses.")
        .required()
        .tables("springs", &NetSpec::springs, netSpringSection(), "Its springs.");
    section.fields =
        withBodyFields(withPlasticity(withLosses(list))
                           .number("radius", &NetSpec::radius, "m", lengthRange, "Radius of a spring as it is drawn.")
                           .number("ball", &NetSpec::ball, "m", lengthRange, "Radius of a point as it is drawn."));
    section.check = [](const CheckInput& input, void* target) {
        const auto& net = *static_cast<const NetSpec*>(target);
        if (input.isClean && net.points.empty()) input.problems.addError(input.at("points"), "a net needs points");
        checkNet(input, net);
    };
    return section;
}

}  // namespace taut::scene
