#include "taut/core/error.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/builder_support.h"

namespace taut::mechanics {

Model buildNet(std::span<const NetPoint> points, std::span<const NetSpring> springs) {
    Model model;
    detail::addRestingPoints(model, static_cast<int>(points.size()), 0.0);
    std::map<std::string, int> indexOf;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const NetPoint& point = points[i];
        TAUT_EXPECTS(point.mass > 0.0);
        const bool isNew = indexOf.emplace(point.name, static_cast<int>(i)).second;
        TAUT_EXPECTS(isNew);
        model.positions[i] = detail::withoutNegativeZero(point.position);
        model.velocities[i] = detail::withoutNegativeZero(point.velocity);
        model.masses[i] = point.mass;
        model.dragRates[i] = point.dragRate;
        model.held[i] = point.held;
        model.groups.emplace(point.name, std::vector<int>{static_cast<int>(i)});
    }
    for (const NetSpring& spring : springs) {
        const auto a = indexOf.find(spring.a), b = indexOf.find(spring.b);
        TAUT_EXPECTS(a != indexOf.end() && b != indexOf.end() && a != b);
        const double distance = glm::length(model.positions[b->second] - model.positions[a->second]);
        model.springs.push_back({a->second, b->second, spring.stiffness, spring.restLength.value_or(distance),
                                 spring.dampingTime, SpringKind::structural});
    }
    return model;
}

}  // namespace taut::mechanics
