// Merges the rows of kinds that share one list of tables, such as actions and joints: for the schema, the manual and
// messages on misplaced keys. It reads no file.
#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "taut/fields/field.h"
#include "taut/spec/specs.h"

namespace taut::scene {

// Describes both uses of a key.
inline void merge(fields::Field& into, const fields::Field& other) {
    if (into.kind != other.kind || into.components != other.components) {
        into.kind = fields::FieldKind::numbers;
        into.unit.clear();
    }
    into.required = into.required && other.required;
    if (into.help.find(other.help) == std::string::npos) into.help += " " + other.help;
}

// A row for messages on a key. The rows of the kinds read and write the key.
template <class Base>
fields::Field shown(const fields::Field& field, const world::Kind<Base>& kind) {
    fields::Field row = field;
    row.only.clear();
    row.write = [](void*, const fields::Value&) {};
    row.read = [read = field.read, make = kind.make](const void*) { return read(dynamic_cast<void*>(make().get())); };
    if (field.enter)
        row.enter = [enter = field.enter, own = std::shared_ptr<Base>(kind.make())](void*, const core::Source& source) {
            return enter(dynamic_cast<void*>(own.get()), source);
        };
    return row;
}

// The keys of all kinds, each once, and before the key that follows it where it first occurs. variantsOf(kind, field):
// the variants of the section that have a kind's field.
template <class Base, class VariantsOf>
std::vector<fields::Field> mergedRows(std::span<const world::Kind<Base>> kinds, const VariantsOf& variantsOf) {
    std::vector<fields::Field> rows;
    std::set<std::string> variants;
    const auto find = [&](const std::string& key) {
        return std::find_if(rows.begin(), rows.end(), [&](const fields::Field& row) { return row.key == key; });
    };
    for (const auto& kind : kinds) {
        auto next = rows.end();
        const std::vector<fields::Field>& own = kind.section.fields;
        for (auto field = own.rbegin(); field != own.rend(); ++field) {
            auto row = find(field->key);
            if (row == rows.end())
                row = rows.insert(next, shown(*field, kind));
            else
                merge(*row, *field);
            for (const std::string& variant : variantsOf(kind, *field)) {
                row->only.push_back(variant);
                variants.insert(variant);
            }
            next = row;
        }
    }
    for (fields::Field& row : rows)
        if (row.only.size() == variants.size()) row.only.clear();
    return rows;
}

}  // namespace taut::scene
