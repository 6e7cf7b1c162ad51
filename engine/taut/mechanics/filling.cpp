#include "taut/mechanics/private/filling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "taut/core/error.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using Triangle = std::array<int, 3>;

constexpr double leastShare = 1e-3, softShare = 0.1;              // of V₀
constexpr double workingStretch = 1.2, workingShare = 2.0 / 3.0;  // of edges, of V₀

template <class Real>
dvec3 vectorAt(const Real* planes, std::ptrdiff_t stride, int i) {
    return {planes[i], planes[i + stride], planes[i + 2 * stride]};
}

// Seen from its first corner, so that a surface far from the origin has the same volume.
template <class PlaceOf>
double enclosed(std::span<const Triangle> triangles, const PlaceOf& placeOf) {
    if (triangles.empty()) return 0.0;
    const dvec3 origin = placeOf(triangles[0][0]);
    double sixfold = 0.0;
    for (const Triangle& t : triangles)
        sixfold += glm::dot(placeOf(t[0]) - origin, glm::cross(placeOf(t[1]) - origin, placeOf(t[2]) - origin));
    return sixfold / 6.0;
}

struct EdgeSide {
    std::size_t triangle;
    bool isForward;  // from the lower point of the edge to the higher
};
using Edges = std::map<std::pair<int, int>, std::vector<EdgeSide>>;

// By the points that stand for theirs.
Triangle known(Triangle t, std::span<const int> one) {
    if (!one.empty())
        for (int& i : t) i = one[i];
    return t;
}

// Without triangles that never have an area, as in a gathered seam, and triangles that lie on each other, as where two
// sheets are sewn through a corner.
std::vector<Triangle> thatEnclose(std::span<const Triangle> triangles, std::span<const int> one) {
    std::map<Triangle, int> times;
    const auto sorted = [&](const Triangle& triangle) {
        Triangle t = known(triangle, one);
        std::sort(t.begin(), t.end());
        return t;
    };
    for (const Triangle& t : triangles) ++times[sorted(t)];
    std::vector<Triangle> left;
    for (const Triangle& t : triangles) {
        const Triangle s = sorted(t);
        if (s[0] != s[1] && s[1] != s[2] && times[s] % 2 == 1) left.push_back(t);
    }
    return left;
}

Edges edgesOf(std::span<const Triangle> triangles, std::span<const int> one) {
    Edges edges;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Triangle corners = known(triangles[t], one);
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = corners[k], b = corners[(k + 1) % 3];
            edges[std::minmax(a, b)].push_back({t, a < b});
        }
    }
    return edges;
}

// Of an edge that several parts of a surface share, whether as many sides run along it as against it. Then it is open
// nowhere: their shares of the volume, and of the force of a pressure, cancel.
bool isShared(const std::vector<EdgeSide>& sides) {
    const auto forward = std::count_if(sides.begin(), sides.end(), [](const EdgeSide& s) { return s.isForward; });
    return sides.size() > 2 && 2 * static_cast<std::size_t>(forward) == sides.size();
}

// Triangles that close the gaps between edges that are sewn and not yet together: of points that are `one`, turned as
// the triangles of the surface are. An edge has a strip; where strips meet, a fan from the first of their points.
std::vector<Triangle> gapsIn(std::span<const Triangle> triangles, std::span<const int> one) {
    using Ends = std::array<int, 2>;
    std::map<std::pair<int, int>, std::array<std::vector<Ends>, 2>>
        edges;  // by their points, in the one and the other direction
    for (const Triangle& t : triangles) {
        const Triangle corners = known(t, one);
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = corners[k], b = corners[(k + 1) % 3];
            edges[std::minmax(a, b)][a < b ? 0 : 1].push_back({t[k], t[(k + 1) % 3]});
        }
    }
    std::vector<Triangle> gaps;
    std::map<int, int> first;
    const auto add = [&](int a, int b, int c) {
        if (a != b && b != c && c != a) gaps.push_back({a, b, c});
    };
    const auto addStripEnd = [&](int from, int to) { add(first.try_emplace(one[from], from).first->second, to, from); };
    for (const auto& [key, sides] : edges)
        for (std::size_t i = 0; i < std::min(sides[0].size(), sides[1].size()); ++i) {
            const auto& [u, v] = sides[0][i];
            const auto& [w, o] = sides[1][i];  // beside v and u
            add(v, u, o);
            add(v, o, w);
            addStripEnd(u, o);
            addStripEnd(w, v);
        }
    return gaps;
}

