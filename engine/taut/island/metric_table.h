// The metrics of bodies, one row each. Claims call them as functions, metrics.csv has a line of them for each frame,
// and the records of a run keep them. To add a metric, write a row and the function that measures one island.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "taut/island/report.h"

namespace taut::world {

struct BodySpec;
struct IslandPlan;
struct SceneSpec;

using MetricValue = std::variant<double, std::int64_t, glm::dvec3>;

// The bodies for which a value can be other than 0.
enum class Counts { everyBody, touchingBodies, bodiesMeetingFaces };

// A number of Metrics, to be read or written.
using MetricNumber = std::variant<double*, int*, std::int64_t*>;
using NumberVisitor = std::function<void(MetricNumber)>;

// The input of a row: an island at a published tick, velocities synchronised.
struct MeasuredIsland {
    const IslandPlan& plan;
    std::span<const glm::dvec3> x, v;  // (points) [m], [m/s]
    const std::vector<bool>& counts;   // (points) whether the metric counts this point
};

// A row either reads a member of Metrics, or measures by itself.
struct MetricSource {
    MetricValue (*value)(const Metrics& metrics) = nullptr;
    // Visits the numbers that make up the value; null: other rows visit them.
    void (*eachNumber)(Metrics& metrics, const NumberVisitor& visit) = nullptr;
    // `before` is the value over the islands so far, 0 at first. Returns the value with this island included.
    double (*measure)(const MeasuredIsland& island, double before) = nullptr;
};

struct Metric {
    std::string_view columns;   // of metrics.csv, with unit; a vector has three, separated by commas
    std::string_view function;  // of claims; empty: none
    std::string_view unit;      // "kg m/s"; empty: a plain number
    std::string_view help;
    MetricSource source;
    int extreme = 0;  // which body a claim names as the place: 1 the one with the largest value, -1 smallest, 0 none
    Measures measures = Measures::butCrossings;  // required measurements
    Counts counts = Counts::everyBody;

    MetricValue value(const Metrics& metrics) const;
    bool isVector() const { return std::holds_alternative<glm::dvec3>(value({})); }
};

std::span<const Metric> metricTable();

// Adds the values of the rows that measure by themselves.
void addMeasured(const MeasuredIsland& island, Metrics& metrics);

// Visits the time and every number that a row of the table consists of, in the order of the table.
void eachNumber(Metrics& metrics, const NumberVisitor& visit);

bool isCounted(Counts counts, const BodySpec& body);
// Whether the scene has any such body.
bool isCounted(Counts counts, const SceneSpec& scene);

}  // namespace taut::world
