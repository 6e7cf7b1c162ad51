#include "taut/spec/targets.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace taut::world {
namespace {

std::optional<double> number(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::vector<int> onePoint(const mechanics::Model& model, double index) {
    if (!(index >= 0.0) || index >= model.pointCount()) return {};
    return {static_cast<int>(index)};
}

std::vector<int> gridPoints(const mechanics::Model& model, std::string_view inside) {
    const std::size_t comma = inside.find(',');
    if (comma == std::string_view::npos || model.grid[0] == 0) return {};
    const std::size_t second = std::min(inside.find(',', comma + 1), inside.size());
    const auto u = number(inside.substr(0, comma)), v = number(inside.substr(comma + 1, second - comma - 1)),
               r = second < inside.size() ? number(inside.substr(second + 1)) : 0.0;
    if (!u || !v || !r || !(*u >= 0 && *u <= 1 && *v >= 0 && *v <= 1)) return {};
    const int column = static_cast<int>(std::floor(*u * model.grid[0] + 0.5));
    const int row = static_cast<int>(std::floor(*v * model.grid[1] + 0.5));
    const int nearest = row * (model.grid[0] + 1) + column;
    const glm::dvec2 middle = glm::dvec2(*u, *v) * model.uv.back();
    std::vector<int> points;
    for (const int i : model.groups.at("all"))
        if (i == nearest || glm::distance(model.uv[static_cast<std::size_t>(i)], middle) <= *r) points.push_back(i);
    return points;
}

}  // namespace

Target parseTarget(std::string_view text) {
    const std::size_t dot = text.find('.'), at = text.find('@');
    Target target;
    target.kind = text.substr(0, dot);
    if (dot != std::string_view::npos)
        target.name = text.substr(dot + 1, at == std::string_view::npos ? at : at - dot - 1);
    if (at != std::string_view::npos) target.selector = text.substr(at + 1);
    return target;
}

std::vector<int> selectPoints(const mechanics::Model& model, std::string_view selector) {
    if (selector.starts_with('@')) selector.remove_prefix(1);
    if (selector.empty()) selector = "all";
    if (const auto group = model.groups.find(std::string(selector)); group != model.groups.end()) return group->second;
    if (selector.front() == '#')
        if (const auto index = number(selector.substr(1))) return onePoint(model, *index);
    if (selector.front() == '(' && selector.back() == ')')
        return gridPoints(model, selector.substr(1, selector.size() - 2));
    if (selector.back() == '%')
        if (const auto percent = number(selector.substr(0, selector.size() - 1)); percent && *percent <= 100)
            return onePoint(model, std::floor(*percent / 100.0 * (model.pointCount() - 1) + 0.5));
    return {};
}

}  // namespace taut::world
