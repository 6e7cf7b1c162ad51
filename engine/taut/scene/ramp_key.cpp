#include "taut/scene/private/ramp_key.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/fields/private/problems.h"

namespace taut::scene {

namespace {

// A field by its path inside a section, and how to get from the section's struct to the struct of the field.
struct Row {
    std::string path;  // "gust.amplitude"
    const Field* field = nullptr;
    std::function<void*(void*, const world::Source&)> enter;  // none: the field is in the section's struct
};

std::vector<Row> rowsOf(const Section& section) {
    std::vector<Row> rows;
    for (const Field& field : section.fields) {
        rows.push_back({field.key, &field, {}});
        if (field.kind != FieldKind::table) continue;
        // A table that may be written as one number may be changed as one.
        if (const Field* alone = field.inside.front().find(field.inside.front().alone))
            rows.back() = {field.key, alone, field.enter};
        for (const Field& inner : field.inside.front().fields)
            rows.push_back({field.key + "." + inner.key, &inner, field.enter});
    }
    return rows;
}

std::vector<std::string> rampablePaths(const SceneSection& section) {
    std::vector<std::string> paths;
    if (!section.existing) return paths;
    for (const Row& row : rowsOf(section))
        if (row.field->ramp) paths.push_back(row.path);
    return paths;
}

std::vector<double> numbersIn(const Value& value) {
    if (const double* number = std::get_if<double>(&value)) return {*number};
    if (const auto* numbers = std::get_if<std::vector<double>>(&value)) return *numbers;
    return {};
}

// A row of a section's struct.
struct RowField final : world::RampField {
    std::string name;  // of the struct
    std::function<void*(world::SceneSpec&, const std::string&)> existing;
    std::function<void*(void*, const world::Source&)> enter;
    Field row;

    void* place(world::SceneSpec& scene) const {
        void* target = existing(scene, name);
        return enter ? enter(target, {}) : target;
    }
    std::vector<double> read(const world::SceneSpec& scene) const override {
        return numbersIn(row.read(place(const_cast<world::SceneSpec&>(scene))));  // read() does not change it
    }
    void write(world::SceneSpec& scene, const std::vector<double>& value) const override {
        row.write(place(scene), row.kind == FieldKind::number ? Value(value.front()) : Value(value));
    }
};

}  // namespace

std::optional<RampKey> rampKey(const std::string& key, const Node& root, const std::vector<SceneSection>& sections,
                               world::SceneSpec& scene, TargetFault& fault) {
    const std::vector<std::string> parts = fields::keyPath(key);
    const auto section = std::find_if(sections.begin(), sections.end(),
                                      [&](const Section& s) { return !s.name.empty() && s.name == parts[0]; });
    const auto fail = [&](std::string message, std::string remedy) {
        fault = {std::move(message), std::move(remedy)};
        return std::nullopt;
    };
    if (section == sections.end() || rampablePaths(*section).empty()) {
        std::vector<std::string> names;
        for (const SceneSection& s : sections)
            if (!rampablePaths(s).empty()) names.push_back(s.name);
        std::string remedy = section == sections.end() ? suggestion(parts[0], names) : "";
        if (remedy.empty()) remedy = "keys of ramps: " + joined(names);
        if (section == sections.end()) return fail(fmt::format("there is no \"{}\" to change", parts[0]), remedy);
        return fail(fmt::format("no key of {} can change while the scene runs", parts[0]), remedy);
    }
    const bool isNamed = section->layout == Layout::named;
    const std::size_t first = isNamed ? 2 : 1;
    const std::string name = isNamed && parts.size() > 1 ? parts[1] : "";
    const std::string owner = isNamed ? section->name + "." + name : section->name;
    if (isNamed && section->existing(scene, name) == nullptr) {
        const Node* named = root.at(section->name);
        const bool hasNone = named == nullptr || named->members.empty();
        const std::string remedy = hasNone ? "the scene has none" : suggestion(name, named->keys());
        return fail(fmt::format("there is no {} \"{}\"", section->name, name), remedy);
    }
    std::string path;
    for (std::size_t i = first; i < parts.size(); ++i) path += (i == first ? "" : ".") + parts[i];
    const std::vector<Row> rows = rowsOf(*section);
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.path == path; });
    const std::vector<std::string> paths = rampablePaths(*section);
    if (row == rows.end()) {
        std::string remedy = suggestion(path, paths);
        if (remedy.empty()) remedy = "keys of ramps: " + joined(paths);
        return fail(path.empty() ? fmt::format("\"{}\" names no field", key)
                                 : fmt::format("[{}] has no key \"{}\"", owner, path),
                    remedy);
    }
    if (!row->field->ramp)
        return fail(fmt::format("{} cannot change while the scene runs", key), "keys of ramps: " + joined(paths));
    const Node* table = root.along(fields::keyPath(owner));
    const std::string variant = section->variant && table != nullptr ? section->variant(*table) : "";
    const std::vector<std::string>& only = row->field->only;
    if (!variant.empty() && !only.empty() && std::find(only.begin(), only.end(), variant) == only.end())
        return fail(fmt::format("{} is {}, which has no {}", owner, variant, path), "");
    auto access = std::make_shared<RowField>();
    access->affects = *row->field->ramp;
    access->owner = owner;
    access->name = name;
    access->existing = section->existing;
    access->enter = row->enter;
    access->row = *row->field;
    if (access->read(scene).empty())
        return fail(fmt::format("{} has no value to begin from", key), fmt::format("give it in [{}]", owner));
    return RampKey{row->field, std::move(access)};
}

std::vector<std::string> rampableKeys(const std::vector<SceneSection>& sections, const Node& root) {
    std::vector<std::string> keys;
    for (const SceneSection& section : sections) {
        const Node* own = root.at(section.name);
        const bool isNamed = section.layout == Layout::named;
        if (isNamed && own == nullptr) continue;
        for (const std::string& name : isNamed ? own->keys() : std::vector<std::string>{""})
            for (const std::string& path : rampablePaths(section))
                keys.push_back(section.name + (isNamed ? "." + name + "." : ".") + path);
    }
    return keys;
}

std::vector<std::string> rampableLines(const std::vector<SceneSection>& sections) {
    std::vector<std::string> lines;
    for (const SceneSection& section : sections) {
        const std::vector<std::string> paths = rampablePaths(section);
        if (paths.empty()) continue;
        const std::string name = section.layout == Layout::named ? section.name + ".NAME" : section.name;
        lines.push_back(fmt::format("{:<14} {}", name, joined(paths)));
    }
    return lines;
}

}  // namespace taut::scene
