#include "taut/scene/state_keys.h"

#include <algorithm>
#include <string_view>

#include "taut/core/private/hash.h"
#include "taut/scene/private/document.h"
#include "taut/spec/actions.h"
#include "taut/spec/spec.h"
#include "taut/spec/ticks.h"

namespace taut::scene {
namespace {

// Sections that only a picture shows, and keys of bodies and colliders.
constexpr std::string_view picturesOnly[] = {"picture",     "camera",     "light", "lamp",
                                             "environment", "background", "label"};
// The values in a material for cloth are in each cloth by now.
constexpr std::string_view finishOnly[] = {"finish", "visible", "edge", "ball", "cloth"};
// Sections that change nothing before their time, or nothing at all. For files that are named the content counts.
constexpr std::string_view neither[] = {"schema", "title", "scene", "defaults", "need", "fit", "check", "golden", "at"};

template <std::size_t n>
bool isOneOf(std::string_view key, const std::string_view (&keys)[n]) {
    return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

void add(const Node& node, core::Hash& hash);

// Members sorted by name, as layout is not content.
std::vector<const Member*> sorted(const Node& table) {
    std::vector<const Member*> members;
    for (const Member& member : table.members) members.push_back(&member);
    std::sort(members.begin(), members.end(), [](const Member* a, const Member* b) { return a->key < b->key; });
    return members;
}

void add(const Member& member, core::Hash& hash) {
    hash.add(member.key);
    add(member.value, hash);
}

void add(const Node& node, core::Hash& hash) {
    const bool isNumber = node.kind == NodeKind::whole || node.kind == NodeKind::number;  // 1 and 1.0 are the same
    hash.add(static_cast<std::uint64_t>(isNumber ? NodeKind::number : node.kind));
    if (isNumber) hash.add(node.number);
    hash.add(static_cast<std::uint64_t>(node.flag));
    hash.add(node.text);
    hash.add(static_cast<std::uint64_t>(node.items.size()));
    for (const Node& item : node.items) add(item, hash);
    hash.add(static_cast<std::uint64_t>(node.members.size()));
    for (const Member* member : sorted(node)) add(*member, hash);
}

void add(const world::MeshData* mesh, core::Hash& hash) {
    if (mesh == nullptr) return;
    if (mesh->figure != nullptr) hash.add(mesh->hash);
    for (const world::dvec3& p : mesh->positions)
        for (int i = 0; i < 3; ++i) hash.add(p[i]);
    for (const world::dvec2& uv : mesh->uv)
        for (int i = 0; i < 2; ++i) hash.add(uv[i]);
    for (const auto& triangle : mesh->triangles)
        for (int i : triangle) hash.add(static_cast<std::uint64_t>(i));
    for (const auto& [name, vertices] : mesh->groups) {
        hash.add(name);
        for (int i : vertices) hash.add(static_cast<std::uint64_t>(i));
    }
}

// Adds a named body or collider: its looks to the picture, the rest to the state.
void addThing(const Member& thing, core::Hash& state, core::Hash& picture) {
    state.add(thing.key);
    picture.add(thing.key);
    for (const Member* member : sorted(thing.value)) add(*member, isOneOf(member->key, finishOnly) ? picture : state);
}

void addSection(const Member& section, core::Hash& state, core::Hash& picture) {
    if (isOneOf(section.key, neither)) return;
    if (isOneOf(section.key, picturesOnly)) return add(section, picture);
    state.add(section.key);
    for (const Member* member : sorted(section.value)) {
        if (section.key == "run" && (member->key == "seconds" || member->key == "start")) continue;
        if (member->value.kind == NodeKind::table)
            addThing(*member, state, picture);
        else
            add(*member, state);
    }
    for (const Node& item : section.value.items) add(item, state);  // of joints and masses
}

double timeOf(const Node& action) {
    const Node* t = action.at("t");
    return t != nullptr ? t->number : 0.0;
}

}  // namespace

StateKeys::StateKeys(const Node& root, const world::SceneSpec& spec) {
    core::Hash state, picture;
    for (const Member* section : sorted(root)) addSection(*section, state, picture);
    if (spec.run.startState != nullptr) {
        state.add(static_cast<std::uint64_t>(spec.run.startState->tick));
        state.add(std::string_view(reinterpret_cast<const char*>(spec.run.startState->bytes.data()),
                                   spec.run.startState->bytes.size()));
    }
    for (const world::BodySpec& body : spec.bodies)
        for (const world::BodySpec* shape : body.shapes())
            if (const world::MeshSource* source = shape->meshSource()) add(source->meshData.get(), state);
    for (const world::ColliderSpec& collider : spec.colliders) {
        add(collider.meshData.get(), state);
        for (const world::ColliderSpec& part : collider.parts) add(part.meshData.get(), state);
    }
    const Node* at = root.at("at");
    if (at != nullptr) {
        const world::Ticks ticks(spec.run);
        for (const Node& action : at->items) {
            core::Hash hash;
            add(action, hash);
            actions_.emplace_back(ticks.at(timeOf(action)), hash.value());
        }
        std::stable_sort(actions_.begin(), actions_.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
    }
    // A body that is spawned later is not there from the start.
    world::foreseen<world::SpawnAction>(spec.actions,
                                        [&](const world::SpawnAction& spawn) { state.add(spawn.target); });
    scene_ = state.value();
    picture_ = picture.value();
}

std::uint64_t StateKeys::stateAt(std::int64_t tick) const {
    core::Hash hash;
    hash.add(scene_);
    for (const auto& [when, what] : actions_) {
        if (when >= tick) break;
        hash.add(static_cast<std::uint64_t>(when));
        hash.add(what);
    }
    return hash.value();
}

}  // namespace taut::scene
