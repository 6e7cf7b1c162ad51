#include "taut/scene/private/fit_keys.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/scene/private/body_index.h"
#include "taut/scene/private/fabrics.h"

namespace taut::scene {

namespace {

constexpr std::size_t mostKeys = 6;

// The row of a number; null for one that no row speaks of.
const Field* rowOf(const std::vector<std::string>& parts, const std::vector<SceneSection>& sections) {
    const Section* in = nullptr;
    for (const SceneSection& section : sections)
        if (!section.name.empty() && section.name == parts.front()) in = &section;
    if (in == nullptr) return nullptr;
    const Field* row = nullptr;
    for (std::size_t i = in->layout == Layout::table ? 1 : 2; i < parts.size(); ++i) {
        if (row != nullptr && row->kind == FieldKind::tables) ++i;  // the number of an element
        if (row != nullptr && row->inside.empty()) return row;      // a component
        row = i < parts.size() ? in->find(parts[i]) : nullptr;
        if (row == nullptr) return nullptr;
        if (!row->inside.empty()) in = &row->inside.front();
    }
    return row != nullptr && row->kind == FieldKind::table ? in->find(in->alone) : row;
}

// The number that a key leads to, or nothing with a fault.
const Node* numberAt(const Node& root, const std::string& key, TargetFault& fault) {
    const Node* node = &root;
    std::string path;
    for (const std::string& part : fields::keyPath(key)) {
        const Node* next = node->at(part);
        if (next == nullptr) {
            fault = {path.empty() ? fmt::format("the scene has no \"{}\"", part)
                                  : fmt::format("{} has no \"{}\" to begin from", path, part),
                     suggestion(part, node->keys())};
            if (fault.remedy.empty() && !path.empty()) fault.remedy = "give it a value in the scene";
            return nullptr;
        }
        node = next;
        path += (path.empty() ? "" : ".") + part;
        if (isFabric(part)) {
            fault = {fmt::format("{} is of the library, and the same for all scenes", path),
                     fmt::format("give a [material.NAME] like = \"{}\"", part)};
            return nullptr;
        }
    }
    if (node->kind == NodeKind::number || node->kind == NodeKind::whole) return node;
    fault = {fmt::format("{} is {}, not a number", key, description(*node)), ""};
    if (!node->items.empty()) fault.remedy = fmt::format("name one of its numbers, {}.0", key);
    if (!node->members.empty()) fault.remedy = fmt::format("name one of its keys, {}.{}", key, node->members[0].key);
    return nullptr;
}

// The value of a list that may be written as one number.
Place placeOf(const Node& list, std::size_t i) {
    return list.kind == NodeKind::list ? list.items[i].place : list.place;
}

}  // namespace

void checkFitKeys(const Node& root, const std::vector<SceneSection>& sections, ReadScene& scene, Problems& problems) {
    const Member* member = root.find("fit");
    if (member == nullptr || scene.faulty.contains("fit")) return;
    const Node& table = member->value;
    world::FitSpec& fit = scene.spec.fit;
    const Node& keys = *table.at("keys");
    if (fit.keys.empty() || fit.keys.size() > mostKeys)
        return problems.addError(keys.place,
                                 fmt::format("a fit has 1 to {} numbers, not {}", mostKeys, fit.keys.size()));
    if (fit.targets.empty())
        problems.addError(member->place, "[fit] has no targets", "add [[fit.target]] with that, at, value and sigma");
    for (const auto& [bound, values] : {std::pair("low", &fit.low), std::pair("high", &fit.high)})
        if (values->size() != fit.keys.size())
            return problems.addError(
                table.at(bound)->place,
                fmt::format("there are {} keys and {} numbers here", fit.keys.size(), values->size()),
                fmt::format("write one for each key"));
    for (std::size_t i = 0; i < fit.keys.size(); ++i) {
        const std::string& key = fit.keys[i];
        const Place place = keys.items[i].place;
        if (std::find(fit.keys.begin(), fit.keys.end(), key) != fit.keys.begin() + static_cast<std::ptrdiff_t>(i)) {
            problems.addError(place, fmt::format("{} is there twice", key));
            continue;
        }
        TargetFault fault;
        const Node* number = numberAt(root, key, fault);
        if (number == nullptr) {
            problems.addError(place, fault.message, fault.remedy);
            continue;
        }
        const Field* row = rowOf(fields::keyPath(key), sections);
        if (row != nullptr && (row->kind == FieldKind::whole || row->kind == FieldKind::wholeVector)) {
            problems.addError(place, fmt::format("{} is a whole number, which cannot be fitted", key));
            continue;
        }
        fit.start.push_back(number->number);
        const double low = fit.low[i], high = fit.high[i];
        const Place lowPlace = placeOf(*table.at("low"), i), highPlace = placeOf(*table.at("high"), i);
        const Range range = row != nullptr ? row->range : anyNumber;
        if (!(low < high))
            problems.addError(lowPlace, fmt::format("low of {} is {:g}, high is {:g}", key, low, high),
                              "low must be less");
        else if (low < range.low || high > range.high)
            problems.addError(low < range.low ? lowPlace : highPlace,
                              fmt::format("{} must be {}", key, description(range, row->unit)));
        else if (number->number < low || number->number > high)
            problems.addError(number->place,
                              fmt::format("{} is {:g}, outside of the bounds of [fit], {:g} and {:g}", key,
                                          number->number, low, high),
                              "begin within them");
    }
}

}  // namespace taut::scene