// ½ (b - a) × (c - a): of a triangle its area, along its normal.
inline dvec3 areaOf(const dvec3& a, const dvec3& b, const dvec3& c) {
    return 0.5 * glm::cross(b - a, c - a);
}

}  // namespace

std::vector<Chamber> chambersOf(std::span<const Triangle> all, std::span<const dvec3> places,
                                std::span<const int> one) {
    const std::vector<Triangle> triangles = thatEnclose(all, one);
    const Edges edges = edgesOf(triangles, one);
    std::vector<std::vector<std::pair<std::size_t, bool>>> beside(triangles.size());  // and whether turned alike
    for (const auto& [edge, sides] : edges)
        for (std::size_t k = 1; k < sides.size(); ++k) {
            const bool isTwo = sides.size() == 2;
            if (!isTwo && !isShared(sides)) break;
            const bool isAlike = !isTwo || sides[0].isForward != sides[1].isForward;
            beside[sides[0].triangle].emplace_back(sides[k].triangle, isAlike);
            beside[sides[k].triangle].emplace_back(sides[0].triangle, isAlike);
        }
    std::vector<Chamber> chambers;
    std::vector<std::size_t> chamberOf(triangles.size(), triangles.size());
    std::vector<bool> isTurned(triangles.size(), false);
    for (std::size_t first = 0; first < triangles.size(); ++first) {
        if (chamberOf[first] < triangles.size()) continue;
        Chamber& chamber = chambers.emplace_back();
        std::vector<std::size_t> found{first};
        std::size_t turned = 0;
        chamberOf[first] = chambers.size() - 1;
        for (std::size_t next = 0; next < found.size(); ++next) {
            const std::size_t t = found[next];
            turned += isTurned[t] ? 1 : 0;
            chamber.triangles.push_back(triangles[t]);
            if (isTurned[t]) std::swap(chamber.triangles.back()[1], chamber.triangles.back()[2]);
            for (const auto& [other, isAlike] : beside[t]) {
                const bool wanted = isTurned[t] == isAlike;
                if (chamberOf[other] < triangles.size()) {
                    chamber.isTwisted = chamber.isTwisted || isTurned[other] != wanted;
                    continue;
                }
                chamberOf[other] = chambers.size() - 1;
                isTurned[other] = wanted;
                found.push_back(other);
            }
        }
        if (!one.empty()) {
            const std::vector<Triangle> gaps = gapsIn(chamber.triangles, one);
            chamber.triangles.insert(chamber.triangles.end(), gaps.begin(), gaps.end());
        }
        const double volume = enclosed(chamber.triangles, [&](int i) { return places[i]; });
        double size = 0.0;  // of a cube with as much surface
        for (const Triangle& t : chamber.triangles)
            size += glm::length(areaOf(places[t[0]], places[t[1]], places[t[2]]));
        size = std::sqrt(size / 6.0) * size / 6.0;
        const bool isFlat = !(std::abs(volume) > 1e-9 * size);
        if (isFlat ? 2 * turned > found.size() : volume < 0)
            for (Triangle& t : chamber.triangles) std::swap(t[1], t[2]);
        chamber.firstVolume = isFlat ? 0.0 : std::abs(volume);
    }
    for (const auto& [edge, sides] : edges)
        if (sides.size() != 2 && !isShared(sides)) ++chambers[chamberOf[sides[0].triangle]].openEdges;
    return chambers;
}

template <class Real>
Filling<Real>::Filling(std::vector<Chamber> chambers, std::span<const dvec3> places, const FillingLaw& law,
                       const LinearPathOf<double>& pressure)
    : chambers_(std::move(chambers)), places_(places.begin(), places.end()), law_(law), pressure_(pressure) {
    for (const Chamber& chamber : chambers_)
        TAUT_EXPECTS(chamber.isClosed() && (law.keeps == FillingKeeps::pressure || chamber.firstVolume > 0));
}

