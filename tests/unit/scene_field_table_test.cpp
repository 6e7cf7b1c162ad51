// The field table as a whole: complete, with the defaults of the structs, and the source of schema and manual.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "taut/bodies/rope.h"
#include "taut/scene/private/document.h"
#include "taut/scene/private/sections.h"
#include "unit/scene_full_text.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

std::vector<SceneSection> allSections() {
    std::vector<SceneSection> sections = sceneSections(world::builtIn());
    std::erase_if(sections, [](const Section& section) { return section.name == "defaults"; });  // rows of the others
    return sections;
}

// Calls visit(path, section, field) for every field, e.g. with "collider.parts.shape".
template <class Visit>
void visitFields(const Section& section, const std::string& path, const Visit& visit) {
    for (const Field& field : section.fields) {
        const std::string here = path.empty() ? field.key : path + "." + field.key;
        visit(here, section, field);
        if (!field.inside.empty()) visitFields(field.inside.front(), here, visit);
    }
}

template <class Visit>
void visitFields(const Visit& visit) {
    for (const SceneSection& section : allSections()) visitFields(section, section.name, visit);
}

// Paths of all keys in a document, without names of bodies and numbers of elements.
void collectPaths(const Node& node, const std::string& path, bool isNamed, std::set<std::string>& paths) {
    for (const Node& item : node.items) collectPaths(item, path, false, paths);
    for (const Member& member : node.members) {
        const std::string here = isNamed ? path : path.empty() ? member.key : path + "." + member.key;
        paths.insert(here);
        bool holdsNames = false;
        if (path.empty())
            for (const SceneSection& section : allSections())
                holdsNames = holdsNames || (section.name == member.key && section.layout == Layout::named);
        collectPaths(member.value, here, holdsNames, paths);
    }
}

// The common keys of bodies are tried on a cloth there, and on the others by SceneFields.
std::string standIn(const std::string& path) {
    for (const std::string_view part : {"collider.parts.finish", "solid.parts.finish"})
        if (path.starts_with(part)) return "cloth.finish" + path.substr(part.size());
    const std::string rest = path.substr(path.find('.') + 1);
    const std::string key = rest.substr(0, rest.find('.'));
    for (const char* common : {"hold", "clamp", "hold_on", "velocity", "spin_rad_per_s", "jitter_m", "seed", "friction",
                               "restitution", "thickness", "collide", "touch", "finish", "solver", "array"})
        if (key == common && !path.starts_with("wind.")) return "cloth." + rest;
    return path;
}

TEST(SceneFieldTable, TheFullSceneGivesEveryField) {
    std::set<std::string> given;
    collectPaths(documentTree(fullScene, 0), "", false, given);
    given.insert("scene");  // names another file: see SceneMerge
    visitFields([&](const std::string& path, const Section&, const Field&) {
        // Before anything is read: see SceneInheritance.
        const bool isTakenOver = path.ends_with(".like") || path.starts_with("material.cloth");
        EXPECT_TRUE(isTakenOver || given.contains(path) || given.contains(standIn(path)))
            << path << " is not tried out by the full scene";
    });
}

TEST(SceneFieldTable, EveryFieldHasAHelpAndAnUnambiguousKey) {
    visitFields([&](const std::string& path, const Section& section, const Field& field) {
        EXPECT_GE(field.help.size(), 5U) << path;
        EXPECT_TRUE(field.help.ends_with('.')) << path;
        EXPECT_EQ(section.find(field.key), &field) << path << " stands in the table twice";
    });
}

// A struct filled from the table's defaults is the fresh struct: reading is the inverse of writing, and
// schema and manual state the defaults of a scene. One rounding of a degree is allowed.
void expectDefaultsRestore(const Section& section, void* fresh, const std::string& path) {
    for (const Field& field : section.fields) {
        const std::string here = path + "." + field.key;
        if (!field.inside.empty()) {
            expectDefaultsRestore(field.inside.front(), field.enter(fresh, {}), here);
            continue;
        }
        const Value value = field.read(fresh);
        if (value.index() == 0) continue;
        field.write(fresh, value);
        const Value again = field.read(fresh);
        if (const auto* number = std::get_if<double>(&value))
            EXPECT_NEAR(std::get<double>(again), *number, 1e-12) << here;
        else if (const auto* numbers = std::get_if<std::vector<double>>(&value))
            for (std::size_t i = 0; i < numbers->size(); ++i)
                EXPECT_NEAR(std::get<std::vector<double>>(again)[i], (*numbers)[i], 1e-12) << here;
        else
            EXPECT_EQ(again, value) << here;
    }
}

TEST(SceneFieldTable, WritingADefaultChangesNothing) {
    world::SceneSpec scene;
    for (const SceneSection& section : allSections()) {
        expectDefaultsRestore(section, section.enter(scene, "name", {}), section.name);
        for (const Section& form : section.forms)
            expectDefaultsRestore(form, section.enter(scene, form.name, {}), form.name);
    }
}

TEST(SceneFieldTable, DefaultsLieInTheirOwnRange) {
    world::SceneSpec scene;
    const auto check = [](const auto& self, const Section& section, void* target, const std::string& path) -> void {
        for (const Field& field : section.fields) {
            const std::string here = path + "." + field.key;
            if (!field.inside.empty()) {
                self(self, field.inside.front(), field.enter(target, {}), here);
                continue;
            }
            const Value value = field.read(target);
            std::vector<double> numbers;
            if (const auto* number = std::get_if<double>(&value)) numbers = {*number};
            if (const auto* whole = std::get_if<std::int64_t>(&value)) numbers = {static_cast<double>(*whole)};
            if (const auto* list = std::get_if<std::vector<double>>(&value)) numbers = *list;
            for (const double number : numbers) {
                EXPECT_GE(number, field.range.low) << here;
                EXPECT_LE(number, field.range.high) << here;
            }
            if (field.kind == FieldKind::choice && value.index() != 0) {
                const auto& text = std::get<std::string>(value);
                EXPECT_NE(std::find(field.choices.begin(), field.choices.end(), text), field.choices.end()) << here;
            }
        }
    };
    for (const SceneSection& section : allSections())
        check(check, section, section.enter(scene, "name", {}), section.name);
}

