// The field table, part five: the timeline, and the claims.
#include "taut/fields/field_list.h"
#include "taut/fields/private/problems.h"
#include "taut/scene/private/merged_rows.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

using namespace world;

SceneSection handSection() {
    return sectionOf("hand", "Limits of a hand in live play; every step allows for it.", &SceneSpec::hand,
                     FieldList<HandSpec>()
                         .flag("anywhere", &HandSpec::anywhere, "Whether any point of any body may be grabbed.")
                         .number("strength_N_per_m", &HandSpec::strength, "N/m", positive, "Largest speed of a hand.")
                         .number("damping_ratio", &HandSpec::dampingRatio, "", Range{0.0, 10.0},
                                 "Largest acceleration of the grabbed mass by the spring of a hand.")
                         .take());
}

SceneSection atSection(const KindTable<ActionSpec>& kinds) {
    SceneSection section;
    section.name = "at";
    section.layout = Layout::list;
    section.help = "Actions: at = [{ t = 2.0, do = \"grab\", … }, …]; actions of one tick are performed in this order.";
    section.enter = [kinds](SceneSpec& scene, const std::string& name, const Source& source) -> void* {
        const Kind<ActionSpec>* kind = kinds.find(name);
        ActionSpec& action = scene.actions.add((kind != nullptr ? *kind : kinds.all().front()).make());
        action.source = source;
        return dynamic_cast<void*>(&action);
    };
    section.variantKey = "do";
    section.variant = [](const Node& table) -> std::string {
        const Member* what = table.find("do");
        return what != nullptr && what->value.kind == NodeKind::text ? what->value.text : "";
    };
    Field what;
    what.key = section.variantKey;
    what.kind = FieldKind::choice;
    what.required = true;
    what.help = "Action.";
    what.write = [](void*, const Value&) {};
    what.read = [](const void*) { return Value(); };
    for (const Kind<ActionSpec>& kind : kinds.all()) {
        what.choices.push_back(kind.name);
        section.forms.push_back(kind.section);
    }
    section.fields = mergedRows(kinds.all(), [](const auto& kind, const Field&) { return std::vector{kind.name}; });
    section.fields.insert(section.fields.begin() + 1, what);
    return section;
}

SceneSection checkSection() {
    SceneSection section =
        sectionOf("check", "A claim about the state, for taut test.", &SceneSpec::checks,
                  FieldList<CheckSpec>()
                      .text("that", &CheckSpec::that, Role::none,
                            "Claim, e.g. \"max_strain(cloth.*) < 0.1\"; it must hold at every tick unless a time or "
                            "a span is given.")
                      .required()
                      .number("at", &CheckSpec::at, "s", momentRange, "Only time.")
                      .role(Role::time)
                      .only({"a check at a moment"})
                      .number("from", &CheckSpec::from, "s", momentRange, "First time.")
                      .role(Role::time)
                      .only({"a check of a span"})
                      .number("to", &CheckSpec::upTo, "s", momentRange, "Last time.")
                      .role(Role::time)
                      .only({"a check of a span"})
                      .take(),
                  Layout::list);
    section.variant = [](const Node& table) -> std::string {
        return table.find("at") != nullptr ? "a check at a moment" : "a check of a span";
    };
    section.check = [](const CheckInput& input, void* target) {
        const auto& check = *static_cast<const CheckSpec*>(target);
        if (input.isClean && check.from && check.upTo && !(*check.from < *check.upTo))
            input.problems.addError(input.at("to"), "to must come after from");
    };
    return section;
}

namespace {

Section fitTargetSection() {
    Section section;
    const char *value = "a target at a moment", *curve = "a measured curve";
    section.variant = [=](const Node& table) { return table.find("curve") != nullptr ? curve : value; };
    section.fields =
        FieldList<FitTarget>()
            .text("that", &FitTarget::that, Role::none,
                  "Measured quantity, in the language of checks, e.g. \"lowest(cloth.strip)\".")
            .required()
            .number("at", &FitTarget::at, "s", momentRange, "Time of the measurement.")
            .required()
            .only({value})
            .number("value", &FitTarget::value, "", anyNumber, "Measured value, in the unit of the quantity.")
            .required()
            .only({value})
            .text("curve", &FitTarget::curve, Role::none,
                  "CSV file of measurements: time [s], value, and optionally sigma.")
            .only({curve})
            .number("sigma", &FitTarget::sigma, "", Range{1e-12, 1e12},
                    "Standard deviation of the measurement, in its unit; of a curve the default for its file.")
            .take();
    section.check = [](const CheckInput& input, void* target) {
        auto& fit = *static_cast<FitTarget*>(target);
        if (!input.isClean || !fit.curve.empty()) return;
        if (!fit.sigma)
            input.problems.addError(input.place, input.where + " needs sigma", "how far the measured value may be off");
        else
            fit.points = {{*fit.at, *fit.value, *fit.sigma}};
    };
    return section;
}

}  // namespace

SceneSection fitSection() {
    return sectionOf(
        "fit", "Numbers of the scene that taut fit fits, and measurements.", &SceneSpec::fit,
        FieldList<FitSpec>()
            .texts("keys", &FitSpec::keys, Role::none,
                   "At most six numbers, as --set names them, e.g. \"material.m.bending_rigidity_N_m\".")
            .required()
            .numbers("low", &FitSpec::low, "Lower bound of each number; above 0 the number is fitted by its logarithm.")
            .required()
            .numbers("high", &FitSpec::high, "Upper bound of each number.")
            .required()
            .tables("target", &FitSpec::targets, fitTargetSection(), "Measurements, one [[fit.target]] for each.")
            .take());
}

SceneSection goldenSection() {
    SceneSection section = sectionOf(
        "golden", "Frames that taut test compares with recorded ones.", &SceneSpec::goldens,
        FieldList<GoldenSpec>()
            .wholes("frames", &GoldenSpec::frames, Range{0.0, 1e9}, "Numbers of the frames, from 0.")
            .required()
            .flag("restart", &GoldenSpec::restart,
                  "Whether they are drawn from the recorded state instead of the computed one.")
            .flag("debug", &GoldenSpec::debug, "Whether springs, points and contacts are drawn.")
            .text("camera", &GoldenSpec::camera, Role::camera, "Name of the camera; default that of [picture].")
            .vector("size", &GoldenSpec::size, "px", Range{16, 16384}, "Width and height.")
            .take(),
        Layout::list);
    section.check = [](const CheckInput& input, void* target) {
        if (input.isClean && static_cast<const GoldenSpec*>(target)->frames.empty())
            input.problems.addError(input.at("frames"), "frames must not be empty");
    };
    return section;
}

}  // namespace taut::scene
