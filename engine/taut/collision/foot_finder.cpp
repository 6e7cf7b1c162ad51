#include "taut/collision/private/foot_finder.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace taut::collision {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

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
    const Facet& t = facets_.triangles[triangle];
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
        const Prism& prism = prisms_[list[i < list.size() ? i : list.size() - 1]];
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

Foot FootFinder::footAmong(const dvec3& p, std::span<const int> list) const {
    std::array<float, longestList> lowest;
    return footAmong(p, list, lowest.data());
}

void FootFinder::footInTree(const dvec3& p, double shrink, Foot& foot) const {
    tree_.closest(
        p, shrink, foot.square, [&](int triangle) { update(p, triangle, foot); });
}

Foot FootFinder::foot(const dvec3& p, const Place& place) const {
    if (!place.list.empty()) return footAmong(p, place.list);
    Foot foot;
    footInTree(p, 1.0, foot);
    return foot;
}

// Let p have its foot inside of triangle T, at height h, and p' be another place, less far from p than h and than p's
// foot is from T's edges. p' has its foot inside of T as well, unless another triangle is nearer.
//
//      p .  p'     - One at distance d > h from p is not, if p' is nearer to p than (d - h) / 2.
//        |         - Nor is one beyond an edge of T, or beyond a corner (across its bisector), and behind T's plane, by
//   _____|__       how much ever. If it rises e above the plane, the foot of p' has to stay √(2 h' e) away from the
//      T    \      edges; h' < 2 h.
//            \     The radius is the least of these bounds. Triangles that p's cell does not list are farther than
//                  the listed ones, in all of the cell.
double FootFinder::radiusOfFace(const dvec3& p, const Place& place, const Foot& foot, const float* lowest) const {
    const dvec3 centre = bounds_.centre();
    const Facet& face = triangle(foot.triangle);
    const Prism& prism = prisms_[foot.triangle];
    const auto heights = [&](const dvec3& at) {
        const dvec3 from = at - centre;
        return prism.x * static_cast<float>(from.x) + prism.y * static_cast<float>(from.y) +
               prism.z * static_cast<float>(from.z) - prism.offset;
    };
    const Four at = heights(p);
    const double height = std::abs(static_cast<double>(at[0]));
    const double within = -static_cast<double>(std::max({at[1], at[2], at[3]})) - 1e-4 * height - 5.0 * rounding_;
    double radius = std::min({place.room, height - 5.0 * rounding_, within});
    const dvec3 up = at[0] < 0.0F ? -face.normal : face.normal;
    for (std::size_t i = 0; i < place.list.size() && radius > 0.0; ++i) {
        if (place.list[i] == foot.triangle) continue;
        const double apart = std::sqrt(static_cast<double>(lowest[i])) - height - 4.0 * rounding_;
        double bound = 0.499 * apart;
        if (bound >= radius) continue;
        const Facet& t = triangle(place.list[i]);
        const std::array<dvec3, 3> corners{t.corner, t.corner + t.ab, t.corner + t.ac};
        double rise = 1e-9 * rounding_;
        Four beyond = {infinite, infinite, infinite, infinite};  // edges
        Four across = beyond;                                    // corners; a sum of two
        for (const dvec3& corner : corners) {
            rise = std::max(rise, glm::dot(corner - face.corner, up));
            const Four over = heights(corner);
            const Four both = over + __builtin_shufflevector(over, over, 0, 2, 3, 1);
            beyond = over < beyond ? over : beyond;
            across = both < across ? both : across;
        }
        const float most = std::max({beyond[1], beyond[2], beyond[3], across[1], across[2], across[3]});
        if (most >= -static_cast<float>(rounding_)) bound = std::max(bound, within - 2.05 * std::sqrt(height * rise));
        radius = std::min(radius, bound);
    }
    return radius * (1.0 - 1e-6);
}

// The few are the triangles of the least lower bounds. A place that is m away from p has its foot at no more than
// d + m, and is no nearer to the others than their bounds less m. So footAmong() would not look at them.
void FootFinder::findFew(const Place& place, const float* lowest, Around& around) const {
    const std::size_t size = place.list.size();
    around.fewRadius = place.room - rounding_;
    float limit = infinite;
    if (size > around.few.size()) {
        std::array<float, longestList> sorted{};
        std::copy_n(lowest, size, sorted.begin());
        float* const next = sorted.data() + around.few.size();
        std::nth_element(sorted.data(), next, sorted.data() + size);
        limit = *next;
        const double others = std::sqrt(static_cast<double>(limit)) - 40.0 * rounding_;
        around.fewRadius = std::min(around.fewRadius, 0.499 * (others - 1.001 * std::sqrt(around.foot.square)));
    }
    for (std::size_t i = 0; i < size; ++i)
        if (lowest[i] < limit) around.few[around.fewCount++] = place.list[i];
}

FootFinder::Around FootFinder::know(const dvec3& p, double far) const {
    Around known;
    const Place near = place(p);
    if (near.least > 0.0 && near.inside && isClosed()) return known;
    known.clear = near.least * (1.0 - 1e-6);
    if (known.clear > far) return known;
    if (near.list.empty()) {
        footInTree(p, 1.0, known.foot);
    } else {
        std::array<float, longestList> lowest;
        known.foot = footAmong(p, near.list, lowest.data());
        known.radius = radiusOfFace(p, near, known.foot, lowest.data());
        if (!(known.radius > 0.0)) findFew(near, lowest.data(), known);
    }
    const bool inside = isInside(p, known.foot);
    known.clear = inside ? -1.0 : std::sqrt(known.foot.square) * (1.0 - 1e-6);
    if (inside) known.radius = -1.0;
    return known;
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
    const Cell* cell = &cells_[(at.z * cellCount_.y + at.y) * cellCount_.x + at.x];
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
    const double room = isWithin ? half - std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) : -1.0;
    Place place{cell->least - away, room, cell->isInside, {}};
    if (isWithin) place.list = {lists_.data() + cell->first, static_cast<std::size_t>(cell->count)};
    return place;
}

}  // namespace taut::collision
