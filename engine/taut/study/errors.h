// Distances between observations.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "taut/study/subject.h"

namespace taut::study {

// √(mean over points of |a - b|²); expects equal lengths. [the values' unit]
inline double rmsDifference(std::span<const double> a, std::span<const double> b, int dimensions) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum * dimensions / static_cast<double>(std::max<std::size_t>(a.size(), 1)));
}

// Largest |a - b| of a point.
inline double maxDifference(std::span<const double> a, std::span<const double> b, int dimensions) {
    double largest = 0;
    const auto d = static_cast<std::size_t>(dimensions);
    for (std::size_t i = 0; i + d <= a.size(); i += d) {
        double sum = 0;
        for (std::size_t p = i; p < i + d; ++p) sum += (a[p] - b[p]) * (a[p] - b[p]);
        largest = std::max(largest, sum);
    }
    return std::sqrt(largest);
}

// Quantities of a state that can be compared if its points cannot: its size, and its lowest height.
struct StateSize {
    double extent = 0;  // [m] diagonal of the bounding box
    double height = 0;  // [m] mean y
};
inline StateSize shapeOf(const Observation& seen, int dimensions) {
    StateSize shape;
    const auto d = static_cast<std::size_t>(dimensions);
    double square = 0;
    for (std::size_t p = 0; p < d && p < seen.values.size(); ++p) {
        double least = seen.values[p], most = least, sum = 0;
        for (std::size_t i = p; i < seen.values.size(); i += d) {
            least = std::min(least, seen.values[i]);
            most = std::max(most, seen.values[i]);
            sum += seen.values[i];
        }
        square += (most - least) * (most - least);
        if (p == 1) shape.height = sum * dimensions / static_cast<double>(seen.values.size());
    }
    shape.extent = std::sqrt(square);
    return shape;
}

}  // namespace taut::study
