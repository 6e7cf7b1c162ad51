#include "taut/collision/private/foot_finder.h"

#include <array>
#include <cstring>

namespace taut::collision {

namespace {

// The nearest point of a triangle. The signs of the barycentric coordinates tell apart the regions of its corners and
// edges (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
dvec3 nearestOnTriangle(const dvec3& p, const dvec3& a, const dvec3& ab, const dvec3& ac) {
    const dvec3 ap = p - a;
    const double d1 = glm::dot(ab, ap);
    const double d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const dvec3 bp = ap - ab;
    const double d3 = glm::dot(ab, bp);
    const double d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return a + ab;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + ab * (d1 / (d1 - d3));
    const dvec3 cp = ap - ac;
    const double d5 = glm::dot(ab, cp);
    const double d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return a + ac;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
        return a + ab + (ac - ab) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double whole = 1.0 / (va + vb + vc);
    return a + ab * (vb * whole) + ac * (vc * whole);
}

}  // namespace

void FootFinder::update(const dvec3& p, int triangle, Foot& foot) const {
    const Facet& t = facets_.triangles[static_cast<std::size_t>(triangle)];
    const dvec3 q = nearestOnTriangle(p, t.corner, t.ab, t.ac);
    const dvec3 apart = p - q;
    const double square = glm::dot(apart, apart);
    const double tie = 1e-11 * foot.square;
    if (square > foot.square + tie) return;
    const double facing = std::abs(glm::dot(apart, t.normal));
    if (square < foot.square - tie || facing > foot.facing * (1.0 + 1e-9) ||
        (facing >= foot.facing * (1.0 - 1e-9) && triangle < foot.triangle))
        foot = {square, facing, q, triangle};
}

// The height over the plane and the way beyond the farthest edge are at right angles. Together they are no more than
// the distance, and equal to it except in front of a corner. It measures four triangles at a time. `lowest` (list,
// rounded up to four) gets the square of the least distance of each.
void FootFinder::lowestSquares(const dvec3& fromCentre, std::span<const int> list, float* lowest) const {
    const auto x = static_cast<float>(fromCentre.x);
    const auto y = static_cast<float>(fromCentre.y);
    const auto z = static_cast<float>(fromCentre.z);
    const auto heights = [&](std::size_t i) {
        const Prism& prism = prisms_[static_cast<std::size_t>(list[i < list.size() ? i : list.size() - 1])];
        return prism.x * x + prism.y * y + prism.z * z - prism.offset;
    };
    const auto larger = [](const Four& a, const Four& b) { return a > b ? a : b; };
    for (std::size_t i = 0; i < list.size(); i += 4) {
        const Four a = heights(i);
        const Four b = heights(i + 1);
        const Four c = heights(i + 2);
        const Four d = heights(i + 3);
        const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);  // heights over the plane, beyond the first edge
        const Four cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
        const Four abBeyond = __builtin_shufflevector(a, b, 2, 6, 3, 7);
        const Four cdBeyond = __builtin_shufflevector(c, d, 2, 6, 3, 7);
        const Four over = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
        const Four beyond = larger(larger(__builtin_shufflevector(ab, cd, 2, 3, 6, 7), Four{}),
                                   larger(__builtin_shufflevector(abBeyond, cdBeyond, 0, 1, 4, 5),
                                          __builtin_shufflevector(abBeyond, cdBeyond, 2, 3, 6, 7)));
        const Four square = over * over + beyond * beyond;
        std::memcpy(lowest + i, &square, sizeof square);
    }
}

Foot FootFinder::footAmong(const dvec3& p, std::span<const int> list, float* lowest) const {
    lowestSquares(p - bounds_.centre(), list, lowest);
    std::size_t best = 0;
    for (std::size_t i = 1; i < list.size(); ++i) best = lowest[i] < lowest[best] ? i : best;
    Foot foot;
    float limit = 0.0F;  // (d + e)² <= (1 + c) d² + (1 + 1/c) e²
    const auto look = [&](std::size_t i) {
        update(p, list[i], foot);
        limit = static_cast<float>(1.001 * foot.square + 1001.0 * rounding_ * rounding_);
    };
    look(best);
    for (std::size_t i = 0; i < list.size(); ++i)
        if (lowest[i] <= limit && i != best) look(i);
    return foot;
}

void FootFinder::footInTree(const dvec3& p, double shrink, Foot& foot) const {
    tree_.closest(
        p, shrink, foot.square, [&](int triangle) { update(p, triangle, foot); });
}

Foot FootFinder::foot(const dvec3& p, const Place& place) const {
    if (!place.list.empty()) {
        std::array<float, longestList> lowest;
        return footAmong(p, place.list, lowest.data());
    }
    Foot foot;
    footInTree(p, 1.0, foot);
    return foot;
}

bool FootFinder::isInside(const dvec3& p, const Foot& foot) const {
    return facets_.isClosed && foot.triangle >= 0 && glm::dot(p - foot.point, triangle(foot.triangle).normal) < 0.0;
}

Nearest FootFinder::nearestFrom(const dvec3& p, const Foot& foot) const {
    if (foot.triangle < 0) return {std::numeric_limits<double>::infinity(), {0.0, 1.0, 0.0}};
    const double distance = std::sqrt(foot.square);
    if (!(distance > 0.0)) return {0.0, triangle(foot.triangle).normal};
    const double sign = isInside(p, foot) ? -1.0 : 1.0;
    return {sign * distance, (p - foot.point) * (sign / distance)};
}

FootFinder::Place FootFinder::place(const dvec3& p) const {
    bool isWithin = true;
    glm::ivec3 at;
    dvec3 middle;
    for (int k = 0; k < 3; ++k) {
        const double cells = (p[k] - cellsFrom_[k]) * cellsPerMetre_;
        const int last = cellCount_[k] - 1;
        isWithin &= cells >= 0.0 && cells < last + 1;
        at[k] = cells >= last ? last : (cells > 0.0 ? static_cast<int>(cells) : 0);
        middle[k] = cellsFrom_[k] + (at[k] + 0.5) * cellSize_;
    }
    const Cell* cell = &cells_[static_cast<std::size_t>((at.z * cellCount_.y + at.y) * cellCount_.x + at.x)];
    double half = 0.5 * cellSize_;
    while (cell->count < 0) {
        half *= 0.5;
        std::uint32_t part = 0;
        for (int k = 0; k < 3; ++k) {
            const bool isAbove = p[k] >= middle[k];
            part |= isAbove ? 1U << k : 0U;
            middle[k] += isAbove ? half : -half;
        }
        cell = &cells_[cell->first + part];
    }
    // A distance changes by no more than the way from the middle to p.
    const dvec3 off = p - middle;
    const double away = std::sqrt(glm::dot(off, off));
    Place place{cell->least - away, std::abs(cell->most) + away, cell->most < 0.0F, {}};
    if (isWithin) place.list = {lists_.data() + cell->first, static_cast<std::size_t>(cell->count)};
    return place;
}

}  // namespace taut::collision
