// The field table, part four: text in the picture.
#include <fmt/format.h>

#include "taut/fields/field_list.h"
#include "taut/fields/private/problems.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

using namespace world;

namespace {

constexpr const char* inWorld = "a label in the world";
constexpr const char* onScreen = "a label on the screen";
constexpr const char* ofBodies = "a label of bodies";

void checkLabel(const CheckInput& input, const LabelSpec& label) {
    const auto has = [&](const char* key) { return input.table.find(key) != nullptr; };
    if (input.variant.empty()) {
        input.problems.addError(input.place, fmt::format("{} has no place", input.where),
                                "give at = [x, y, z], screen = [x, y], or of = \"KIND.NAME\"");
    } else if (!has("of") && !has("text")) {
        input.problems.addError(input.place, fmt::format("{} needs text", input.where),
                                "only a label of bodies has a text of its own: their method");
    } else if (label.text && label.text->empty()) {
        input.problems.addError(input.at("text"), "text must not be empty");
    }
    if (label.from && label.to && *label.to <= *label.from)
        input.problems.addError(input.at("to_s"), "to_s must be later than from_s");
}

}  // namespace

SceneSection labelSection() {
    SceneSection section = sectionOf(
        "label", "A line of text in the picture, with a font of Debian's package fonts-dejavu-core.",
        &SceneSpec::labels,
        FieldList<LabelSpec>()
            .text("text", &LabelSpec::text, Role::none, "Text; of bodies by default the name of their method.")
            .vector("at", &LabelSpec::at, "m", Range{-1e6, 1e6}, "Place in the world.")
            .only({inWorld})
            .vector("screen", &LabelSpec::screen, "", Range{-1.0, 2.0},
                    "Place of the base line from the top left, as shares of the picture's width and height.")
            .only({onScreen})
            .text("of", &LabelSpec::of, Role::anyBodies,
                  "Bodies below the label, e.g. \"cloth.*\"; a second line marks divergence.")
            .only({ofBodies})
            .number("size", &LabelSpec::size, "", Range{0.005, 0.5},
                    "Height of the type as a share of the picture's height.")
            .colour("colour", &LabelSpec::colour, "Colour of the letters; they have a dark rim.")
            .choice("align", &LabelSpec::align, {"left", "centre", "right"}, "Alignment of the text at its place.")
            .number("plate", &LabelSpec::plate, "", share, "Darkness of a plate behind the text.")
            .number("from_s", &LabelSpec::from, "s", Range{0.0, 1e6}, "Time at which it appears; default the start.")
            .number("to_s", &LabelSpec::to, "s", Range{0.0, 1e6}, "Time at which it disappears; default never.")
            .take());
    section.variant = [](const Node& table) -> std::string {
        return table.find("of") != nullptr       ? ofBodies
               : table.find("at") != nullptr     ? inWorld
               : table.find("screen") != nullptr ? onScreen
                                                 : "";
    };
    section.check = [](const CheckInput& input, void* target) {
        checkLabel(input, *static_cast<const LabelSpec*>(target));
    };
    return section;
}

}  // namespace taut::scene
