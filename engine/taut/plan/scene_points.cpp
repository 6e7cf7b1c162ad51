#include "taut/plan/private/scene_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "taut/body/private/solid_places.h"
#include "taut/core/error.h"
#include "taut/spec/targets.h"

namespace taut::world {

ScenePoints::ScenePoints(std::span<Body* const> bodies) : bodies_(bodies) {
    int count = 0;
    for (const Body* body : bodies) {
        firstGlobal_.push_back(count);
        count += body->model.pointCount();
    }
}

std::size_t ScenePoints::count() const {
    return static_cast<std::size_t>(firstGlobal_.back() + bodies_.back()->model.pointCount());
}

PointRef ScenePoints::refOf(int global) const {
    const auto after = std::upper_bound(firstGlobal_.begin(), firstGlobal_.end(), global);
    return {static_cast<int>(after - firstGlobal_.begin()) - 1, global - after[-1]};
}

double ScenePoints::distance(PointRef a, PointRef b) const {
    const dvec3 d = position(b) - position(a);
    return std::sqrt(glm::dot(d, d));
}

std::vector<PointRef> ScenePoints::named(const JointSide& side, const Source& source) const {
    std::vector<PointRef> found;
    for (const std::string& text : side.targets) {
        const std::size_t before = found.size();
        for (int number = 0; number < static_cast<int>(bodies_.size()); ++number)
            if (names(text, body(number)))
                for (int i : selectPoints(body(number).model, parseTarget(text).selector)) found.push_back({number, i});
        if (found.size() == before)
            throw core::Error(core::ErrorKind::badContent, at(source) + "\"" + text + "\" names no point");
    }
    if (side.targets.size() < 2) return found;
    std::vector<PointRef> once;
    std::vector<bool> isMet(count(), false);
    for (const PointRef& p : found)
        if (!isMet[global(p)]) {
            isMet[global(p)] = true;
            once.push_back(p);
        }
    return once;
}

Spot ScenePoints::spotOf(int number, const dvec3& place) const {
    const mechanics::Model& model = body(number).model;
    const auto globalOf = [&](int i) { return global({number, i}); };
    if (body(number).spec->isRigid()) return spotAt(body(number), place).renumbered(globalOf);
    const auto distanceTo = [&](const dvec3& x) { return glm::dot(x - place, x - place); };
    const auto nearest =
        std::min_element(model.positions.begin(), model.positions.end(),
                         [&](const dvec3& x, const dvec3& other) { return distanceTo(x) < distanceTo(other); });
    return globalOf(static_cast<int>(nearest - model.positions.begin()));
}

}  // namespace taut::world
