#include "taut/scene/private/by_key.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

namespace {

bool isAmong(std::string_view key, std::span<const std::string_view> keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// A struct of a scene by its section and name, "cloth.flag" or "solver".
struct Part {
    const SceneSection* section;
    std::string name;
    std::string owner() const { return name.empty() ? section->name : section->name + "." + name; }
    void* in(world::SceneSpec& scene) const {
        return name.empty() ? section->enter(scene, "", {}) : section->existing(scene, name);
    }
};

// Bodies in their order, then materials, forces and the solver.
std::vector<Part> partsOf(const world::SceneSpec& scene, const std::vector<SceneSection>& sections) {
    std::vector<Part> parts;
    const auto add = [&](std::string_view section, const std::string& name) {
        for (const SceneSection& s : sections)
            if (s.name == section) parts.push_back({&s, name});
    };
    for (const world::BodySpec& body : scene.bodies) add(body.kind(), body.name);
    for (const auto& [name, material] : scene.materials) add("material", name);
    for (const world::ForceSpec& force : scene.forces) add(force.kind(), force.name);
    add("solver", "");
    return parts;
}

void eachNumberIn(const Section& section, void* target, std::span<const std::string_view> keys,
                  const std::function<void(double&)>& visit) {
    for (const Field& field : section.fields) {
        for (void* inside : field.entries ? field.entries(target) : std::vector<void*>{})
            eachNumberIn(field.inside.front(), inside, keys, visit);
        if (field.kind != FieldKind::number || !isAmong(field.key, keys)) continue;
        const Value value = field.read(target);
        if (const double* number = std::get_if<double>(&value)) {
            double changed = *number;
            visit(changed);
            if (changed != *number) field.write(target, changed);
        }
    }
}

std::string textOf(const Field& field, const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
    if (const double* number = std::get_if<double>(&value)) return numberText(*number);
    if (const auto* text = std::get_if<std::string>(&value)) return "\"" + *text + "\"";
    std::vector<std::string> words;
    for (const double number : std::get<std::vector<double>>(value))
        words.push_back(field.kind == FieldKind::wholeVector ? fmt::format("{:.0f}", number) : numberText(number));
    return "[" + joined(words) + "]";
}

void compare(const Section& section, void* before, void* after, const std::string& path,
             std::span<const std::string_view> keys, std::vector<Change>& changes) {
    for (const Field& field : section.fields) {
        const std::string key = path + "." + field.key;
        if (field.kind == FieldKind::tables) {
            const std::vector<void*> a = field.entries(before), b = field.entries(after);
            for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
                compare(field.inside.front(), a[i], b[i], fmt::format("{}.{}", key, i), keys, changes);
        }
        if (!field.read || !isAmong(field.key, keys)) continue;
        const Value value = field.read(after);
        if (value != field.read(before) && !std::holds_alternative<std::monostate>(value))
            changes.push_back({key, textOf(field, value)});
    }
}

}  // namespace

void eachNumber(world::SceneSpec& scene, const std::string& owner, std::span<const std::string_view> keys,
                const std::function<void(double&)>& visit) {
    const std::vector<SceneSection> sections = sceneSections(world::builtIn());
    for (const Part& part : partsOf(scene, sections)) {
        const bool isForce = scene.forces.find(part.section->name, part.name) != nullptr;
        if (part.name.empty() || (owner.empty() ? isForce : owner != part.owner())) continue;
        eachNumberIn(*part.section, part.in(scene), keys, visit);
    }
}

std::vector<Change> differences(const world::SceneSpec& before, const world::SceneSpec& after,
                                std::span<const std::string_view> keys) {
    const std::vector<SceneSection> sections = sceneSections(world::builtIn());
    world::SceneSpec a = before, b = after;
    std::vector<Change> changes;
    for (const Part& part : partsOf(before, sections))
        compare(*part.section, part.in(a), part.in(b), part.owner(), keys, changes);
    return changes;
}

std::string numberText(double value) {
    std::string text = fmt::format("{}", value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

}  // namespace taut::scene