template <class Real>
typename Filling<Real>::State Filling<Real>::stateOf(const Chamber& chamber, double volume, double t) const {
    const double pressure = pressure_.at(t), first = chamber.firstVolume;
    switch (law_.keeps) {
        case FillingKeeps::pressure: {
            if (pressure >= 0 || volume >= softShare * first) break;
            if (!(volume > 0)) return {};
            return {pressure * volume / (softShare * first), -pressure / (softShare * first)};
        }
        case FillingKeeps::amount: {
            const double bounded = std::max(volume, leastShare * first);
            const double inside = (law_.sealedIn + pressure) * first / bounded;
            return {inside - law_.outside, volume < bounded ? 0.0 : inside / bounded};
        }
        case FillingKeeps::volume:
            return {pressure + law_.bulkModulus * (1.0 - volume / first), law_.bulkModulus / first};
    }
    return {pressure, 0.0};
}

template <class Real>
double Filling<Real>::volumeOf(const Chamber& chamber, const Motion<Real>& motion) const {
    return enclosed(
        chamber.triangles, [&](int i) { return vectorAt(motion.x, motion.stride, i); });
}

template <class Real>
void Filling<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    TAUT_EXPECTS(first == 0 && last == motion.count);
    for (const Chamber& chamber : chambers_) {
        areas_.clear();
        const dvec3 origin = vectorAt(motion.x, motion.stride, chamber.triangles[0][0]);
        double threefold = 0.0;  // of the volume, as enclosed() has it
        for (const auto& [a, b, c] : chamber.triangles) {
            const dvec3 from = vectorAt(motion.x, motion.stride, a);
            areas_.push_back(areaOf(from, vectorAt(motion.x, motion.stride, b), vectorAt(motion.x, motion.stride, c)));
            threefold += glm::dot(from - origin, areas_.back());
        }
        const double third = stateOf(chamber, threefold / 3.0, motion.t).excess / 3.0;
        for (std::size_t k = 0; k < areas_.size(); ++k) {
            const auto& [a, b, c] = chamber.triangles[k];
            const dvec3 force = third * areas_[k];
            for (int axis = 0; axis < 3; ++axis) {
                const Real each = static_cast<Real>(force[axis]);
                Real* plane = f + static_cast<std::ptrdiff_t>(axis) * motion.stride;
                plane[a] += each;
                plane[b] += each;
                plane[c] += each;
            }
        }
    }
}

template <class Real>
double Filling<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    double energy = 0.0;
    const double pressure = pressure_.at(motion.t);
    for (const Chamber& chamber : chambers_) {
        const auto isLeftOut = [&](const Triangle& t) {
            return !std::all_of(t.begin(), t.end(), [&](int i) { return only[i]; });
        };
        if (!only.empty() && std::any_of(chamber.triangles.begin(), chamber.triangles.end(), isLeftOut)) continue;
        const double v = volumeOf(chamber, motion), v0 = chamber.firstVolume;
        switch (law_.keeps) {
            case FillingKeeps::pressure: {
                const double soft = softShare * v0;
                if (pressure >= 0)
                    energy -= pressure * v;
                else
                    energy -= pressure * (v >= soft ? v - 0.5 * soft : v > 0 ? 0.5 * v * v / soft : 0.0);
                break;
            }
            case FillingKeeps::amount: {
                const double inside = (law_.sealedIn + pressure) * v0, least = leastShare * v0;
                energy += law_.outside * (v - v0) - inside * std::log(std::max(v, least) / v0);
                if (v < least) energy += inside / least * (least - v);
                break;
            }
            case FillingKeeps::volume:
                energy += 0.5 * law_.bulkModulus * (v - v0) * (v - v0) / v0 - pressure * v;
                break;
        }
    }
    return energy;
}

template <class Real>
void Filling<Real>::addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const {
    const std::ptrdiff_t stride = motion.stride;
    for (const Chamber& chamber : chambers_) {
        const State state = stateOf(chamber, volumeOf(chamber, motion), motion.t);
        double grown = 0.0;  // g·u
        for (const auto& [a, b, c] : chamber.triangles)
            grown += glm::dot(areaOf(vectorAt(motion.x, stride, a), vectorAt(motion.x, stride, b),
                                     vectorAt(motion.x, stride, c)),
                              vectorAt(u, stride, a) + vectorAt(u, stride, b) + vectorAt(u, stride, c)) /
                     3.0;
        for (const auto& [a, b, c] : chamber.triangles) {
            const dvec3 xa = vectorAt(motion.x, stride, a), ab = vectorAt(motion.x, stride, b) - xa,
                        ac = vectorAt(motion.x, stride, c) - xa, ua = vectorAt(u, stride, a),
                        ub = vectorAt(u, stride, b) - ua, uc = vectorAt(u, stride, c) - ua;
            const dvec3 turned = 0.5 * (glm::cross(ub, ac) + glm::cross(ab, uc));
            const dvec3 product = (state.slope * grown * 0.5 * glm::cross(ab, ac) - state.excess * turned) / 3.0;
            for (int axis = 0; axis < 3; ++axis)
                for (const int i : {a, b, c}) out[axis * stride + i] += static_cast<Real>(product[axis]);
        }
    }
}

