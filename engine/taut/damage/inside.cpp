#include "taut/damage/private/inside.h"

#include <utility>

namespace taut::world {

using glm::dvec3;

Inside::Inside(std::vector<dvec3> places, std::span<const std::array<int, 3>> triangles, glm::ivec2 columns)
    : places_(std::move(places)),
      counts_(columns),
      columns_(static_cast<std::size_t>(columns.x) * static_cast<std::size_t>(columns.y)) {
    for (const std::array<int, 3>& t : triangles) {
        const auto at = [&](std::size_t k) { return places_[t[k]]; };
        const glm::ivec2 low = columnAt(glm::min(at(0), glm::min(at(1), at(2)))),
                         high = columnAt(glm::max(at(0), glm::max(at(1), at(2))));
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) columns_[numberOf({x, y})].push_back(t);
    }
}

bool Inside::has(const dvec3& place) const {
    // Nothing is looked at straight through an edge.
    const dvec3 from = place + dvec3(1e-7, 0.618e-7, 0.0);
    int around = 0;
    for (const std::array<int, 3>& t : columns_[numberOf(columnAt(from))]) {
        const auto way = [&](std::size_t k) { return places_[t[k]] - from; };
        const dvec3 a = way(0), b = way(1), c = way(2);
        const double ofA = b.x * c.y - b.y * c.x, ofB = c.x * a.y - c.y * a.x, ofC = a.x * b.y - a.y * b.x;
        const double all = ofA + ofB + ofC;
        const bool isInLine = (ofA > 0) == (ofB > 0) && (ofB > 0) == (ofC > 0) && all != 0.0;
        if (isInLine && (ofA * a.z + ofB * b.z + ofC * c.z) / all > 0) around += all > 0 ? 1 : -1;
    }
    return around > 0;
}

glm::ivec2 Inside::columnAt(const dvec3& place) const {
    return glm::clamp(glm::ivec2(glm::floor(glm::dvec2(place))), glm::ivec2(0), counts_ - 1);
}

std::size_t Inside::numberOf(glm::ivec2 column) const {
    return static_cast<std::size_t>(column.x) +
           static_cast<std::size_t>(counts_.x) * static_cast<std::size_t>(column.y);
}

}  // namespace taut::world
