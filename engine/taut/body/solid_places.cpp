#include "taut/body/private/solid_places.h"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>

#include "taut/core/aabb.h"
#include "taut/mechanics/rigid.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

// By axis: the side below and the one above.
constexpr std::array<std::array<std::string_view, 2>, 3> directions{
    {{"left", "right"}, {"bottom", "top"}, {"back", "front"}}};

// Of "front-top-middle" (0, 1, 1).
dvec3 directionOf(std::string_view name) {
    dvec3 direction(0.0);
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            if (name.find(directions[axis][side]) != std::string_view::npos) direction[axis] = 2.0 * side - 1.0;
    return direction;
}

// [m] A point as it is in the body's shape.
dvec3 restOf(const Body& body, int i) {
    return body.model.positions[i] - jitterOf(body, i);
}

core::Aabb boxOf(const Body& body) {
    core::Aabb box;
    for (const mechanics::RigidPart& part : body.model.parts)
        for (int i = part.first; i < part.last; ++i) {
            const dvec3 x = body.axes.toLocal(restOf(body, i));
            box.add(x - part.rounding);
            box.add(x + part.rounding);
        }
    return box;
}

dvec3 centreOf(const Body& body) {
    dvec3 sum(0.0);
    double mass = 0;
    for (int i = 0; i < body.model.pointCount(); ++i) {
        const double own = body.model.masses[i];
        sum += own * restOf(body, i);
        mass += own;
    }
    return sum / mass;
}

}  // namespace

std::optional<dvec3> placeNamed(const Body& body, std::string_view selector) {
    const std::vector<std::string> names = placeNames(body.model);
    if (std::find(names.begin(), names.end(), selector) == names.end()) return std::nullopt;
    if (selector == "centre") return centreOf(body);
    const core::Aabb box = boxOf(body);
    return body.axes.toWorld(box.centre() + directionOf(selector) * box.halfSize());
}

std::vector<std::string> placeNames(const mechanics::Model& model) {
    if (model.innerPoints == 0) return {};
    std::vector<std::string> names{"centre"};
    const auto has = [&](std::string_view side) { return model.groups.contains(std::string(side)); };
    for (const auto& sides : directions)
        for (const std::string_view side : sides) names.push_back(std::string(side) + (has(side) ? "-middle" : ""));
    if (!has("front") || !has("left")) return names;
    for (const auto& [first, second] : {std::pair{2, 1}, {2, 0}, {1, 0}})
        for (const std::string_view a : directions[first])
            for (const std::string_view b : directions[second])
                names.push_back(std::string(a) + "-" + std::string(b) + "-middle");
    return names;
}

// Inner points 2k and 2k + 1 are an arm before and behind their common centre; 0, 1, 2 and 4 span all.
Spot spotAt(const Body& body, const dvec3& place) {
    std::array<dvec3, mechanics::innerPoints> x;
    for (int i = 0; i < mechanics::innerPoints; ++i) x[i] = restOf(body, i);
    const glm::dmat3 arms(0.5 * (x[0] - x[1]), 0.5 * (x[2] - x[3]), 0.5 * (x[4] - x[5]));
    const dvec3 u = glm::inverse(arms) * (place - 0.5 * (x[0] + x[1]));
    const double both = 1.0 - u[1] - u[2];
    return {{0, 0.5 * (both + u[0])}, {1, 0.5 * (both - u[0])}, {2, u[1]}, {4, u[2]}};
}

double sizeOf(const Body& body) {
    core::Aabb box;
    for (const dvec3& x : body.model.positions) box.add(x);
    return glm::distance(box.low, box.high);
}

}  // namespace taut::world
