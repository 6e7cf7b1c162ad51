#include "taut/scene/private/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/fields/private/value_reader.h"
#include "taut/scene/private/fabrics.h"

namespace taut::scene {

namespace {

class SceneReader {
  public:
    SceneReader(const std::vector<SceneSection>& sections, Problems& problems, ReadScene& out)
        : sections_(sections), problems_(problems), out_(out) {}

    void read(const Node& root) {
        const SceneSection& file =
            *std::find_if(sections_.begin(), sections_.end(), [](const Section& s) { return s.name.empty(); });
        // The keys before the first table form a table of their own.
        Node settings;
        settings.place = {0, 1, 1};
        for (const Member& member : root.members) {
            const auto section = std::find_if(sections_.begin(), sections_.end(),
                                              [&](const Section& s) { return s.name == member.key; });
            if (section != sections_.end() && !section->name.empty())
                readSection(*section, member);
            else if (file.find(member.key) != nullptr)
                settings.members.push_back(member);
            else
                reportUnknownSection(file, member);
        }
        enter("");
        readTable(file, settings, settings.place, "the scene", file.enter(out_.spec, "", {}));
    }

  private:
    // Sets the owner of the next fields: "cloth.flag", "solver", "joint", or the file.
    void enter(const std::string& owner) {
        owner_ = owner;
        problems_.about(owner);
    }

    world::Source sourceOf(Place place) const {
        if (place.origin > 0) return {problems_.fileOf(place), 0, 0};
        return {problems_.fileOf(place), place.line, place.column};
    }

    void reportUnknownSection(const Section& file, const Member& member) {
        std::vector<std::string> names = file.keys();
        for (const Section& section : sections_)
            if (!section.name.empty()) names.push_back(section.name);
        problems_.addError(member.place, fmt::format("a scene has no \"{}\"", member.key),
                           suggestion(member.key, names));
    }

    void readSection(const SceneSection& section, const Member& member) {
        if (section.layout == Layout::list) {
            readList(section, member);
        } else if (member.value.kind != NodeKind::table) {
            const std::string name = section.layout == Layout::named ? ".NAME" : "";
            problems_.addError(member.place,
                               fmt::format("{} must be a table, not {}", section.name, description(member.value)),
                               fmt::format("write [{}{}]", section.name, name));
        } else if (section.layout == Layout::table) {
            enter(section.name);
            const int before = problems_.errorCount();
            readTable(section, member.value, member.place, fmt::format("[{}]", section.name),
                      section.enter(out_.spec, "", sourceOf(member.place)));
            if (problems_.errorCount() > before) out_.faulty.insert(owner_);
        } else {
            for (const Member& element : member.value.members) readNamed(section, element);
        }
    }

    void readNamed(const SceneSection& section, const Member& element) {
        const std::string& name = element.key;
        if (element.value.kind != NodeKind::table) {
            problems_.addError(
                element.place,
                section.find(name) != nullptr
                    ? fmt::format("{} belongs to a {} with a name", name, section.name)
                    : fmt::format("{}.{} must be a table, not {}", section.name, name, description(element.value)),
                fmt::format("write [{}.NAME]", section.name));
            return;
        }
        if (!isName(name) && !isFabric(name)) {
            problems_.addError(element.place, fmt::format("\"{}\" cannot be the name of a {}", name, section.name),
                               "a name has letters, digits, - and _");
            return;
        }
        enter(fmt::format("{}.{}", section.name, name));
        out_.owners.emplace(owner_, element.place);
        const int before = problems_.errorCount();
        readTable(section, element.value, element.place, fmt::format("[{}]", owner_),
                  section.enter(out_.spec, name, sourceOf(element.place)));
        if (problems_.errorCount() > before) out_.faulty.insert(owner_);
    }

