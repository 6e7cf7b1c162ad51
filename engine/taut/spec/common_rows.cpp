#include "taut/spec/common_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/fields/private/problems.h"
#include "taut/ode/method_table.h"
#include "taut/spec/actions.h"
#include "taut/spec/targets.h"

namespace taut::world {

using fields::FieldList;
using fields::Range;
using fields::Role;
using fields::Section;

namespace {

constexpr Range copies{1.0, 100000.0};
constexpr double maxCopies = 100000;

}  // namespace

void checkJoint(const fields::CheckInput& input, const JointSpec& joint) {
    if (input.table.find("name") != nullptr && !fields::isName(joint.name))
        input.problems.addError(input.at("name"), fmt::format("\"{}\" cannot be the name of a joint", joint.name),
                                "a name has letters, digits, - and _");
    else if (joint.name.starts_with(liveHand))
        input.problems.addError(
            input.at("name"),
            fmt::format("names that begin with \"{}\" are reserved for the hands of a player", liveHand),
            "give the joint another name");
    const auto isWhole = [](const std::string& text) {
        const Target target = parseTarget(text);
        return target.kind == "collider" || target.selector.empty() || target.selector == "all";
    };
    const auto areWhole = [&](const JointSide& side) {
        return std::all_of(side.targets.begin(), side.targets.end(), isWhole);
    };
    if (joint.place && !areWhole(joint.a) && !areWhole(joint.b))
        input.problems.addError(input.at("place"),
                                "place is on a side that is a whole solid or a collider, and both sides name points",
                                "leave the selector of one out, or leave place out");
    if (joint.placeIn != JointSpec::PlaceIn::side && !joint.place)
        input.problems.addError(input.at("place_in"), "place_in needs a place", "e.g. place = [0, 1, 0]");
    if (joint.isDrawn()) return;
    for (const char* key : {"radius", "turns", "coil_radius"})
        if (input.table.find(key) != nullptr)
            input.problems.addError(input.at(key), fmt::format("{} needs a joint that is drawn", key),
                                    "give it a finish, e.g. finish = { colour = \"#b08040\" }");
}

Section arraySection() {
    Section section;
    section.fields =
        FieldList<ArraySpec>()
            .vector("count", &ArraySpec::count, "", copies, "Number of copies along the three directions.")
            .required()
            .vector("step_x", &ArraySpec::stepX, "m", placeRange, "Step from one copy to the next, first direction.")
            .vector("step_y", &ArraySpec::stepY, "m", placeRange, "Step in the second direction.")
            .vector("step_z", &ArraySpec::stepZ, "m", placeRange, "Step in the third direction.")
            .take();
    section.check = [](const fields::CheckInput& input, void* target) {
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
                         .role(Role::method)
                         .number("dt", &SolverOverride::dt, "s", Range{1e-9, 1.0}, "As in [solver].")
                         .number("safety", &SolverOverride::safety, "", Range{0.01, 1.0}, "As in [solver].")
                         .whole("newton_steps", &SolverOverride::newtonSteps, "", Range{1, 100}, "As in [solver].")
                         .number("cg_tolerance", &SolverOverride::cgTolerance, "", Range{1e-12, 0.1}, "As in [solver].")
                         .whole("cg_iterations", &SolverOverride::cgIterations, "", Range{1, 1e6}, "As in [solver].")
                         .take();
    return section;
}

Section finishSection() {
    Section section;
    section.variant = [](const fields::Node& table) -> std::string {
        const fields::Member* pattern = table.find("pattern");
        return pattern != nullptr && pattern->value.text == "image" ? "the pattern image" : "a painted pattern";
    };
    section.fields =
        FieldList<FinishSpec>()
            .colour("colour", &FinishSpec::colour, "Colour of the front.")
            .colour("back_colour", &FinishSpec::backColour, "Colour of the back; default a paler front.")
            .goesWith("colour")
            .colour("accent", &FinishSpec::accent, "Second colour of a pattern.")
            .choice("pattern", &FinishSpec::pattern, {"plain", "checker", "stripes", "tartan", "image"}, "Pattern.")
            .number("repeat_m", &FinishSpec::repeat, "m", lengthRange,
                    "Period of the pattern; on a mesh in texture coordinates.")
            .number("weave", &FinishSpec::weave, "", fields::share,
                    "Depth of the weave: 0 smooth, 1 coarse linen. A mesh without texture coordinates has no weave.")
            .choice("binding", &FinishSpec::binding, {"plain", "twill", "satin", "rib", "knit"},
                    "Crossing of the threads of a weave. Twill shows a quarter of weft, in the colour of the back.")
            .number("thread_m", &FinishSpec::thread, "m", lengthRange, "Distance of two threads.")
            .number("slub", &FinishSpec::slub, "", fields::share,
                    "Unevenness of the threads: 0 nylon, 0.5 denim, 1 raw linen.")
            .number("fuzz", &FinishSpec::fuzz, "", fields::share,
                    "Fibres that stand up: 0.3 flannel, 0.6 velvet, 1 a blanket of fleece.")
            .number("roughness", &FinishSpec::roughness, "", fields::share, "Roughness: 0 a mirror, 1 chalk.")
            .number("sheen", &FinishSpec::sheen, "", fields::share, "Strength of the bright rim of fabric.")
            .number("translucency", &FinishSpec::translucency, "", fields::share,
                    "Share of light from the other side of a cloth that passes through, in its colour: 0.4 thin silk, "
                    "0.2 cotton, 0.03 velvet.")
            .number("anisotropy", &FinishSpec::anisotropy, "", fields::share,
                    "Spread of the gloss across the warp, in the colour of the threads: 0 a smooth skin, 0.8 satin.")
            .number(
                "hem_m", &FinishSpec::hem, "m", Range{0.0, 1.0},
                "Drawn thickness of the free edges of a cloth, if it is more than a pixel; it affects pictures only.")
            .whole("smooth", &FinishSpec::smooth, "", Range{0.0, 3.0},
                   "Number of times that a cloth or rope is refined to twice as fine for pictures, on a smooth surface "
                   "or curve; it affects pictures only.")
            .text("skin", &FinishSpec::skin, Role::mesh,
                  "OBJ or glTF file of a mesh that is drawn in place of a cloth or block and moves with it. It lies on "
                  "the body at the start, in metres of the scene, or placed as the cloth's own mesh.")
            .text("texture", &FinishSpec::texture, Role::texture, "Picture file, PNG or JPEG.")
            .required()
            .only({"the pattern image"})
            .take();
    return section;
}

void keepRadius(const fields::CheckInput& input, double radius, BodySpec& body) {
    constexpr double far = 0.5;
    if (input.table.find("thickness") == nullptr)
        body.thickness = radius;
    else if (body.thickness < far * radius && (body.collide || body.touch != Touch::nothing))
        input.problems.addWarning(input.at("thickness"),
                                  fmt::format("with a drawn radius of {} m it sinks in by {:.3g} m at contact", radius,
                                              radius - body.thickness),
                                  "leave thickness out");
}

std::vector<std::string> easeNames() {
    return {"linear", "smooth", "in", "out", "hold"};
}

std::vector<std::string> methodNames() {
    std::vector<std::string> names;
    for (const ode::MethodInfo& method : ode::methods()) names.emplace_back(method.name);
    return names;
}

std::vector<std::string> lumpingNames() {
    return {"weighted", "uniform"};
}

}  // namespace taut::world
