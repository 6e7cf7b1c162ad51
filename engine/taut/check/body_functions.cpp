// Measures of entire bodies.
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

// [m³] The volume enclosed by closed parts whose sheets do not all face the same way. 0: none.
double enclosedBySewn(std::span<const std::array<glm::dvec3, 3>> all) {
    std::vector<std::array<int, 3>> triangles;
    std::vector<glm::dvec3> places;
    std::map<std::array<double, 3>, int> numbers;
    for (const auto& t : all) {
        triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [number, isNew] = numbers.try_emplace({t[k].x, t[k].y, t[k].z}, static_cast<int>(places.size()));
            if (isNew) places.push_back(t[k]);
            triangles.back()[k] = number->second;
        }
    }
    double volume = 0.0;
    for (const mechanics::Chamber& chamber : mechanics::chambersOf(triangles, places))
        if (chamber.isClosed()) volume += chamber.firstVolume;
    return volume;
}

// Of triangles that look all outwards, or all inwards, seen from anywhere; parts that face the other way
// count as hollow.
Quantity enclosed(const Now& now, std::span<const Expression> arguments) {
    constexpr double closed = 1e-5;  // of the area: rest of its sum as vectors
    const auto triangles = now.triangles(arguments[0].target);
    glm::dvec3 middle(0.0), outwards(0.0);
    double area = 0.0;
    for (const auto& t : triangles) {
        const glm::dvec3 across = glm::cross(t[1] - t[0], t[2] - t[0]);
        middle += (t[0] + t[1] + t[2]) / (3.0 * static_cast<double>(triangles.size()));
        outwards += across;
        area += glm::length(across);
    }
    double sixfold = 0.0;
    for (const auto& t : triangles) sixfold += glm::dot(t[0] - middle, glm::cross(t[1] - middle, t[2] - middle));
    if (glm::length(outwards) < closed * area) return {glm::dvec3(std::abs(sixfold) / 6.0, 0, 0)};
    const double sewn = enclosedBySewn(triangles);
    return {glm::dvec3(sewn > 0.0 ? sewn : sixfold / 6.0, 0, 0)};
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
                         "Area of the bodies' projection along an axis, layers counted once. Ropes and nets have none.",
                         shadow,
                         {}});
    functions.push_back({"enclosed",
                         {Takes::bodies},
                         false,
                         false,
                         "m³",
                         "Volume enclosed by the bodies' surfaces, also by several sewn together; open surfaces are "
                         "closed by a cone to their middle.",
                         enclosed,
                         {}});
    return functions;
}

}  // namespace taut::check