    void readList(const SceneSection& section, const Member& member) {
        if (member.value.kind != NodeKind::list) {
            problems_.addError(
                member.place,
                fmt::format("{} must be a list of tables, not {}", section.name, description(member.value)),
                fmt::format("write [[{}]]", section.name));
            return;
        }
        enter(section.name);
        for (std::size_t i = 0; i < member.value.items.size(); ++i) {
            const Node& item = member.value.items[i];
            const std::string name = fmt::format("{}[{}]", section.name, i);
            out_.owners.emplace(name, item.place);
            const int before = problems_.errorCount();
            readItem(
                section, item, name, fmt::format("[[{}]]", section.name),
                section.enter(out_.spec, section.forms.empty() ? "" : section.variant(item), sourceOf(item.place)));
            if (problems_.errorCount() > before) out_.faulty.insert(name);
        }
    }

    // Reads an element of a list of tables.
    void readItem(const Section& section, const Node& item, const std::string& name, const std::string& where,
                  void* target) {
        if (item.kind == NodeKind::table)
            readTable(section, item, item.place, where, target);
        else
            problems_.addError(item.place, fmt::format("{} must be a table, not {}", name, description(item)));
    }

    void readTable(const Section& section, const Node& table, Place place, const std::string& where, void* target) {
        const int before = problems_.errorCount();
        const std::string variant = section.variant ? section.variant(table) : "";
        const auto named = std::find_if(section.forms.begin(), section.forms.end(),
                                        [&](const Section& s) { return s.name == variant; });
        const Section& own = named == section.forms.end() ? section : *named;
        // A variant that no field has is an error, reported at its place.
        const auto fits = [&](const Field& field) {
            return field.only.empty() || variant.empty() ||
                   std::find(field.only.begin(), field.only.end(), variant) != field.only.end();
        };
        for (const Member& member : table.members) {
            const Field* field = section.find(member.key);
            if (field == nullptr) {
                reportUnknownKey(section, member, where, fits);
            } else if (!fits(*field) && isKnownVariant(section, variant)) {
                const std::string form =
                    section.variantKey.empty() ? variant : fmt::format("{} \"{}\"", section.variantKey, variant);
                problems_.addError(member.place, fmt::format("{} does not go with {}", member.key, form),
                                   fmt::format("it belongs to {}", joined(field->only)));
            } else {
                const Field* row = own.find(member.key);
                readField(row != nullptr ? *row : *field, member, where, target);
            }
        }
        for (const Field& field : own.fields) {
            if (!field.required || !fits(field) || table.find(field.key) != nullptr) continue;
            if (!field.only.empty() && variant.empty()) continue;
            problems_.addError(place, fmt::format("{} needs {}", where, field.key), remedyFor(field));
        }
        for (const Field& field : own.fields)
            if (const Member* said = table.find(field.key); said != nullptr && table.find(field.inPlaceOf) != nullptr)
                problems_.addError(said->value.place,
                                   fmt::format("{} has either {} or {}", where, field.key, field.inPlaceOf),
                                   "leave one out");
        if (!own.check) return;
        own.check({problems_, table, place, where, variant, problems_.errorCount() == before}, target);
    }

    // Whether a variant exists in the table; a slip such as shape = "spere" does not.
    static bool isKnownVariant(const Section& section, const std::string& variant) {
        const Field* key = section.find(section.variantKey);
        return key == nullptr || std::find(key->choices.begin(), key->choices.end(), variant) != key->choices.end();
    }

    static std::string remedyFor(const Field& field) {
        std::string help = field.help;
        if (!help.empty() && help.back() == '.') help.pop_back();
        if (field.range.low == field.range.high) return fmt::format("write {} = {}", field.key, field.range.low);
        return fmt::format("{} is {}: {}", field.key, description(field), help);
    }

    // For keys of the file itself that stand below the header of a table.
    std::string remedyForFileKey(const Member& member) const {
        for (const SceneSection& section : sections_) {
            if (section.name.empty() && section.find(member.key) != nullptr && member.value.kind == NodeKind::text)
                return "write it above the first table";
            if (section.name != member.key) continue;
            const NodeKind kind = member.value.kind;
            if (section.layout == Layout::list && kind == NodeKind::list)
                return fmt::format("write it above the first table, or as [[{}]]", member.key);
            if (section.layout == Layout::table && kind == NodeKind::table)
                return fmt::format("write it above the first table, or as [{}]", member.key);
        }
        return {};
    }

