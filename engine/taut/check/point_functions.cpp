// Measures at points.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "taut/body/body.h"
#include "taut/check/private/function_table.h"
#include "taut/check/private/places.h"
#include "taut/world/private/body_surfaces.h"

namespace taut::check {

namespace {

using Arguments = std::span<const Expression>;
using glm::dvec3;
using world::PointsNow;

const PointsNow& pointsOf(const Now& now, Arguments arguments) {
    return now.points(arguments[0].target);
}

template <class Measure>
double largest(const PointsNow& points, const Measure& measure) {
    double value = measure(points, 0);
    for (std::size_t i = 1; i < points.x.size(); ++i) {
        const double next = measure(points, i);
        if (!(next <= value)) value = next;  // NaN stays
    }
    return value;
}

dvec3 weightedMean(const PointsNow& points, const std::vector<dvec3>& values) {
    dvec3 sum(0.0);
    double mass = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += points.mass[i] * values[i];
        mass += points.mass[i];
    }
    return sum / mass;
}

template <int up>
double upwards(const PointsNow& points, std::size_t i) {
    return up * points.x[i].y;
}
double speed(const PointsNow& points, std::size_t i) {
    return std::sqrt(glm::dot(points.v[i], points.v[i]));
}

dvec3 place(const Expression& argument, const Now& now) {
    if (argument.part != Part::target) return valueOf(argument, now).x;
    const PointsNow& points = now.points(argument.target);
    return weightedMean(points, points.x);
}

Quantity numberOf(double value) {
    return {dvec3(value, 0, 0)};
}

Quantity position(const Now& now, Arguments a) {
    return {place(a[0], now)};
}
Quantity velocity(const Now& now, Arguments a) {
    const PointsNow& points = pointsOf(now, a);
    return {weightedMean(points, points.v)};
}
Quantity distance(const Now& now, Arguments a) {
    const dvec3 way = place(a[0], now) - place(a[1], now);
    return numberOf(std::sqrt(glm::dot(way, way)));
}

Quantity inPicture(const Now& now, Arguments a) {
    return numberOf(now.world().shareInPicture(pointsOf(now, a).x));
}

// `sign` times the largest of a measure.
template <auto measure, int sign = 1>
Quantity largestOf(const Now& now, Arguments a) {
    return numberOf(sign * largest(pointsOf(now, a), measure));
}
template <auto measure>
std::string placeOfLargest(const Now& now, Arguments a) {
    return extremePoint(now, a[0].target, measure);
}

// How far up or down whole bodies reach, or points. up: 1 or -1.
template <int up>
Quantity reach(const Now& now, Arguments a) {
    if (world::BodySurfaces* surfaces = now.surfaces(a[0].target))
        return numberOf((up > 0 ? surfaces->highest() : surfaces->lowest()).x.y);
    return largestOf<upwards<up>, up>(now, a);
}
template <int up>
std::string placeOfReach(const Now& now, Arguments a) {
    world::BodySurfaces* surfaces = now.surfaces(a[0].target);
    if (surfaces == nullptr) return placeOfLargest<upwards<up>>(now, a);
    const auto [body, x] = up > 0 ? surfaces->highest() : surfaces->lowest();
    return fmt::format("{} at [{:.4g}, {:.4g}, {:.4g}]", body->fullName(), x.x, x.y, x.z);
}

}  // namespace

std::vector<Function> pointFunctions() {
    const std::vector<Takes> points{Takes::points};
    return {
        {"position", points, false, true, "m", "Centre of mass of the points.", position, {}},
        {"velocity", points, false, true, "m/s", "Velocity of the centre of mass.", velocity, {}},
        {"distance", {Takes::place, Takes::place}, false, false, "m", "Distance of two places.", distance, {}},
        {"speed", points, false, false, "m/s", "Speed of the fastest point.", largestOf<speed>, placeOfLargest<speed>},
        {"height", points, false, false, "m", "Largest height y of the points, or of the surface of a body.", reach<1>,
         placeOfReach<1>},
        {"lowest", points, false, false, "m", "Smallest height y of the points, or of the surface of a body.",
         reach<-1>, placeOfReach<-1>},
        {"in_picture",
         points,
         false,
         false,
         "",
         "Share of the points inside the picture, hidden or not.",
         inPicture,
         {}},
    };
}

}  // namespace taut::check
