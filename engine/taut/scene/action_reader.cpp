#include "taut/scene/action_reader.h"

#include "taut/core/error.h"
#include "taut/fields/private/value_reader.h"
#include "taut/scene/private/body_index.h"
#include "taut/scene/private/document.h"
#include "taut/scene/private/ramp_key.h"
#include "taut/scene/private/scene_reader.h"

namespace taut::scene {
namespace {

[[noreturn]] void fail(const Problems& problems) {
    throw core::Error(core::ErrorKind::badContent, problems.errors());
}

// A document with that action only.
Node documentOf(const std::string& table, double t, Problems& problems) {
    Node root;
    try {
        root = documentTree("schema = 1\nat = [" + table + "]", 1);
    } catch (const SyntaxError& error) {
        problems.addError({1, 0, 0}, error.what(), error.remedy);
        fail(problems);
    }
    Member* list = root.find("at");
    if (list == nullptr || list->value.items.size() != 1) problems.addError({1, 0, 0}, "it must be one action");
    if (problems.errorCount() > 0) fail(problems);
    Node& action = list->value.items.front();
    if (const Member* moment = action.find("t"))
        problems.addError(moment->place, "an action that is applied happens now", "leave t out");
    Node now;
    now.kind = NodeKind::number;
    now.place = action.place;
    now.number = t;
    if (action.find("t") == nullptr) action.members.push_back({"t", action.place, now});
    return root;
}

}  // namespace

std::unique_ptr<world::ActionSpec> ActionReader::read(const std::string& table, double t, const std::string& label,
                                                      const world::SceneSpec& spec) const {
    Problems problems("", label, {label});
    const Node document = documentOf(table, t, problems);
    const std::vector<SceneSection> sections = sceneSections(kinds_);
    ReadScene scene = readScene(document, sections, label, problems);
    if (problems.errorCount() > 0) fail(problems);
    world::ActionSpec& action = scene.spec.actions[0];
    const Node& item = document.at("at")->items.front();
    const BodyIndex bodies(spec, kinds_, {});
    const auto report = [&](const char* key, const std::optional<TargetFault>& fault) {
        if (fault) problems.addError(item.at(key)->place, fault->message, fault->remedy);
    };
    if (const auto* onPoints = dynamic_cast<const world::PointsAction*>(&action))
        report("target", bodies.targetFault(onPoints->target));
    if (const auto* cut = dynamic_cast<const world::CutAction*>(&action))
        report("target", bodies.bodyFault(cut->target));
    if (const auto* spawn = dynamic_cast<const world::SpawnAction*>(&action))
        report("target", bodies.bodyFault(spawn->target));
    if (auto* change = dynamic_cast<world::RampAction*>(&action)) {
        TargetFault fault;
        world::SceneSpec copy = spec;
        const std::optional<RampKey> key = rampKey(change->key, root_, sections, copy, fault);
        if (!key) report("key", fault);
        const std::optional<Value> value = key ? fieldValue(*key->field, *item.at("to"), problems) : std::nullopt;
        if (value) {
            change->field = key->access;
            if (const double* number = std::get_if<double>(&*value)) change->value = {*number};
            if (const auto* numbers = std::get_if<std::vector<double>>(&*value)) change->value = *numbers;
        }
    }
    if (problems.errorCount() > 0) fail(problems);
    return action.copy();
}

world::RampAction ActionReader::ramp(const std::string& key, const world::SceneSpec& spec) const {
    TargetFault fault;
    world::SceneSpec copy = spec;
    const std::optional<RampKey> found = rampKey(key, root_, sceneSections(kinds_), copy, fault);
    if (!found) throw core::Error(core::ErrorKind::badContent, fault.message);
    world::RampAction action;
    action.key = key;
    action.field = found->access;
    return action;
}

std::vector<Rampable> ActionReader::rampable(const world::SceneSpec& spec) const {
    const std::vector<SceneSection> sections = sceneSections(kinds_);
    world::SceneSpec copy = spec;
    std::vector<Rampable> all;
    for (const std::string& key : rampableKeys(sections, root_)) {
        TargetFault fault;
        if (const std::optional<RampKey> found = rampKey(key, root_, sections, copy, fault))
            all.push_back({key, found->field->unit, found->field->range, found->access->read(spec)});
    }
    return all;
}

}  // namespace taut::scene
