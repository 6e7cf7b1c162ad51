#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "taut/core/error.h"
#include "taut/mechanics/bending_elements.h"
#include "taut/mechanics/private/rope_elements.h"

namespace taut::mechanics {
namespace {

using glm::dvec2;
using glm::dvec3;

// A patch whose largest weights are beyond this, in units of one over the triangle's size, is enlarged.
constexpr double largestWeights = 5.0;
constexpr int mostRings = 4;
// [times the triangle's size] A curvature below it counts as none: coordinates in files have six digits.
constexpr double leastCurvature = 1e-4;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}
std::size_t next(std::size_t side) {
    return (side + 1) % 3;
}
double cross(dvec2 a, dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

// A quadratic function of a place: 1, s, t, s²/2, st, t²/2.
using Quadratic = std::array<double, 6>;

Quadratic valueAt(dvec2 p) {
    return {1, p.x, p.y, 0.5 * p.x * p.x, p.x * p.y, 0.5 * p.y * p.y};
}
Quadratic slopeAt(dvec2 p, dvec2 way) {
    return {0, way.x, way.y, way.x * p.x, way.x * p.y + way.y * p.x, way.y * p.y};
}
double dot(const Quadratic& a, const Quadratic& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
    return sum;
}

// The sum of v vᵀ as its Cholesky factor. None if it is singular, to rounding.
class NormalEquations {
  public:
    void add(const Quadratic& v) {
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j <= i; ++j) rows_[i][j] += v[i] * v[j];
    }
    bool factorise() {
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = rows_[i][j];
                for (std::size_t k = 0; k < j; ++k) sum -= rows_[i][k] * rows_[j][k];
                if (i == j) {
                    if (!(sum > 1e-9 * rows_[i][i])) return false;
                    rows_[i][i] = std::sqrt(sum);
                } else {
                    rows_[i][j] = sum / rows_[j][j];
                }
            }
        return true;
    }
    Quadratic solve(Quadratic v) const {
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t k = 0; k < i; ++k) v[i] -= rows_[i][k] * v[k];
            v[i] /= rows_[i][i];
        }
        for (std::size_t i = 6; i-- > 0;) {
            for (std::size_t k = i + 1; k < 6; ++k) v[i] -= rows_[k][i] * v[k];
            v[i] /= rows_[i][i];
        }
        return v;
    }

  private:
    std::array<Quadratic, 6> rows_{};  // the lower half
};

// The outward slopes at the middles of a triangle's three sides, as sums over points.
struct Slopes {
    std::vector<int> points;
    std::vector<dvec3> weights;  // (points) of sides 0, 1, 2 [1/m]
};

