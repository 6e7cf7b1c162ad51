// The JSON schema, made from the field table.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "taut/scene/load.h"
#include "taut/scene/private/sections.h"

namespace taut::scene {

namespace {

using Json = nlohmann::ordered_json;

Json tableSchema(const Section& section, void* target);

Json numberSchema(const Field& field, bool isWhole) {
    Json schema{{"type", isWhole ? "integer" : "number"}};
    schema["minimum"] = field.range.low;
    schema["maximum"] = field.range.high;
    if (isWhole) {
        schema["minimum"] = static_cast<std::int64_t>(field.range.low);
        schema["maximum"] = static_cast<std::int64_t>(field.range.high);
    }
    return schema;
}

Json wholeSchema(const Field& field) {
    if (!field.values.empty()) return {{"enum", field.values}};
    Json schema = numberSchema(field, true);
    if (field.multipleOf > 1) schema["multipleOf"] = field.multipleOf;
    return schema;
}

Json listSchema(const Json& items, int count) {
    return {{"type", "array"}, {"items", items}, {"minItems", count}, {"maxItems", count}};
}

Json valueSchema(const Field& field) {
    switch (field.kind) {
        case FieldKind::number: return numberSchema(field, false);
        case FieldKind::whole: return wholeSchema(field);
        case FieldKind::flag: return {{"type", "boolean"}};
        case FieldKind::flagOrChoice: {
            Json values = {true, false};
            for (const std::string& choice : field.choices) values.push_back(choice);
            return {{"enum", values}};
        }
        case FieldKind::text: return {{"type", "string"}};
        case FieldKind::choice: return {{"enum", field.choices}};
        case FieldKind::stepLength: return {{"anyOf", {{{"const", "auto"}}, numberSchema(field, false)}}};
        case FieldKind::vector:
        case FieldKind::direction: return listSchema(numberSchema(field, false), field.components);
        case FieldKind::wholeVector: return listSchema(numberSchema(field, true), field.components);
        case FieldKind::colour:
            return {
                {"anyOf",
                 {listSchema(numberSchema(field, false), 3), {{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}}}}};
        case FieldKind::segment: return listSchema(listSchema(numberSchema(field, false), field.components), 2);
        case FieldKind::places:
            return {{"type", "array"}, {"items", listSchema(numberSchema(field, false), field.components)}};
        case FieldKind::texts: return {{"type", "array"}, {"items", {{"type", "string"}}}};
        case FieldKind::oneOrMoreTexts:
            return {{"anyOf",
                     {{{"type", "string"}}, {{"type", "array"}, {"items", {{"type", "string"}}}, {"minItems", 1}}}}};
        case FieldKind::wholes: return {{"type", "array"}, {"items", numberSchema(field, true)}};
        case FieldKind::numbers:
            return {{"anyOf",
                     {{{"type", "number"}},
                      {{"type", "array"}, {"items", {{"type", "number"}}}},
                      {{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}}}}};
        case FieldKind::table:
        case FieldKind::tables: break;
    }
    return {};
}

Json defaultJson(const Field& field, const Value& value) {
    if (const bool* flag = std::get_if<bool>(&value)) return *flag;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
    if (const double* number = std::get_if<double>(&value)) return *number;
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return *texts;
    const auto& numbers = std::get<std::vector<double>>(value);
    Json list = Json::array();
    for (const double number : numbers)
        if (field.kind == FieldKind::wholeVector || field.kind == FieldKind::wholes)
            list.push_back(static_cast<std::int64_t>(number));
        else
            list.push_back(number);
    return list;
}

Json fieldSchema(const Field& field, void* target) {
    Json schema;
    if (field.inside.empty()) {
        schema = valueSchema(field);
        const Value value = field.read(target);
        if (!field.required && value.index() != 0) schema["default"] = defaultJson(field, value);
    } else {
        const Json table = tableSchema(field.inside.front(), field.enter(target, {}));
        schema = field.kind == FieldKind::table ? table : Json{{"type", "array"}, {"items", table}};
        if (const Field* alone = field.inside.front().find(field.inside.front().alone))
            schema = {{"anyOf", {numberSchema(*alone, false), table}}};
    }
    std::string help = field.help;
    if (!field.unit.empty()) help += fmt::format(" [{}]", field.unit);
    if (!field.only.empty()) help += fmt::format(" Only for {}.", fmt::join(field.only, ", "));
    schema["description"] = help;
    return schema;
}

Json tableSchema(const Section& section, void* target) {
    Json properties = Json::object();
    Json required = Json::array();
    for (const Field& field : section.fields) {
        properties[field.key] = fieldSchema(field, target);
        if (field.required && field.only.empty()) required.push_back(field.key);
    }
    Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) schema["required"] = required;
    return schema;
}

}  // namespace

std::string jsonSchema(const world::Kinds& kinds) {
    Json root{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "taut scene"}};
    Json properties = Json::object();
    world::SceneSpec scene;
    for (const SceneSection& section : sceneSections(kinds)) {
        const Json table = tableSchema(section, section.enter(scene, "name", {}));
        if (section.name.empty()) {
            for (const auto& [key, value] : table["properties"].items()) properties[key] = value;
            root["required"] = table["required"];
            continue;
        }
        Json schema = table;
        if (section.layout == Layout::named) {
            schema = {{"type", "object"},
                      {"patternProperties", {{"^[A-Za-z0-9_-]+$", table}}},
                      {"additionalProperties", false}};
        } else if (section.layout == Layout::list) {
            schema = {{"type", "array"}, {"items", table}};
        }
        schema["description"] = section.help;
        properties[section.name] = schema;
    }
    root["type"] = "object";
    root["properties"] = properties;
    root["additionalProperties"] = false;
    return root.dump(2);
}

}  // namespace taut::scene