    template <class Fits>
    void reportUnknownKey(const Section& section, const Member& member, const std::string& where, const Fits& fits) {
        const std::vector<std::string> keys = section.keys();
        // A key of an inner table that was written one level too high, mistyped, or both.
        std::string remedy = remedyForFileKey(member);
        const auto lookInside = [&](bool mayBeMistyped) {
            for (const Field& field : section.fields) {
                if (field.kind != FieldKind::table || !remedy.empty()) continue;
                const std::vector<std::string> inner = field.inside.front().keys();
                const std::string likely = likelyWord(member.key, inner);
                if (likely.empty() || (!mayBeMistyped && likely != member.key)) continue;
                remedy = fmt::format("did you mean {} = {{ {} = … }}?", field.key, likely);
            }
        };
        lookInside(false);
        if (remedy.empty()) remedy = suggestion(member.key, keys);
        lookInside(true);
        if (remedy.empty()) {
            std::vector<std::string> possible;
            for (const Field& field : section.fields)
                if (fits(field)) possible.push_back(field.key);
            remedy = fmt::format("it has {}", joined(possible));
        }
        problems_.addError(member.place, fmt::format("{} has no key \"{}\"", where, member.key), remedy);
    }

    void readField(const Field& field, const Member& member, const std::string& where, void* target) {
        const Node& node = member.value;
        if (field.kind == FieldKind::table) {
            const Section& inside = field.inside.front();
            if (!inside.alone.empty() && (node.kind == NodeKind::number || node.kind == NodeKind::whole)) {
                Node table;
                table.place = node.place;
                table.members.push_back({inside.alone, node.place, node});
                return readField(field, {member.key, member.place, table}, where, target);
            }
            if (node.kind != NodeKind::table) {
                problems_.addError(node.place, fmt::format("{} must be a table, not {}", field.key, description(node)),
                                   fmt::format("write {} = {{ … }}", field.key));
                return;
            }
            const std::string title = where == "[defaults]" ? fmt::format("[defaults.{}]", field.key)
                                                            : fmt::format("{} of {}", field.key, where);
            readTable(inside, node, member.place, title, field.enter(target, sourceOf(node.place)));
        } else if (field.kind == FieldKind::tables) {
            if (node.kind != NodeKind::list) {
                problems_.addError(node.place,
                                   fmt::format("{} must be a list of tables, not {}", field.key, description(node)),
                                   fmt::format("write {} = [{{ … }}]", field.key));
                return;
            }
            for (std::size_t i = 0; i < node.items.size(); ++i) {
                const std::string name = fmt::format("{}[{}]", field.key, i);
                void* entry = field.enter(target, sourceOf(node.items[i].place));
                readItem(field.inside.front(), node.items[i], name, fmt::format("{} of {}", name, where), entry);
            }
        } else if (const std::optional<Value> value = fieldValue(field, node, problems_)) {
            field.write(target, *value);
            addReferences(field, node, *value);
        }
    }

    void addReferences(const Field& field, const Node& node, const Value& value) {
        if (field.role == Role::none) return;
        if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
            for (std::size_t i = 0; i < texts->size(); ++i)
                out_.references.push_back({field.role, node.kind == NodeKind::text ? node.place : node.items[i].place,
                                           (*texts)[i], 0.0, owner_});
        else if (const auto* text = std::get_if<std::string>(&value))
            out_.references.push_back({field.role, node.place, *text, 0.0, owner_});
        else if (const auto* number = std::get_if<double>(&value))
            out_.references.push_back({field.role, node.place, "", *number, owner_});
    }

    const std::vector<SceneSection>& sections_;
    Problems& problems_;
    ReadScene& out_;
    std::string owner_;
};

}  // namespace

ReadScene readScene(const Node& root, const std::vector<SceneSection>& sections, const std::string& fileName,
                    Problems& problems) {
    ReadScene out;
    out.spec.file = fileName;
    SceneReader(sections, problems, out).read(root);
    return out;
}

}  // namespace taut::scene
