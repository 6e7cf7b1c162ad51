#include "taut/scene/private/sections.h"

namespace taut::scene {

namespace {

// The section of a kind, whose structs go into a list of the scene.
template <class Base>
SceneSection kindSection(const world::Kind<Base>& kind, world::Specs<Base> world::SceneSpec::*list) {
    SceneSection section;
    static_cast<Section&>(section) = kind.section;
    section.enter = [list, make = kind.make](world::SceneSpec& scene, const std::string& name,
                                             const core::Source& source) -> void* {
        Base& spec = (scene.*list).add(make());
        spec.name = name;
        spec.source = source;
        return dynamic_cast<void*>(&spec);
    };
    section.existing = [list, kind = kind.name](world::SceneSpec& scene, const std::string& name) -> void* {
        return dynamic_cast<void*>((scene.*list).find(kind, name));
    };
    return section;
}

// Fields that name a method get the methods that there are.
void nameMethods(Section& section, const std::vector<std::string>& names) {
    for (Field& field : section.fields) {
        if (field.role == Role::method) field.choices = names;
        for (Section& inside : field.inside) nameMethods(inside, names);
    }
    for (Section& form : section.forms) nameMethods(form, names);
}

}  // namespace

std::vector<SceneSection> sceneSections(const world::Kinds& kinds) {
    std::vector<SceneSection> all{fileSection(),    needSection(), solverSection(),  worldSection(),
                                  contactSection(), runSection(),  pictureSection(), materialSection()};
    for (const auto& kind : kinds.bodies.all()) all.push_back(kindSection(kind, &world::SceneSpec::bodies));
    all.insert(all.end(), {jointSection(kinds.joints), massSection()});
    for (const auto& kind : kinds.forces.all()) all.push_back(kindSection(kind, &world::SceneSpec::forces));
    all.insert(all.end(), {colliderSection(kinds.shapes), cameraSection(), lightSection(), lampSection(),
                           environmentSection(), backgroundSection(), labelSection(), handSection(),
                           atSection(kinds.actions), checkSection(), goldenSection()});
    std::vector<std::string> methods;
    for (const ode::MethodInfo& method : kinds.methods.all()) methods.emplace_back(method.name);
    for (SceneSection& section : all) nameMethods(section, methods);
    return all;
}

}  // namespace taut::scene
