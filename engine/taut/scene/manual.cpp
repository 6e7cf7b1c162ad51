// The manual of the scene format, made from the field table.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "taut/check/check.h"
#include "taut/fields/private/problems.h"
#include "taut/scene/load.h"
#include "taut/scene/private/ramp_key.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

namespace {

// Titles of the sections that have had a table of these keys: "solver: integrator, dt" to "[cloth.NAME]".
using TitlesOfTables = std::map<std::string, std::string>;

// "    cells            a list of 2 whole numbers, above 0; default [20, 20]" and its help below.
void writeFields(const Section& section, const std::string& title, void* target, const std::string& indent,
                 TitlesOfTables& titles, std::string& out) {
    for (const Field& field : section.fields) {
        std::string facts = description(field);
        const std::string range = description(field.range, "");
        const bool hasRange = field.kind == FieldKind::number ||
                              (field.kind == FieldKind::whole && field.values.empty()) ||
                              field.kind == FieldKind::vector || field.kind == FieldKind::wholeVector ||
                              field.kind == FieldKind::stepLength;
        if (hasRange && !range.empty()) facts += ", " + range;
        if (field.required) facts += "; required";
        if (field.inside.empty() && !field.required) {
            const std::string text = defaultText(field.read(target));
            if (!text.empty()) facts += "; default " + text;
        }
        out += fmt::format("{}{:<{}} {}\n", indent, field.key, 26 - static_cast<int>(indent.size()), facts);
        std::string help = field.help;
        if (!field.only.empty()) help += fmt::format(" Only for {}.", joined(field.only));
        bool isFirst = true;
        if (!field.inside.empty()) {
            const std::string keys = joined(field.inside.front().keys()),
                              elsewhere = fmt::format("As in [{}].", field.key);
            const auto [known, isNew] = titles.try_emplace(fmt::format("{}: {}", field.key, keys), title);
            isFirst = isNew || known->second == title;
            const bool isElsewhere = std::ranges::all_of(field.inside.front().fields,
                                                         [&](const Field& own) { return own.help == elsewhere; });
            if (!isFirst) help += fmt::format(" Its keys are those in {}.", known->second);
            if (isFirst && isElsewhere) help += fmt::format(" {} Its keys: {}.", elsewhere, keys);
            isFirst = isFirst && !isElsewhere;
        }
        out += fmt::format("{:<27}{}\n", "", help);
        const bool isRepeated = section.name == "material" && field.inside.size() == 1 &&
                                field.inside.front().layout == Layout::named;  // keys of a section that follows
        if (!field.inside.empty() && isFirst && !isRepeated)
            writeFields(field.inside.front(), title, field.enter(target, {}), indent + "  ", titles, out);
    }
}

}  // namespace

std::string manual(const world::Kinds& kinds) {
    std::string out =
        "A scene is a TOML file. Numbers are in SI units unless the key's name or its text states another unit;\n"
        "y points up. Missing keys have their defaults.\n";
    world::SceneSpec scene;
    TitlesOfTables titles;
    // Every section with its fields.
    for (const SceneSection& section : sceneSections(kinds)) {
        const std::string title = section.name.empty()              ? "the file"
                                  : section.layout == Layout::named ? fmt::format("[{}.NAME]", section.name)
                                  : section.layout == Layout::list  ? fmt::format("[[{}]]", section.name)
                                  : section.name == "defaults"      ? "[defaults.SECTION]"
                                                                    : fmt::format("[{}]", section.name);
        out += fmt::format("\n{}\n  {}\n\n", title, section.help);
        if (section.name != "defaults")  // it repeats the keys of the sections above
            writeFields(section, title, section.enter(scene, "name", {}), "  ", titles, out);
    }
    // The keys that several sections share.
    out +=
        "\n"
        "Targets\n"
        "  KIND.NAME@SELECTOR, e.g. cloth.flag@left. * in NAME matches any letters. A copy of an array is NAME.0,\n"
        "  NAME.1, …\n\n"
        "  every body   all, #0 #1 … (points by number)\n"
        "  cloth grid   left right top bottom, top-left top-right bottom-left bottom-right, corners, edges,\n"
        "               (u,v) with u and v from 0 to 1, across and down; (u,v,r) all within r metres of there;\n"
        "               of a round one no corners\n"
        "  cloth mesh   boundary top bottom left right\n"
        "  rope         start end ends, 50%\n"
        "  block        left right top bottom back front corners\n"
        "  net          the names of its points\n\n"
        "Points on colliders\n"
        "  hold_on = \"collider.NAME\" of a body attaches the points of hold to that collider; a [[joint]] with\n"
        "  collider.NAME on one side does so with points of any body, or ties them by springs or rods;\n"
        "  do = \"hold\" with hold_on attaches points while the scene runs, and \"free\" releases them.\n"
        "  Attached points follow the motion of the collider, and no collider stops them.\n\n"
        "Contact between bodies\n"
        "  touch = \"others\" of two bodies keeps their surfaces apart, touch = \"all\" also the parts of a body: by\n"
        "  the sum of their thicknesses, so thickness should be at most half of the shortest cell. [contact] has\n"
        "  their friction, and the number of detections in a tick. Bodies that cross at the start are separated;\n"
        "  taut check names them. metrics.csv has body_contacts, the number of contact points at the end of a\n"
        "  frame, and crossings, edges that go through triangles; `contacts` counts points on colliders only.\n"
        "  --debug shows the former in blue, with a line from surface to surface, crossings in red.\n\n"
        "Ramps\n"
        "  do = \"ramp\" changes a number or a list of numbers from its value at that moment:\n\n";
    for (const std::string& line : rampableLines(sceneSections(kinds))) out += "  " + line + "\n";
    out += "\nChecks\n" + check::functionsManual();
    out.pop_back();
    return out;
}

}  // namespace taut::scene