template <class Real>
void Filling<Real>::linearise(const Motion<Real>& motion, double stiffness, double) {
    slopes_.clear();
    for (const Chamber& chamber : chambers_) {
        const double slope = stateOf(chamber, volumeOf(chamber, motion), motion.t).slope;
        if (slope == 0.0) continue;
        std::map<int, dvec3> gradients;
        for (const auto& [a, b, c] : chamber.triangles) {
            const dvec3 third = areaOf(vectorAt(motion.x, motion.stride, a), vectorAt(motion.x, motion.stride, b),
                                       vectorAt(motion.x, motion.stride, c)) /
                                3.0;
            for (const int i : {a, b, c}) gradients.try_emplace(i, 0.0).first->second += third;
        }
        Slope& kept = slopes_.emplace_back();
        const double root = std::sqrt(stiffness * slope);
        for (const auto& [point, gradient] : gradients) {
            kept.points.push_back(point);
            for (int axis = 0; axis < 3; ++axis) kept.of.push_back(static_cast<Real>(root * gradient[axis]));
        }
    }
}

template <class Real>
void Filling<Real>::addProduct(int stride, const Real* u, Real* out) const {
    for (const Slope& slope : slopes_) {
        Real along = 0;
        for (std::size_t i = 0; i < slope.of.size(); ++i)
            along += slope.of[i] * u[static_cast<int>(i % 3) * stride + slope.points[i / 3]];
        for (std::size_t i = 0; i < slope.of.size(); ++i)
            out[static_cast<int>(i % 3) * stride + slope.points[i / 3]] += along * slope.of[i];
    }
}

template <class Real>
void Filling<Real>::addDiagonal(int stride, Real* out) const {
    for (const Slope& slope : slopes_)
        for (std::size_t i = 0; i < slope.of.size(); ++i)
            out[static_cast<int>(i % 3) * stride + slope.points[i / 3]] += slope.of[i] * slope.of[i];
}

template <class Real>
void Filling<Real>::addStability(const Motion<Real>& motion, StabilityShare& share) const {
    for (const Chamber& chamber : chambers_) {
        const bool isGas = law_.keeps == FillingKeeps::amount;
        const double smallest = isGas ? workingShare * chamber.firstVolume : chamber.firstVolume;
        const double pressure = std::max(std::abs(pressure_.from), std::abs(pressure_.to));
        State most = stateOf(chamber, smallest, motion.t);
        if (isGas) most.slope = (law_.sealedIn + pressure) * chamber.firstVolume / (smallest * smallest);
        if (const double least = std::min(pressure_.from, pressure_.to);
            law_.keeps == FillingKeeps::pressure && least < 0 && smallest > 0)
            most.slope = -least / (softShare * smallest);
        most.excess = std::max(std::abs(most.excess), pressure);
        std::map<int, double> areas;
        for (const auto& t : chamber.triangles) {
            dvec3 corners[3];
            for (std::size_t k = 0; k < 3; ++k) corners[k] = places_[t[k]];
            const double perimeter = glm::length(corners[1] - corners[0]) + glm::length(corners[2] - corners[1]) +
                                     glm::length(corners[0] - corners[2]);
            const double third = glm::length(areaOf(corners[0], corners[1], corners[2])) / 3.0;
            for (const int i : t) {
                share.stiffness[i] += workingStretch * most.excess * perimeter / 6.0;
                areas[i] += third * workingStretch * workingStretch;
            }
        }
        double eigenvalue = 0.0;  // [1/s²]
        for (const auto& [i, area] : areas)
            eigenvalue += most.slope * area * area * static_cast<double>(motion.inverseMass[i]);
        for (const auto& [i, area] : areas)
            if (motion.inverseMass[i] > 0)
                share.stiffness[i] += eigenvalue / static_cast<double>(motion.inverseMass[i]);
    }
}

template class Filling<float>;
template class Filling<double>;

}  // namespace taut::mechanics
