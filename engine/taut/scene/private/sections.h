// The field table of a scene file by topic: each function is the table of one section.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "taut/fields/field.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/kinds.h"
#include "taut/spec/spec.h"

namespace taut::scene {

using namespace fields;
using world::lengthRange;
using world::momentRange;
using world::placeRange;

// A section of a scene file, and the struct that its fields fill.
struct SceneSection : Section {
    // The struct to fill: a part of the scene, or a new element with its name. If the forms of a section have structs
    // of their own, the struct of its form.
    std::function<void*(world::SceneSpec&, const std::string& name, const core::Source&)> enter;
    // The struct that exists already, or null. Without this function ramps cannot change it.
    std::function<void*(world::SceneSpec&, const std::string& name)> existing;
};

// All sections. The one without a name has `schema` and `title`.
std::vector<SceneSection> sceneSections(const world::Kinds& kinds);

// Settings of the whole scene.
SceneSection fileSection();
SceneSection needSection();
SceneSection solverSection();
SceneSection worldSection();
SceneSection contactSection();
SceneSection runSection();
SceneSection pictureSection();
SceneSection lightSection();
SceneSection environmentSection();
SceneSection lampSection();
SceneSection backgroundSection();

SceneSection materialSection();

// Sections of ties, forces and pictures.
SceneSection jointSection(const world::KindTable<world::JointSpec>& kinds);
SceneSection seamSection();
SceneSection massSection();
SceneSection colliderSection(const collision::ShapeKinds& shapes);
SceneSection cameraSection();
SceneSection labelSection();

// The timeline, and the claims.
SceneSection handSection();
SceneSection atSection(const world::KindTable<world::ActionSpec>& kinds);
SceneSection checkSection();
SceneSection fitSection();
SceneSection goldenSection();

// Keys must ascend in t. Reports each that does not.
void checkAscending(const CheckInput& input);

// The section of a part of the scene that exists once.
template <class Part>
SceneSection sectionOf(const char* name, const char* help, Part world::SceneSpec::*part, std::vector<Field> fields) {
    SceneSection section;
    section.name = name;
    section.help = help;
    section.fields = std::move(fields);
    section.enter = [part](world::SceneSpec& scene, const std::string&, const world::Source&) -> void* {
        return &(scene.*part);
    };
    section.existing = [part](world::SceneSpec& scene, const std::string&) -> void* { return &(scene.*part); };
    return section;
}

// The section of elements: with names, or one after the other.
template <class Spec>
SceneSection sectionOf(const char* name, const char* help, std::vector<Spec> world::SceneSpec::*list,
                       std::vector<Field> fields, Layout layout = Layout::named) {
    SceneSection section;
    section.name = name;
    section.layout = layout;
    section.help = help;
    section.fields = std::move(fields);
    section.enter = [list](world::SceneSpec& scene, const std::string& title, const world::Source& source) -> void* {
        Spec& spec = (scene.*list).emplace_back();
        if constexpr (
            requires { spec.name; })
            spec.name = title;
        spec.source = source;
        return &spec;
    };
    if constexpr (requires(Spec spec) { spec.name; })
        section.existing = [list](world::SceneSpec& scene, const std::string& title) -> void* {
            const auto found = std::find_if((scene.*list).begin(), (scene.*list).end(),
                                            [&](const Spec& own) { return own.name == title; });
            return found == (scene.*list).end() ? nullptr : &*found;
        };
    return section;
}

}  // namespace taut::scene
