// What is measured of whole bodies.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "taut/check/private/function_table.h"
#include "taut/check/private/places.h"
#include "taut/check/private/shadow.h"
#include "taut/island/metric_table.h"
#include "taut/mechanics/private/filling.h"

namespace taut::check {

namespace {

glm::dvec3 asVector(const world::MetricValue& value) {
    if (const auto* vector = std::get_if<glm::dvec3>(&value)) return *vector;
    if (const auto* number = std::get_if<double>(&value)) return {*number, 0, 0};
    return {static_cast<double>(std::get<std::int64_t>(value)), 0, 0};
}

// Seen along x it is the plane of y and z, and so on.
Quantity shadow(const Now& now, std::span<const Expression> arguments) {
    const int axis = arguments[1].axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<FlatTriangle> flat;
    for (const auto& t : now.triangles(arguments[0].target))
        flat.push_back({glm::dvec2(t[0][u], t[0][v]), {t[1][u], t[1][v]}, {t[2][u], t[2][v]}});
    return {glm::dvec3(coveredArea(std::move(flat)), 0, 0)};
}

// Closed parts count whichever way they are turned, but for a hollow that looks inwards in others that look outwards.
// What is left is seen from its middle, as if closed by a cone.
Quantity enclosed(const Now& now, std::span<const Expression> arguments) {
    std::vector<std::array<int, 3>> triangles;
    std::vector<glm::dvec3> places;
    std::map<std::array<double, 3>, int> numbers;
    for (const auto& t : now.triangles(arguments[0].target)) {
        triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [number, isNew] = numbers.try_emplace({t[k].x, t[k].y, t[k].z}, static_cast<int>(places.size()));
            if (isNew) places.push_back(t[k]);
            triangles.back()[k] = number->second;
        }
    }
    double volume = 0.0, turnedAlike = 0.0;  // [m³]
    std::vector<std::array<int, 3>> open;
    for (const mechanics::Chamber& chamber : mechanics::chambersOf(triangles, places))
        if (chamber.isClosed())
            (chamber.side == 0 ? volume : turnedAlike) += (chamber.side < 0 ? -1 : 1) * chamber.firstVolume;
        else
            open.insert(open.end(), chamber.triangles.begin(), chamber.triangles.end());
    const auto at = [&](int i) { return places[static_cast<std::size_t>(i)]; };
    glm::dvec3 middle(0.0);
    for (const auto& t : open) middle += (at(t[0]) + at(t[1]) + at(t[2])) / (3.0 * static_cast<double>(open.size()));
    double sixfold = 0.0;
    for (const auto& t : open) sixfold += glm::dot(at(t[0]) - middle, glm::cross(at(t[1]) - middle, at(t[2]) - middle));
    return {glm::dvec3(volume + std::abs(turnedAlike) + sixfold / 6.0, 0, 0)};
}

std::string bodiesOf(std::span<const Expression> arguments) {
    return arguments.empty() ? "" : arguments[0].target;
}

}  // namespace

std::vector<Function> bodyFunctions() {
    std::vector<Function> functions;
    for (const world::Metric& metric : world::metricTable()) {
        if (metric.function.empty()) continue;
        Function& function = functions.emplace_back();
        function.name = metric.function;
        function.takes = {Takes::bodies};
        function.mayBeBare = true;
        function.isVector = metric.isVector();
        function.unit = metric.unit;
        function.help = metric.help;
        function.counts = metric.counts;
        function.value = [&metric](const Now& now, std::span<const Expression> arguments) -> Quantity {
            return {asVector(metric.value(now.metrics(bodiesOf(arguments), metric.measures)))};
        };
        if (metric.extreme == 0) continue;
        function.place = [&metric](const Now& now, std::span<const Expression> arguments) {
            return extremeBody(now, bodiesOf(arguments), metric.measures, [&](const world::Metrics& metrics) {
                return metric.extreme * asVector(metric.value(metrics)).x;
            });
        };
    }
    functions.push_back({"shadow",
                         {Takes::bodies, Takes::axis},
                         false,
                         false,
                         "m²",
                         "Area of the bodies' shadow in light along an axis, places under several layers counted once. "
                         "Ropes and nets have none.",
                         shadow,
                         {}});
    functions.push_back(
        {"enclosed",
         {Takes::bodies},
         false,
         false,
         "m³",
         "Volume that the bodies' surfaces enclose, also several that are sewn together; one that is open is closed by "
         "a cone to its middle.",
         enclosed,
         {}});
    return functions;
}

}  // namespace taut::check
