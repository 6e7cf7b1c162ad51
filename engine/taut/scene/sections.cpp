#include "taut/scene/private/sections.h"

#include <fmt/format.h>

#include <memory>

namespace taut::scene {

namespace {

// The section of a kind whose structs go into a list of the scene.
template <class Base>
SceneSection kindSection(const world::Kind<Base>& kind, const collision::ShapeKinds& shapes,
                         world::Specs<Base> world::SceneSpec::*list) {
    SceneSection section;
    static_cast<Section&>(section) = kind.sectionWith ? kind.sectionWith(shapes) : kind.section;
    section.name = kind.name;
    section.layout = Layout::named;
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

// A row for `like`. scene::inherit() has taken over its keys before anything is read.
Field likeRow(const std::string& section) {
    Field row;
    row.key = "like";
    row.kind = FieldKind::text;
    row.help = fmt::format("Another {} of this scene, with default keys for this one.", section);
    row.write = [](void*, const Value&) {};
    row.read = [](const void*) { return Value(); };
    return row;
}

// The section without required fields: others may fill in missing ones.
Section partly(Section section) {
    section.variant = nullptr;
    section.variantKey.clear();
    section.check = nullptr;
    for (Field& field : section.fields) {
        field.required = false;
        field.ramp.reset();
        if (field.kind == FieldKind::table) field.inside = {partly(field.inside.front())};
    }
    return section;
}

// [defaults.rope] and so on. Each is read into a scene that is thrown away.
SceneSection defaultsSection(const std::vector<SceneSection>& sections) {
    SceneSection all;
    all.name = "defaults";
    all.help =
        "Default keys of the tables of a section: [defaults.SECTION] has the keys of [SECTION.NAME]. Keys of an "
        "element, and of its `like`, take precedence. Tables such as finish are merged key by key.";
    all.enter = [scratch = std::make_shared<world::SceneSpec>()](
                    world::SceneSpec&, const std::string&, const core::Source&) -> void* { return scratch.get(); };
    for (const SceneSection& section : sections) {
        if (section.layout != Layout::named) continue;
        Field row;
        row.key = section.name;
        row.kind = FieldKind::table;
        row.help = fmt::format("Defaults of every [{}.NAME].", section.name);
        row.inside = {partly(section)};
        row.enter = [enter = section.enter](void* scratch, const core::Source& source) {
            return enter(*static_cast<world::SceneSpec*>(scratch), "defaults", source);
        };
        all.fields.push_back(std::move(row));
    }
    return all;
}

// [material.NAME.cloth]: defaults of cloth made of it. Read into a cloth that is thrown away;
// scene::inherit() has handed it out.
Field thingsOfMaterial(const SceneSection& section) {
    Field row;
    row.key = section.name;
    row.kind = FieldKind::table;
    row.help = fmt::format("Default keys of each {} made of it: thickness, friction, finish and so on.", section.name);
    row.inside = {partly(section)};
    row.enter = [enter = section.enter, scratch = std::make_shared<world::SceneSpec>()](
                    void*, const core::Source& source) { return enter(*scratch, "material", source); };
    return row;
}

// Gives fields that name a method the known methods.
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
    const std::size_t material = all.size() - 1;
    for (const auto& kind : kinds.bodies.all()) {
        all.push_back(kindSection(kind, kinds.shapes, &world::SceneSpec::bodies));
        if (all.back().find("material") != nullptr) all[material].fields.push_back(thingsOfMaterial(all.back()));
    }
    all.insert(all.end(), {jointSection(kinds.joints), seamSection(), massSection()});
    for (const auto& kind : kinds.forces.all())
        all.push_back(kindSection(kind, kinds.shapes, &world::SceneSpec::forces));
    all.insert(all.end(), {colliderSection(kinds.shapes), cameraSection(), lightSection(), lampSection(),
                           environmentSection(), backgroundSection(), labelSection(), handSection(),
                           atSection(kinds.actions), checkSection(), fitSection(), goldenSection()});
    std::vector<std::string> methods;
    for (const ode::MethodInfo& method : kinds.methods.all()) methods.emplace_back(method.name);
    for (SceneSection& section : all) nameMethods(section, methods);
    all.push_back(defaultsSection(all));
    for (SceneSection& section : all)
        if (section.layout == Layout::named) section.fields.push_back(likeRow(section.name));
    return all;
}

}  // namespace taut::scene
