// The flatness certificate (bvh.h): proves that leaves of a flat surface move so nearly as a rigid body that no two of
// their parts touch.
//
// Cheap bounds come first. Each leaf has its own R and `least`. Several leaves need one common R. Turning R by an angle
// φ takes a unit vector t to another direction, and t·RᵀF t loses at most
//
//     least (1 - cos φ) + sqrt(most² - least²) sin φ
//
// If this bound is too weak, the gradients of the leaf are tested against the common R one by one.
#include <algorithm>
#include <array>
#include <cmath>

#include "taut/contact/bvh.h"
#include "taut/contact/closest_points.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr double bumps = 0.05;           // of an edge: a surface whose points rise less is flat
constexpr double gaps = 2e-3;            // of the hull's area: a surface that leaves no more of it empty is convex
constexpr double plenty = 1.15;          // of the required flatness: a bound above it needs no closer look
constexpr double reachIn = 1e-3;         // of an edge
constexpr std::size_t mostBetween = 48;  // leaves
constexpr int measuredAtOnce = 16;       // leaves per task

double twiceArea(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The area of the convex hull, by Andrew's monotone chain.
double hullArea(std::vector<glm::dvec2> points) {
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<glm::dvec2> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t start = hull.size();
        for (const glm::dvec2& p : points) {
            while (hull.size() >= start + 2 && twiceArea(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    double area = 0;
    for (std::size_t i = 2; i < hull.size(); ++i) area += 0.5 * twiceArea(hull[0], hull[i - 1], hull[i]);
    return area;
}

// The least of t·RᵀF t over all unit t, from the symmetric part of RᵀF. R has the columns right and up, F has the
// columns fRight and fUp.
double leastAlong(const dvec3& right, const dvec3& up, const dvec3& fRight, const dvec3& fUp) {
    const double a = glm::dot(right, fRight), d = glm::dot(up, fUp);
    const double b = 0.5 * (glm::dot(right, fUp) + glm::dot(up, fRight)), half = 0.5 * (a - d);
    return 0.5 * (a + d) - std::sqrt(half * half + b * b);
}

}  // namespace

// A surface is flat if all its points lie in one plane, and convex if its triangles fill their convex hull. Small bumps
// and gaps are allowed, because builders make some to break symmetry.
void Bvh::findPlane(int number, const dvec3& along) {
    planes_.emplace_back();
    const ContactSurface& surface = elements_.surface(number);
    if (surface.triangles.empty() || !surface.meetsItself) return;
    const auto at = [&](int i) { return elements_.rest()[static_cast<std::size_t>(i)]; };
    // The plane through the first corner with the mean normal.
    dvec3 normal(0.0);
    double area = 0;
    for (const std::array<int, 3>& t : surface.triangles) {
        const dvec3 own = glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
        normal += own;
        area += 0.5 * length(own);
    }
    const double total = length(normal);
    if (!(total > 0)) return;
    normal /= total;
    const dvec3 origin = at(surface.triangles.front()[0]);
    dvec3 right = along - glm::dot(along, normal) * normal;
    right /= length(right);
    const dvec3 up = glm::cross(normal, right);
    // Points in coordinates of the plane: too high ones mean not flat, too large a hull means not convex.
    std::vector<glm::dvec2> flat;
    for (int i : surface.points) {
        const dvec3 d = at(i) - origin;
        if (std::abs(glm::dot(d, normal)) > bumps * elements_.shortestEdge(number)) return;
        flat.emplace_back(glm::dot(d, right), glm::dot(d, up));
    }
    if (area < (1 - gaps) * hullArea(std::move(flat))) return;
    planes_.back() = Plane{right, up};
}

void Bvh::prepareFlatness() {
    inverses_.resize(elements_.triangles().size());
    restBoxes_.resize(leaves_.size());
    altitudes_.assign(elements_.surfaces().size(), 1e300);
    firstGradient_.assign(1, 0);
    for (std::size_t p = 0; p < leaves_.size(); ++p) {
        const std::optional<Plane>& plane = planes_[static_cast<std::size_t>(leaves_[p].surface)];
        firstGradient_.push_back(firstGradient_.back() + (plane ? 2 * leaves_[p].triangles.size() : 0));
        if (!plane) continue;
        const auto flat = [&](int i) {
            const dvec3& x = elements_.rest()[static_cast<std::size_t>(i)];
            return Rest2(glm::dot(x, plane->right), glm::dot(x, plane->up));
        };
        // The leaf's box in the plane at rest.
        for (int i : leaves_[p].corners) {
            restBoxes_[p].low = glm::min(restBoxes_[p].low, flat(i));
            restBoxes_[p].high = glm::max(restBoxes_[p].high, flat(i));
        }
        // The inverse edge matrix of each triangle, and the smallest altitude of the surface's triangles.
        for (int t : leaves_[p].triangles) {
            const std::array<int, 3>& corners = elements_.triangles()[static_cast<std::size_t>(t)].points;
            const Rest2 u = flat(corners[1]) - flat(corners[0]), v = flat(corners[2]) - flat(corners[0]);
            const double det = u.x * v.y - u.y * v.x;
            inverses_[static_cast<std::size_t>(t)] = {v.y / det, -v.x / det, -u.y / det, u.x / det};
            const Rest2 w = v - u;
            const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
            double& altitude = altitudes_[static_cast<std::size_t>(leaves_[p].surface)];
            altitude = std::min(altitude, std::abs(det) / std::sqrt(longest));
        }
    }
    gradients_.resize(firstGradient_.back());
    constexpr double hair = 1.02;  // reserve for the bumps and gaps
    for (std::size_t k = 0; k < elements_.surfaces().size(); ++k)
        requiredFlatness_.push_back(hair * nearShare *
                                    std::min(restShare, 2 * elements_.surfaces()[k].thickness / altitudes_[k]));
}

void Bvh::measureFlatness(std::span<const int> leaves, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    toMeasure_.clear();
    for (int p : leaves) {
        char& isMeasured = isMeasured_[static_cast<std::size_t>(p)];
        if (isMeasured != 0) continue;
        isMeasured = 1;
        toMeasure_.push_back(p);
    }
    const int count = static_cast<int>(toMeasure_.size());
    core::parallelFor((count + measuredAtOnce - 1) / measuredAtOnce, [&](int task) {
        for (int k = task * measuredAtOnce; k < std::min((task + 1) * measuredAtOnce, count); ++k)
            measureOne(static_cast<std::size_t>(toMeasure_[static_cast<std::size_t>(k)]), x0, x1);
    });
}

void Bvh::measureOne(std::size_t number, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    const BvhLeaf& leaf = leaves_[number];
    Flatness flatness;
    Gradient* gradients = gradients_.data() + firstGradient_[number];
    std::size_t count = 0;
    // F of each triangle at x0 and x1, and their sum. A leaf that lost a triangle gets no bound.
    for (int t : leaf.triangles) {
        const Triangle& triangle = elements_.triangles()[static_cast<std::size_t>(t)];
        if (triangle.isGone) {
            flatness_[number] = flatness;
            return;
        }
        const Inverse& inverse = inverses_[static_cast<std::size_t>(t)];
        for (const auto& x : {x0, x1}) {
            const dvec3 origin = x[static_cast<std::size_t>(triangle.points[0])];
            const dvec3 u = x[static_cast<std::size_t>(triangle.points[1])] - origin;
            const dvec3 v = x[static_cast<std::size_t>(triangle.points[2])] - origin;
            gradients[count] = {inverse.a * u + inverse.c * v, inverse.b * u + inverse.d * v};
            flatness.right += gradients[count].right;
            flatness.up += gradients[count].up;
            ++count;
        }
    }
    // R: the mean of all F, made orthonormal.
    const double size = length(flatness.right);
    if (!(size > 0)) return void(flatness_[number] = {});
    flatness.right /= size;
    flatness.up -= glm::dot(flatness.up, flatness.right) * flatness.right;
    const double height = length(flatness.up);
    if (!(height > 0)) return void(flatness_[number] = {});
    flatness.up /= height;
    // Bounds over all F; `most` is the root of the larger eigenvalue of FᵀF.
    double least = 1e300, most = 0;
    for (std::size_t g = 0; g < count; ++g) {
        const Gradient& f = gradients[g];
        least = std::min(least, leastAlong(flatness.right, flatness.up, f.right, f.up));
        const double p = glm::dot(f.right, f.right), q = glm::dot(f.up, f.up), r = glm::dot(f.right, f.up);
        most = std::max(most, 0.5 * (p + q) + std::sqrt(0.25 * (p - q) * (p - q) + r * r));
    }
    flatness.normal = glm::cross(flatness.right, flatness.up);
    flatness.least = least;
    flatness.most = std::sqrt(most);
    flatness_[number] = flatness;
}

std::vector<int> Bvh::leavesBetween(int a, int b) const {
    const int surface = leaves_[static_cast<std::size_t>(a)].surface;
    std::vector<int> found;
    if (surface != leaves_[static_cast<std::size_t>(b)].surface || !planes_[static_cast<std::size_t>(surface)])
        return found;
    const RestBox &boxA = restBoxes_[static_cast<std::size_t>(a)], &boxB = restBoxes_[static_cast<std::size_t>(b)];
    // A straight line between the two leaves stays in this box. Leaves that reach into it by a hair are left out.
    const double in = reachIn * elements_.shortestEdge(surface);
    const RestBox box{glm::min(boxA.low, boxB.low) + in, glm::max(boxA.high, boxB.high) - in};
    for (std::size_t p = 0; p < leaves_.size(); ++p) {
        if (leaves_[p].surface != surface) continue;
        const RestBox& own = restBoxes_[p];
        if (own.low.x > box.high.x || own.low.y > box.high.y || box.low.x > own.high.x || box.low.y > own.high.y)
            continue;
        if (found.size() == mostBetween) return {};
        found.push_back(static_cast<int>(p));
    }
    return found;
}

double Bvh::flatness(std::span<const int> leaves) const {
    if (leaves.empty()) return -1.0;
    const double least = requiredFlatness(leaves_[static_cast<std::size_t>(leaves.front())].surface);
    // The common R: the mean of all R, made orthonormal.
    dvec3 right(0.0), up(0.0);
    for (int p : leaves) {
        const Flatness& own = flatness_[static_cast<std::size_t>(p)];
        if (own.least < least) return -1.0;
        right += own.right;
        up += own.up;
    }
    const double size = length(right);
    if (!(size > 0)) return -1.0;
    right /= size;
    up -= glm::dot(up, right) * right;
    const double height = length(up);
    if (!(height > 0)) return -1.0;
    up /= height;
    const dvec3 normal = glm::cross(right, up);
    double flattest = 1e300;
    for (int p : leaves) {
        const Flatness& own = flatness_[static_cast<std::size_t>(p)];
        // The angle between the leaf's R and the common R, from the trace. Then the bound above.
        const double trace = glm::dot(right, own.right) + glm::dot(up, own.up) + glm::dot(normal, own.normal);
        const double cosine = std::min(1.0, 0.5 * (trace - 1.0));
        if (!(cosine > 0)) return -1.0;
        const double aside = std::sqrt(std::max(0.0, own.most * own.most - own.least * own.least));
        const double bound = own.least * cosine - aside * std::sqrt(1.0 - cosine * cosine);
        if (bound >= plenty * least) {
            flattest = std::min(flattest, bound);
            continue;
        }
        // The bound is too weak: test each gradient.
        const std::size_t last = firstGradient_[static_cast<std::size_t>(p) + 1];
        for (std::size_t g = firstGradient_[static_cast<std::size_t>(p)]; g < last; ++g)
            flattest = std::min(flattest, leastAlong(right, up, gradients_[g].right, gradients_[g].up));
        if (flattest < least) return -1.0;
    }
    return flattest;
}

}  // namespace taut::contact
