#include "taut/spec/targets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>

#include "taut/core/numbers.h"

namespace taut::world {
namespace {

std::vector<int> onePoint(const mechanics::Model& model, double index) {
    if (index >= model.pointCount()) return {};
    return {static_cast<int>(index)};
}

std::vector<int> gridPoints(const mechanics::Model& model, const GridPlace& place) {
    if (model.grid[0] == 0) return {};
    const auto& [u, v, radius] = place;
    const int column = static_cast<int>(std::floor(u * model.grid[0] + 0.5));
    const int row = static_cast<int>(std::floor(v * model.grid[1] + 0.5));
    const int nearest = row * (model.grid[0] + 1) + column;
    const glm::dvec2 middle = glm::dvec2(u, v) * model.uv.back();
    std::vector<int> points;
    for (const int i : model.groups.at("all"))
        if (i == nearest || glm::distance(model.uv[i], middle) <= radius) points.push_back(i);
    return points;
}

// The points that all groups of a selector have.
std::vector<int> commonPoints(const mechanics::Model& model, std::string_view selector) {
    std::optional<std::vector<int>> common;
    for (const std::string& name :
         commonGroups(selector, [&](const auto& own) { return model.groups.contains(own); })) {
        std::vector<int> points = model.groups.at(name), both;
        std::sort(points.begin(), points.end());
        if (common) {
            std::set_intersection(common->begin(), common->end(), points.begin(), points.end(),
                                  std::back_inserter(both));
            points = std::move(both);
        }
        common = std::move(points);
    }
    return common.value_or(std::vector<int>());
}

}  // namespace

std::optional<GridPlace> gridPlace(std::string_view selector) {
    if (!selector.starts_with('(') || !selector.ends_with(')')) return std::nullopt;
    std::vector<double> numbers;
    for (const std::string_view cell : core::cellsOf(selector.substr(1, selector.size() - 2)))
        numbers.push_back(core::numberIn(cell).value_or(-1));
    if (numbers.size() == 2) numbers.push_back(0);
    if (numbers.size() != 3 || *std::min_element(numbers.begin(), numbers.end()) < 0 || numbers[0] > 1 ||
        numbers[1] > 1)
        return std::nullopt;
    return GridPlace{numbers[0], numbers[1], numbers[2]};
}

std::optional<double> ropePlace(std::string_view selector) {
    if (!selector.ends_with('%')) return std::nullopt;
    const std::optional<double> percent = core::numberIn(selector.substr(0, selector.size() - 1));
    return percent && *percent >= 0 && *percent <= 100 ? std::optional(*percent / 100) : std::nullopt;
}

std::optional<double> pointNumber(std::string_view selector) {
    if (!selector.starts_with('#') || selector.find_first_not_of("0123456789", 1) != std::string_view::npos)
        return std::nullopt;
    return core::numberIn(selector.substr(1));
}

std::string_view withoutSelector(std::string_view target) {
    return target.substr(0, target.find('@'));
}

Target parseTarget(std::string_view text) {
    const std::string_view title = withoutSelector(text);
    const std::size_t dot = title.find('.');
    Target target;
    target.kind = title.substr(0, dot);
    if (dot != std::string_view::npos) target.name = title.substr(dot + 1);
    if (title.size() < text.size()) target.selector = text.substr(title.size() + 1);
    return target;
}

ColliderTarget parseCollider(std::string_view text) {
    const std::size_t name = std::min(text.find('.'), text.size() - 1) + 1;
    const std::size_t end = std::min(text.find_first_of(".#", name), text.size());
    ColliderTarget target{std::string(text.substr(0, end)), ""};
    const std::string_view part = text.substr(end);
    if (part.starts_with('#')) target.face = static_cast<int>(core::numberIn(part.substr(1)).value_or(-1));
    if (part.starts_with('.')) target.joint = part.substr(1);
    if (target.joint.size() > 1 && target.joint.front() == '"' && target.joint.back() == '"')
        target.joint = target.joint.substr(1, target.joint.size() - 2);
    return target;
}

std::vector<std::string> commonGroups(std::string_view selector,
                                      const std::function<bool(const std::string&)>& isGroup) {
    std::vector<std::string> groups;
    std::string part;
    while (!selector.empty()) {
        const std::size_t end = std::min(selector.find('-'), selector.size());
        const std::string word(selector.substr(0, end));
        selector.remove_prefix(std::min(end + 1, selector.size()));
        groups.push_back(part + word);
        if (!isGroup(groups.back())) return {};
        if (word.starts_with("part")) part = word + "-";
    }
    return groups;
}

std::vector<int> selectPoints(const mechanics::Model& model, std::string_view selector) {
    if (selector.starts_with('@')) selector.remove_prefix(1);
    if (selector.empty()) selector = "all";
    if (const auto group = model.groups.find(std::string(selector)); group != model.groups.end()) return group->second;
    if (const auto number = pointNumber(selector)) return onePoint(model, *number);
    if (const auto place = gridPlace(selector)) return gridPoints(model, *place);
    if (const auto place = ropePlace(selector))
        return onePoint(model, std::floor(*place * (model.pointCount() - 1) + 0.5));
    return commonPoints(model, selector);
}

}  // namespace taut::world
