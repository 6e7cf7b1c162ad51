// What is measured of whole bodies.
#include <glm/geometric.hpp>

#include "taut/check/private/function_table.h"
#include "taut/check/private/places.h"
#include "taut/check/private/shadow.h"
#include "taut/island/metric_table.h"

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

// Seen from a corner of its own.
Quantity enclosed(const Now& now, std::span<const Expression> arguments) {
    const auto triangles = now.triangles(arguments[0].target);
    double sixfold = 0.0;
    for (const auto& t : triangles) {
        const glm::dvec3& origin = triangles.front()[0];
        sixfold += glm::dot(t[0] - origin, glm::cross(t[1] - origin, t[2] - origin));
    }
    return {glm::dvec3(sixfold / 6.0, 0, 0)};
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
         "Volume that the bodies' surfaces enclose, their fronts outside; a surface that is open has none "
         "of its own.",
         enclosed,
         {}});
    return functions;
}

}  // namespace taut::check