TEST(SceneFieldTable, AMinimalSceneHasTheDefaultsOfTheStructs) {
    const AssetFolder folder;
    const world::SceneSpec scene =
        folder.load("schema = 1\n[material.m]\n[rope.r]\nends = [[0, 0, 0], [1, 0, 0]]\n[camera.c]\n").spec;
    EXPECT_EQ(scene.solver.integrator, world::SolverSpec().integrator);
    EXPECT_EQ(scene.solver.dt, std::nullopt);
    EXPECT_EQ(scene.world.gravity, world::WorldSpec().gravity);
    EXPECT_EQ(scene.materials.at("m").stretch, world::MaterialSpec().stretch);
    EXPECT_EQ(scene.materials.at("m").shear, std::nullopt);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].stretch, world::RopeSpec().stretch);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].finish.colour, world::FinishSpec().colour);
    EXPECT_EQ(scene.bodies.of<world::RopeSpec>()[0].array.count, world::ArraySpec().count);
    EXPECT_EQ(scene.cameras[0].fieldOfView, world::CameraSpec().fieldOfView);
    EXPECT_EQ(scene.light.softness, world::LightSpec().softness);
    EXPECT_EQ(scene.need.horizon, std::nullopt);
}

// The part of the schema that describes a path such as "collider.parts.shape".
const nlohmann::json* schemaOf(const nlohmann::json& root, const std::string& path) {
    const nlohmann::json* node = &root;
    std::string rest = path;
    while (!rest.empty()) {
        const std::string key = rest.substr(0, rest.find('.'));
        rest = rest.find('.') == std::string::npos ? "" : rest.substr(rest.find('.') + 1);
        if (node->contains("patternProperties")) node = &node->at("patternProperties").begin().value();
        if (node->contains("items")) node = &node->at("items");
        if (node->contains("anyOf")) node = &node->at("anyOf").back();  // a number or a table
        if (!node->contains("properties") || !node->at("properties").contains(key)) return nullptr;
        node = &node->at("properties").at(key);
    }
    return node;
}

TEST(SceneSchema, ListsEveryFieldWithItsHelpAndDefault) {
    const nlohmann::json root = nlohmann::json::parse(jsonSchema());
    EXPECT_EQ(root.at("$schema"), "https://json-schema.org/draft/2020-12/schema");
    visitFields([&](const std::string& path, const Section&, const Field& field) {
        const nlohmann::json* schema = schemaOf(root, path);
        ASSERT_NE(schema, nullptr) << path;
        EXPECT_TRUE(schema->at("description").get<std::string>().starts_with(field.help)) << path;
    });
    EXPECT_EQ(root.at("required"), nlohmann::json({"schema"}));
    EXPECT_EQ(schemaOf(root, "solver.safety")->at("default"), 0.9);
    EXPECT_EQ(schemaOf(root, "cloth.cells")->at("default"), nlohmann::json({20, 20}));
    EXPECT_EQ(schemaOf(root, "rope.segments")->at("minimum"), 1);
    EXPECT_EQ(schemaOf(root, "picture.samples")->at("enum"), nlohmann::json({1, 4, 8, 16}));
    EXPECT_EQ(schemaOf(root, "picture.shadow_size")->at("multipleOf"), 128);
    EXPECT_EQ(schemaOf(root, "joint.kind")->at("enum"), nlohmann::json({"weld", "spring", "rod", "hinge", "ball", "slider"}));
    EXPECT_FALSE(schemaOf(root, "need.horizon_s")->contains("default"));
}

TEST(SceneManual, SaysTheKeysOfATableOnce) {
    const std::string text = manual();
    const auto count = [&](const std::string& line) {
        int times = 0;
        for (std::size_t at = text.find(line); at != std::string::npos; at = text.find(line, at + 1)) ++times;
        return times;
    };
    EXPECT_EQ(count("\n  cg_tolerance "), 1);
    EXPECT_EQ(count("\n    cg_tolerance "), 0);  // of the solver of bodies
    EXPECT_GT(count("\n  solver "), 3);
    EXPECT_EQ(count("Solver settings of this body. As in [solver]. Its keys: integrator, "), 1);
    EXPECT_EQ(count("\n    roughness "), 1);  // of finish
    EXPECT_GE(count("Its keys are those in [cloth.NAME]."), count("\n  solver ") - 1 + count("\n  finish ") - 1);
}

TEST(SceneManual, ListsEverySectionAndField) {
    const std::string text = manual();
    for (const SceneSection& section : allSections())
        EXPECT_NE(text.find(section.help), std::string::npos) << section.name;
    visitFields([&](const std::string& path, const Section&, const Field& field) {
        EXPECT_NE(text.find(" " + field.key + " "), std::string::npos) << path;
        EXPECT_NE(text.find(field.help), std::string::npos) << path;
    });
    EXPECT_NE(text.find("A longer rope starts on its catenary."), std::string::npos);
    EXPECT_NE(text.find("safety                   a number, between 0.01 and 1; default 0.9\n"), std::string::npos);
}

}  // namespace
}  // namespace taut::scene
