#include "taut/check/private/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "taut/spec/targets.h"
#include "taut/world/world.h"

namespace taut::check {

namespace {

// Sorted names of the bodies that a target names; all for an empty one.
std::vector<std::string> bodiesOf(const Now& now, const std::string& target) {
    const std::string_view pattern = target.empty() ? "*" : world::withoutSelector(target);
    std::vector<std::string> names;
    for (const world::BodyHash& body : now.world().bodyHashes())
        if (world::matches(pattern, body.name)) names.push_back(body.name);
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

std::string extremePoint(const Now& now, const std::string& target,
                         const std::function<double(const world::PointsNow&, std::size_t)>& measure) {
    const std::string selector = world::parseTarget(target).selector;
    const bool isAll = selector.empty() || selector == "all";
    double largest = -std::numeric_limits<double>::infinity();
    std::string place;
    for (const std::string& body : bodiesOf(now, target)) {
        const world::PointsNow points = now.world().points(isAll ? body + "@all" : body + "@" + selector);
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            const double value = measure(points, i);
            if (!(value > largest)) continue;
            largest = value;
            const glm::dvec3 x = points.x[i];
            const std::string name = isAll ? fmt::format("{}@#{}", body, i)
                                     : points.x.size() > 1
                                         ? fmt::format("{}@{}, point {} of {}", body, selector, i + 1, points.x.size())
                                         : fmt::format("{}@{}", body, selector);
            place = fmt::format("{} at [{:.4g}, {:.4g}, {:.4g}]", name, x.x, x.y, x.z);
        }
    }
    return place;
}

std::string extremeBody(const Now& now, const std::string& bodies, world::Measures what,
                        const std::function<double(const world::Metrics&)>& measure) {
    double largest = -std::numeric_limits<double>::infinity();
    std::string place;
    for (const std::string& body : bodiesOf(now, bodies)) {
        const double value = measure(now.metrics(body, what));
        if (!(value > largest)) continue;
        largest = value;
        place = body;
    }
    return place;
}

}  // namespace taut::check
