// The field table of a scene file by topic: each function is the table of one section.
#pragma once

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

// Enters a new element with a name and a source.
template <class Spec>
auto enterNamed(std::vector<Spec> world::SceneSpec::*list) {
    return [list](world::SceneSpec& scene, const std::string& name, const world::Source& source) -> void* {
        Spec& spec = (scene.*list).emplace_back();
        if constexpr (
            requires { spec.name; })
            spec.name = name;
        spec.source = source;
        return &spec;
    };
}

// Finds an element by its name.
template <class Spec>
auto findNamed(std::vector<Spec> world::SceneSpec::*list) {
    return [list](world::SceneSpec& scene, const std::string& name) -> void* {
        for (Spec& spec : scene.*list)
            if (spec.name == name) return &spec;
        return nullptr;
    };
}

template <class Part>
auto findPart(Part world::SceneSpec::*part) {
    return [part](world::SceneSpec& scene, const std::string&) -> void* { return &(scene.*part); };
}

// Enters a part of the scene that exists once.
template <class Part>
auto enterPart(Part world::SceneSpec::*part) {
    return
        [part](world::SceneSpec& scene, const std::string&, const world::Source&) -> void* { return &(scene.*part); };
}

}  // namespace taut::scene
