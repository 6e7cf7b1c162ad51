// The field table, part five: what happens while a scene runs, and what is claimed of it.
#include <algorithm>
#include <span>

#include "taut/fields/field_list.h"
#include "taut/fields/problems.h"
#include "taut/scene/sections.h"

namespace taut::scene {

using namespace world;

namespace {

// Tells of both uses of a key.
void merge(Field& into, const Field& other) {
    if (into.kind != other.kind || into.components != other.components) {
        into.kind = FieldKind::numbers;
        into.unit.clear();
    }
    into.required = into.required && other.required;
    if (into.help.find(other.help) == std::string::npos) into.help += " " + other.help;
}

// A row for what is said of a key; it is read and written by those of the kinds.
Field shown(const Field& field, const Kind<ActionSpec>& kind) {
    Field row = field;
    row.only.clear();
    row.write = [](void*, const Value&) {};
    row.read = [read = field.read, make = kind.make](const void*) { return read(dynamic_cast<void*>(make().get())); };
    return row;
}

// The keys of all kinds, each once and before the one that follows it where it was first met.
std::vector<Field> mergedRows(std::span<const Kind<ActionSpec>> kinds) {
    std::vector<Field> rows;
    const auto find = [&](const std::string& key) {
        return std::find_if(rows.begin(), rows.end(), [&](const Field& row) { return row.key == key; });
    };
    for (const auto& kind : kinds) {
        auto next = rows.end();
        const std::vector<Field>& own = kind.section.fields;
        for (auto field = own.rbegin(); field != own.rend(); ++field) {
            auto row = find(field->key);
            if (row == rows.end())
                row = rows.insert(next, shown(*field, kind));
            else
                merge(*row, *field);
            row->only.push_back(kind.name);
            next = row;
        }
    }
    for (Field& row : rows)
        if (row.only.size() == kinds.size()) row.only.clear();
    return rows;
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

SceneSection atSection(const KindTable<ActionSpec>& kinds) {
    SceneSection section;
    section.name = "at";
    section.layout = Layout::list;
    section.help =
        "What happens at a moment: at = [{ t = 2.0, do = \"grab\", … }, …], those of one tick in this order.";
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
    what.help = "What happens.";
    what.write = [](void*, const Value&) {};
    what.read = [](const void*) { return Value(); };
    for (const Kind<ActionSpec>& kind : kinds.all()) {
        what.choices.push_back(kind.name);
        section.forms.push_back(kind.section);
    }
    section.fields = mergedRows(kinds.all());
    section.fields.insert(section.fields.begin() + 1, what);
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