class MeshElements {
  public:
    MeshElements(const Model& model, const std::vector<bool>& isHeld, const std::vector<bool>& isClamped,
                 const std::function<bool(int, int)>& isSevered)
        : model_(model), triangles_(model.triangles), isHeld_(isHeld), isClamped_(isClamped) {
        std::vector<bool> takesPart;
        for (const auto& [a, b, c] : triangles_)
            takesPart.push_back(!isSevered(a, b) && !isSevered(b, c) && !isSevered(c, a));
        findNeighbours(takesPart);
        for (std::size_t t = 0; t < triangles_.size(); ++t) layFlat(t);
        slopes_.resize(triangles_.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            if (takesPart[t] && !isWhollyHeld(t)) slopes_[t] = slopesOf(t);
    }

    std::vector<BendingElement> elements() const {
        std::vector<BendingElement> all;
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            if (!slopes_[t].points.empty()) all.push_back(elementOf(t));
        return all;
    }

  private:
    struct Neighbour {
        int triangle = -1;  // -1: none
        std::size_t side = 0;
    };

    const dvec3& rest(std::size_t t, std::size_t corner) const {
        return model_.freeform.rest[at(triangles_[t][corner])];
    }

    void findNeighbours(const std::vector<bool>& takesPart) {
        struct Use {
            std::pair<int, int> edge;
            std::size_t triangle, side;
        };
        std::vector<Use> uses;
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                if (takesPart[t]) uses.push_back({std::minmax(triangles_[t][k], triangles_[t][next(k)]), t, k});
        std::stable_sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.edge < b.edge; });
        neighbours_.resize(triangles_.size());
        for (std::size_t i = 0; i + 1 < uses.size(); ++i) {
            const Use &a = uses[i], &b = uses[i + 1];
            if (a.edge != b.edge) continue;
            neighbours_[a.triangle][a.side] = {static_cast<int>(b.triangle), b.side};
            neighbours_[b.triangle][b.side] = {static_cast<int>(a.triangle), a.side};
        }
    }

    // Corners in the triangle's own plane, from its first corner, u along the warp.
    void layFlat(std::size_t t) {
        const dvec3 e1 = rest(t, 1) - rest(t, 0), e2 = rest(t, 2) - rest(t, 0);
        const dvec3 n = glm::normalize(glm::cross(e1, e2)), u = model_.freeform.warp[t], v = glm::cross(n, u);
        flat_.push_back({dvec2(0.0), dvec2(glm::dot(e1, u), glm::dot(e1, v)), dvec2(glm::dot(e2, u), glm::dot(e2, v))});
        normals_.push_back(n);
        areas_.push_back(0.5 * cross(flat_[t][1], flat_[t][2]));
    }

    bool isWhollyHeld(std::size_t t) const {
        return std::all_of(
            triangles_[t].begin(), triangles_[t].end(), [&](int i) { return isHeld_[at(i)]; });
    }
    bool isBeyondHeld(std::size_t t, std::size_t side) const {
        const int beyond = neighbours_[t][side].triangle;
        return beyond >= 0 && isWhollyHeld(at(beyond));
    }
    bool isSlopeHeld(std::size_t t, std::size_t side) const {
        return (isClamped_[at(triangles_[t][side])] && isClamped_[at(triangles_[t][next(side)])]) ||
               isBeyondHeld(t, side);
    }

    dvec2 outward(std::size_t t, std::size_t side) const {  // unit
        const dvec2 e = glm::normalize(flat_[t][next(side)] - flat_[t][side]);
        return {e.y, -e.x};
    }

    // Of the linear function through the corners.
    Slopes linearSlopes(std::size_t t) const {
        Slopes slopes;
        for (std::size_t c = 0; c < 3; ++c) {
            const dvec2 e = flat_[t][next(next(c))] - flat_[t][next(c)];
            const dvec2 gradient = dvec2(-e.y, e.x) / (2 * areas_[t]);
            slopes.points.push_back(triangles_[t][c]);
            slopes.weights.emplace_back(glm::dot(gradient, outward(t, 0)), glm::dot(gradient, outward(t, 1)),
                                        glm::dot(gradient, outward(t, 2)));
        }
        return slopes;
    }

    // A triangle laid flat into the plane of another.
    struct Laid {
        std::size_t triangle;
        std::array<dvec2, 3> corners;
    };
    // The neighbour turned so that its side lies on side k of the other, which it goes along the other way.
    Laid laidBeside(const Laid& other, std::size_t k) const {
        const auto beyond = at(neighbours_[other.triangle][k].triangle);
        const std::size_t side = neighbours_[other.triangle][k].side;
        const auto& own = flat_[beyond];
        const dvec2 from = other.corners[next(k)], way = other.corners[k] - from, along = own[next(side)] - own[side];
        const dvec2 turn = dvec2(glm::dot(along, way), cross(along, way)) / glm::dot(along, along);
        Laid laid{beyond, {}};
        for (std::size_t c = 0; c < 3; ++c) {
            const dvec2 arm = own[c] - own[side];
            laid.corners[c] = from + dvec2(turn.x * arm.x - turn.y * arm.y, turn.x * arm.y + turn.y * arm.x);
        }
        return laid;
    }

    // Of the quadratic function that fits the corners of the triangle and of those around it, ring by ring until it is
    // determined well; six points determine it. Where there are too few it is the linear function.
    Slopes slopesOf(std::size_t t) const {
        const double size = std::sqrt(2 * areas_[t]);
        const dvec2 middle = (flat_[t][0] + flat_[t][1] + flat_[t][2]) / 3.0;
        std::vector<Laid> laid{{t, flat_[t]}};
        std::vector<int> points(triangles_[t].begin(), triangles_[t].end());
        std::vector<dvec2> places;
        for (const dvec2& p : flat_[t]) places.push_back((p - middle) / size);
        std::size_t first = 0;
        for (int ring = 0; ring < mostRings; ++ring) {
            const std::size_t last = laid.size();
            for (; first < last; ++first)
                for (std::size_t k = 0; k < 3; ++k) {
                    const Neighbour& beyond = neighbours_[laid[first].triangle][k];
                    if (beyond.triangle < 0 || isSlopeHeld(laid[first].triangle, k)) continue;
                    const auto isIt = [&](const Laid& l) { return l.triangle == at(beyond.triangle); };
                    if (std::any_of(laid.begin(), laid.end(), isIt)) continue;
                    laid.push_back(laidBeside(laid[first], k));
                    const std::size_t tip = next(next(beyond.side));
                    const int point = triangles_[at(beyond.triangle)][tip];
                    if (std::find(points.begin(), points.end(), point) != points.end()) continue;
                    points.push_back(point);
                    places.push_back((laid.back().corners[tip] - middle) / size);
                }
            if (points.size() < 6) continue;
            if (auto fit = fitted(t, places, middle, size)) return {std::move(points), std::move(*fit)};
        }
        return linearSlopes(t);
    }

    // None if the points do not determine a quadratic function well.
    std::optional<std::vector<dvec3>> fitted(std::size_t t, const std::vector<dvec2>& places, dvec2 middle,
                                             double size) const {
        NormalEquations equations;
        for (const dvec2& p : places) equations.add(valueAt(p));
        if (!equations.factorise()) return std::nullopt;
        std::vector<dvec3> weights(places.size());
        double squares = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const dvec2 halfWay = (0.5 * (flat_[t][k] + flat_[t][next(k)]) - middle) / size;
            const Quadratic slope = equations.solve(slopeAt(halfWay, outward(t, k)));
            for (std::size_t i = 0; i < places.size(); ++i) {
                const double weight = dot(valueAt(places[i]), slope);
                squares += weight * weight;
                weights[i][static_cast<int>(k)] = weight / size;
            }
        }
        if (squares > largestWeights * largestWeights) return std::nullopt;
        return weights;
    }

    static void add(BendingElement& element, int point, const dvec3& weight) {
        const auto found = std::find(element.points.begin(), element.points.end(), point);
        if (found != element.points.end()) {
            element.weights[at(static_cast<int>(found - element.points.begin()))] += weight;
            return;
        }
        element.points.push_back(point);
        element.weights.push_back(weight);
    }
    static void add(BendingElement& element, const Slopes& slopes, std::size_t side, const dvec3& factor) {
        for (std::size_t i = 0; i < slopes.points.size(); ++i)
            add(element, slopes.points[i], slopes.weights[i][static_cast<int>(side)] * factor);
    }

    BendingElement elementOf(std::size_t t) const {
        BendingElement element;
        element.corners = triangles_[t];
        for (const int i : triangles_[t]) add(element, i, dvec3(0.0));
        for (std::size_t k = 0; k < 3; ++k) {
            const dvec2 side = flat_[t][next(k)] - flat_[t][k], n = outward(t, k), e(-n.y, n.x);
            const dvec3 along = dvec3(n.x * e.x, n.y * e.y, 0.5 * (n.x * e.y + n.y * e.x)) / areas_[t];
            const dvec3 across = dvec3(n.x * n.x, n.y * n.y, n.x * n.y) * (glm::length(side) / areas_[t]);
            add(element, triangles_[t][next(k)], along);
            add(element, triangles_[t][k], -along);
            const auto [beyond, itsSide] = neighbours_[t][k];
            if (isBeyondHeld(t, k)) {
                add(element, linearSlopes(at(beyond)), itsSide, -across);
            } else if (isSlopeHeld(t, k)) {
                const dvec3 u = model_.freeform.warp[t], v = glm::cross(normals_[t], u);
                element.held += glm::outerProduct(n.x * u + n.y * v, across);
            } else if (beyond < 0) {
                add(element, slopes_[t], k, across);
            } else {
                add(element, slopes_[t], k, 0.5 * across);
                add(element, slopes_[at(beyond)], itsSide, -0.5 * across);
            }
        }
        const BendingRigidity& of = model_.freeform.rigidity;
        element.modulus = areas_[t] * glm::dmat3(of.along, of.both, 0, of.both, of.across, 0, 0, 0, of.twist);
        takeRest(element, t);
        return element;
    }

    // The curvature at rest: along the normal it is kept, in the plane it goes into the weights of the corners.
    void takeRest(BendingElement& element, std::size_t t) const {
        glm::dmat3 curvature = element.held;
        for (std::size_t i = 0; i < element.points.size(); ++i)
            curvature +=
                glm::outerProduct(model_.freeform.rest[at(element.points[i])] - rest(t, 0), element.weights[i]);
        const double least = leastCurvature / std::sqrt(2 * areas_[t]);
        if (std::max({glm::length(curvature[0]), glm::length(curvature[1]), glm::length(curvature[2])}) < least) return;
        const dvec3 n = normals_[t], e1 = rest(t, 1) - rest(t, 0), e2 = rest(t, 2) - rest(t, 0);
        const dvec3 toB = glm::cross(e2, n) / (2 * areas_[t]), toC = glm::cross(n, e1) / (2 * areas_[t]);
        const dvec3 ofB = toB * curvature, ofC = toC * curvature;
        add(element, element.corners[0], ofB + ofC);
        add(element, element.corners[1], -ofB);
        add(element, element.corners[2], -ofC);
        element.rest = n * curvature;
    }

    const Model& model_;
    const std::vector<std::array<int, 3>>& triangles_;
    const std::vector<bool>&isHeld_, &isClamped_;
    // (triangles)
    std::vector<std::array<Neighbour, 3>> neighbours_;  // across sides 0-1, 1-2, 2-0
    std::vector<std::array<dvec2, 3>> flat_;            // [m]
    std::vector<dvec3> normals_;                        // unit
    std::vector<double> areas_;                         // [m²]
    std::vector<Slopes> slopes_;                        // empty: takes no part
};

}  // namespace

std::vector<BendingElement> bendingElements(const Model& model, const std::vector<bool>& isHeld,
                                            const std::vector<bool>& isClamped,
                                            const std::function<bool(int, int)>& isSevered) {
    TAUT_EXPECTS(!model.freeform.isEmpty());
    if (model.freeform.warp.empty()) return ropeElements(model, isHeld, isClamped, isSevered);
    return MeshElements(model, isHeld, isClamped, isSevered).elements();
}

}  // namespace taut::mechanics
