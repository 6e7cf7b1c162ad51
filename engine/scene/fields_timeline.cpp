// The field table, part five: what happens while a scene runs, and what is claimed of it.
#include <fmt/format.h>

#include <cmath>

#include "taut/fields/field_list.h"
#include "taut/scene/sections.h"
#include "taut/fields/problems.h"

namespace taut::scene {

using namespace world;

namespace {


std::vector<std::string> actionNames() {
    return {"grab", "move", "release", "push", "hold", "free", "cut", "add-mass", "ramp", "spawn"};
}

// What a move, a push or a cut lacks that no single field can say.
void checkAction(const CheckInput& input, const ActionSpec& action) {
    const auto has = [&](const char* key) { return input.table.find(key) != nullptr; };
    const auto needs = [&](const char* what, const char* remedy) {
        input.problems.addError(input.place, fmt::format("do = \"{}\" needs {}", input.variant, what), remedy);
    };
    const bool isMove = action.what == Do::move, isCut = action.what == Do::cut;
    const bool hasPoints = !isMove && action.what != Do::release && action.what != Do::ramp;
    if (hasPoints && !has("target")) needs("target", "write target = \"KIND.NAME@SELECTOR\"");
    if ((action.what == Do::grab || action.what == Do::release) && !has("id"))
        needs("id", "id is the name of the hand");
    if (isMove && !has("id") && !has("target"))
        needs("id or target", "write id = \"HAND\" or target = \"collider.NAME\"");
    if (isMove && has("id") && has("target"))
        input.problems.addError(input.at("target"), "a move has id or target, not both",
                                "a hand has an id, a collider is a target");
    if (isMove && !has("to") && !has("rotation_deg")) needs("to", "write to = [x, y, z]");
    if (isMove && has("id") && has("rotation_deg"))
        input.problems.addError(input.at("rotation_deg"), "a hand is not turned", "only a collider is");
    if (isMove && has("to") && action.value.size() != 3)
        input.problems.addError(input.at("to"), fmt::format("to must be a list of 3 numbers [m], not {}",
                                                            description(input.table.find("to")->value)));
    if (isCut && has("plane") == has("segment"))
        needs("either plane or segment",
              "write plane = [[point], [normal]] in metres or segment = [[u, v], [u, v]] on a cloth grid");
    if (isCut && action.from && *action.from == *action.upTo)
        input.problems.addError(input.at("segment"), "the two ends of the cut are the same point");
    if (isCut && action.planeNormal && glm::dot(*action.planeNormal, *action.planeNormal) < smallest * smallest)
        input.problems.addError(input.at("plane"), "the normal of the plane must not be [0, 0, 0]");
    if (action.what == Do::push && action.impulse == dvec3(0.0))
        input.problems.addError(input.at("impulse_Ns"), "a push of [0, 0, 0] does nothing");
}

}  // namespace

SceneSection handSection() {
    SceneSection section;
    section.name = "hand";
    section.help = "What a hand may do while the scene is played live; every step allows for it.";
    section.enter = enterPart(&SceneSpec::hand);
    section.fields = FieldList<HandSpec>()
                         .flag("anywhere", &HandSpec::anywhere, "Whether any point of any body may be grabbed.")
                         .number("strength_N_per_m", &HandSpec::strength, "N/m", positive, "Of a hand, at most.")
                         .number("damping_ratio", &HandSpec::dampingRatio, "", Range{0.0, 10.0},
                                 "Of the grabbed mass on the hand's spring, at most.")
                         .take();
    return section;
}

SceneSection atSection() {
    SceneSection section;
    section.name = "at";
    section.layout = Layout::list;
    section.help =
        "What happens at a moment: at = [{ t = 2.0, do = \"grab\", … }, …], those of one tick in this order.";
    section.enter = enterNamed(&SceneSpec::actions);
    section.variantKey = "do";
    section.variant = [](const Node& table) -> std::string {
        const Member* what = table.find("do");
        return what != nullptr && what->value.kind == NodeKind::text ? what->value.text : "";
    };
    const std::vector<std::string> onPoints{"grab", "push", "hold", "free", "add-mass"};
    section.fields =
        FieldList<ActionSpec>()
            .number("t", &ActionSpec::t, "s", momentRange, "Moment; the nearest tick is taken.")
            .required()
            .role(Role::time)
            .choice("do", &ActionSpec::what, actionNames(), "What happens.")
            .required()
            .text("id", &ActionSpec::id, Role::none, "Name of the hand.")
            .only({"grab", "move", "release"})
            .text("target", &ActionSpec::target, Role::none,
                  "The points: KIND.NAME@SELECTOR, all if @SELECTOR is left out; of cut and spawn bodies, of move "
                  "collider.NAME.")
            .only({"grab", "move", "push", "hold", "free", "cut", "add-mass", "spawn"})
            .vector("near", &ActionSpec::near, "m", placeRange,
                    "Of the target only the point that is nearest to this place when it happens.")
            .only(onPoints)
            .number("radius", &ActionSpec::radius, "m", Range{0.0, 1e6},
                    "Points of the same bodies within this distance of such a point too.")
            .only({"grab"})
            .flag("rigid", &ActionSpec::rigid, "Whether the points are led exactly; else springs draw them.")
            .only({"grab"})
            .number("strength_N_per_m", &ActionSpec::strength, "N/m", positive, "Of the whole hand, shared by mass.")
            .only({"grab"})
            .number("damping_ratio", &ActionSpec::dampingRatio, "", Range{0.0, 10.0},
                    "Of the grabbed mass on the hand's spring.")
            .only({"grab"})
            .text("key", &ActionSpec::key, Role::none, "The field that changes, e.g. \"wind.breeze.velocity\".")
            .required()
            .only({"ramp"})
            .numbers("to", &ActionSpec::value,
                     "Where the hand or the collider goes [m]; the value that a ramp ends at.")
            .only({"move", "ramp"})
            .rotation("rotation_deg", &ActionSpec::rotation,
                      "How the collider is turned then, about x, then y, then z.")
            .only({"move"})
            .number("over_s", &ActionSpec::over, "s", momentRange, "How long it takes; 0 means at once.")
            .only({"move", "ramp"})
            .choice("ease", &ActionSpec::ease, easeNames(), "How it gets there.")
            .only({"move", "ramp"})
            .vector("impulse_Ns", &ActionSpec::impulse, "N s", placeRange, "Of all the points, shared by mass.")
            .required()
            .only({"push"})
            .segment("plane", &ActionSpec::planePoint, &ActionSpec::planeNormal, "m", placeRange,
                     "A point and a normal: springs that cross the plane are cut.")
            .only({"cut"})
            .segment("segment", &ActionSpec::from, &ActionSpec::upTo, "", share,
                     "From where to where a cloth grid is cut, as shares of its width and height from the top left.")
            .only({"cut"})
            .number("mass_kg", &ActionSpec::mass, "kg", positive, "Of all the points, shared evenly.")
            .required()
            .only({"add-mass"})
            .take();
    section.check = [](const CheckInput& input, void* target) {
        auto& action = *static_cast<ActionSpec*>(target);
        if (action.what == Do::ramp && input.variant == "ramp" && input.table.find("to") == nullptr)
            input.problems.addError(input.place, "do = \"ramp\" needs to", "to is the value that the ramp ends at");
        if (!input.isClean) return;
        checkAction(input, action);
        if (action.what != Do::move || action.value.size() != 3) return;
        action.to = vectorOf<dvec3>(action.value);
        action.value.clear();
    };
    return section;
}

SceneSection checkSection() {
    SceneSection section;
    section.name = "check";
    section.layout = Layout::list;
    section.help = "A claim about the state, which taut test holds the run against.";
    section.enter = enterNamed(&SceneSpec::checks);
    section.variant = [](const Node& table) -> std::string {
        return table.find("at") != nullptr ? "a check at a moment" : "a check of a span";
    };
    section.fields = FieldList<CheckSpec>()
                         .text("that", &CheckSpec::that, Role::none,
                               "The claim, e.g. \"max_strain(cloth.*) < 0.1\"; it must hold all the time unless a "
                               "moment or a span is given.")
                         .required()
                         .number("at", &CheckSpec::at, "s", momentRange, "Only at this moment.")
                         .role(Role::time)
                         .only({"a check at a moment"})
                         .number("from", &CheckSpec::from, "s", momentRange, "From this moment on.")
                         .role(Role::time)
                         .only({"a check of a span"})
                         .number("to", &CheckSpec::upTo, "s", momentRange, "Up to this moment.")
                         .role(Role::time)
                         .only({"a check of a span"})
                         .take();
    section.check = [](const CheckInput& input, void* target) {
        const auto& check = *static_cast<const CheckSpec*>(target);
        if (input.isClean && check.from && check.upTo && !(*check.from < *check.upTo))
            input.problems.addError(input.at("to"), "to must come after from");
    };
    return section;
}

SceneSection goldenSection() {
    SceneSection section;
    section.name = "golden";
    section.layout = Layout::list;
    section.help = "Frames that taut test compares with recorded ones.";
    section.enter = enterNamed(&SceneSpec::goldens);
    section.fields =
        FieldList<GoldenSpec>()
            .wholes("frames", &GoldenSpec::frames, Range{0.0, 1e9}, "Numbers of the frames, from 0.")
            .required()
            .flag("restart", &GoldenSpec::restart,
                  "Whether they are drawn from the state recorded with them, not from the one just computed.")
            .flag("debug", &GoldenSpec::debug, "With springs, points and contacts.")
            .text("camera", &GoldenSpec::camera, Role::camera, "Name of the camera; that of [picture] if not given.")
            .vector("size", &GoldenSpec::size, "px", Range{16, 16384}, "Width and height.")
            .take();
    section.check = [](const CheckInput& input, void* target) {
        if (input.isClean && static_cast<const GoldenSpec*>(target)->frames.empty())
            input.problems.addError(input.at("frames"), "frames must not be empty");
    };
    return section;
}

}  // namespace taut::scene
