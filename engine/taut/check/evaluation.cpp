#include "taut/check/private/evaluation.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/body/body.h"
#include "taut/check/private/function_table.h"
#include "taut/core/error.h"
#include "taut/spec/targets.h"
#include "taut/world/private/body_surfaces.h"
#include "taut/world/world.h"

namespace taut::check {

const world::Selection& Now::selection(const std::string& target) const {
    const auto found = selections_.of.find(target);
    if (found != selections_.of.end() && world_.isCurrent(found->second)) return found->second;
    return selections_.of.insert_or_assign(target, world_.select(target)).first->second;
}

const world::Metrics& Now::metrics(const std::string& bodies, world::Measures what) const {
    const auto key = std::pair(bodies, what);
    const auto found = metrics_.find(key);
    if (found != metrics_.end()) return found->second;
    return metrics_.emplace(key, bodies.empty() ? world_.metrics(what) : world_.metrics(selection(bodies), what))
        .first->second;
}

const world::PointsNow& Now::points(const std::string& target) const {
    auto found = points_.find(target);
    if (found == points_.end()) found = points_.emplace(target, world_.points(selection(target))).first;
    if (found->second.x.empty())
        throw core::Error(core::ErrorKind::badContent,
                          fmt::format("{} finds no points at {:.6g} s", target, world_.time()));
    return found->second;
}

std::vector<std::array<glm::dvec3, 3>> Now::triangles(const std::string& bodies) const {
    return world_.triangles(selection(bodies));
}

world::BodySurfaces* Now::surfaces(const std::string& target) const {
    const auto& parts = selection(target).parts;
    const bool isWhole = world::parseTarget(target).selector.empty();
    const auto endsElsewhere = [](const auto& part) { return part.body->spec->meetsCollidersAsWhole(); };
    if (!isWhole || std::none_of(parts.begin(), parts.end(), endsElsewhere)) return nullptr;
    return &surfacesOf(target, target);
}

world::BodySurfaces& Now::surfacesOf(const std::string& first, const std::string& second) const {
    const world::Selection &a = selection(first), &b = selection(second);
    std::shared_ptr<world::BodySurfaces>& surfaces = selections_.surfaces[{first, second}];
    if (!surfaces || surfaces->generation() != a.generation) surfaces = std::make_shared<world::BodySurfaces>(a, b);
    return *surfaces;
}

world::BodySurfaces& Now::gap(const std::string& first, const std::string& second) const {
    const world::Selection &a = selection(first), &b = selection(second);
    for (const auto& [name, found] : {std::pair(first, &a), std::pair(second, &b)})
        if (found->parts.empty())
            throw core::Error(core::ErrorKind::badContent,
                              fmt::format("{} finds no bodies at {:.6g} s", name, world_.time()));
    if (a.parts.size() == 1 && b.parts.size() == 1 && a.parts[0].body == b.parts[0].body)
        throw core::Error(core::ErrorKind::badContent,
                          fmt::format("{} and {} are the same body, with nothing in between", first, second));
    return surfacesOf(first, second);
}

bool Expression::isMeasured() const {
    if (part == Part::target || (part == Part::call && function->takes.empty())) return true;
    if (part == Part::call && function->mayBeBare && inside.empty()) return true;
    return std::any_of(inside.begin(), inside.end(), [](const Expression& e) { return e.isMeasured(); });
}

Quantity valueOf(const Expression& expression, const Now& now) {
    const auto operand = [&](std::size_t i) { return valueOf(expression.inside[i], now).x; };
    // Of a vector and a number the number is in every component, of two numbers in x.
    const auto factor = [&](std::size_t i) {
        const glm::dvec3 x = operand(i);
        return expression.inside[i].isVector ? x : glm::dvec3(x.x);
    };
    switch (expression.part) {
        case Part::number: return {glm::dvec3(expression.number, 0, 0)};
        case Part::vector: return {glm::dvec3(operand(0).x, operand(1).x, operand(2).x)};
        case Part::call: return expression.function->value(now, expression.inside);
        case Part::negative: return {-operand(0)};
        case Part::sum: return {operand(0) + operand(1)};
        case Part::difference: return {operand(0) - operand(1)};
        case Part::product: return {factor(0) * factor(1)};
        case Part::quotient: return {factor(0) / factor(1)};
        case Part::component: return {glm::dvec3(operand(0)[expression.axis], 0, 0)};
        case Part::target: break;
    }
    return {};
}

std::string placeOf(const Expression& expression, const Now& now) {
    if (expression.part == Part::call && expression.function->place != nullptr)
        return expression.function->place(now, expression.inside);
    for (const Expression& inner : expression.inside) {
        std::string place = placeOf(inner, now);
        if (!place.empty()) return place;
    }
    return {};
}

std::string unitOf(const Expression& expression) {
    const auto scaled = [&](std::size_t number, std::size_t other) {
        return expression.inside[number].isMeasured() ? std::string() : unitOf(expression.inside[other]);
    };
    switch (expression.part) {
        case Part::call:
            if (!expression.function->unit.empty() || expression.inside.size() != 1) return expression.function->unit;
            return unitOf(expression.inside[0]);  // abs and length keep the unit
        case Part::negative:
        case Part::component: return unitOf(expression.inside[0]);
        case Part::sum:
        case Part::difference: {
            const std::string first = unitOf(expression.inside[0]), second = unitOf(expression.inside[1]);
            return first.empty() || second.empty() || first == second ? first.empty() ? second : first : "";
        }
        case Part::product: {
            const std::string unit = scaled(0, 1);
            return unit.empty() ? scaled(1, 0) : unit;
        }
        case Part::quotient: return scaled(1, 0);
        default: return {};
    }
}

}  // namespace taut::check
