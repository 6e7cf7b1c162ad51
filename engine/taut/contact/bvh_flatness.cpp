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
constexpr int flatAtOnce = 16;           // leaves per task

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

}  // namespace

// A surface is flat if all its points lie in one plane, and convex if its triangles fill their convex hull. Small bumps
// and gaps are allowed, because builders make some to break symmetry.
void Bvh::findPlane(int number, const dvec3& along) {
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
    planes_[static_cast<std::size_t>(number)] = Plane{right, up};
}

void Bvh::prepareFlatness() {
    altitudes_.assign(elements_.surfaces().size(), 1e300);
    firstInPlanes_.assign(1, 0);
    for (std::size_t p = 0; p < leaves_.size(); ++p) {
        const std::optional<Plane>& plane = planes_[static_cast<std::size_t>(leaves_[p].surface)];
        const std::size_t count = plane ? leaves_[p].triangles.size() : 0;
        firstInPlanes_.push_back(firstInPlanes_.back() + count);
        inverses_.resize(4 * firstInPlanes_.back());
        double* inverse = inverses_.data() + 4 * firstInPlanes_[p];
        if (!plane) continue;
        const auto flat = [&](int i) {
            const dvec3& x = elements_.rest()[static_cast<std::size_t>(i)];
            return Rest2(glm::dot(x, plane->right), glm::dot(x, plane->up));
        };
        // The inverse edge matrix of each triangle, and the smallest altitude of the surface's triangles.
        for (int t : leaves_[p].triangles) {
            const std::array<int, 3>& corners = elements_.triangles()[static_cast<std::size_t>(t)].points;
            const Rest2 u = flat(corners[1]) - flat(corners[0]), v = flat(corners[2]) - flat(corners[0]);
            const double det = u.x * v.y - u.y * v.x;
            inverse[0] = v.y / det;
            inverse[count] = -v.x / det;
            inverse[2 * count] = -u.y / det;
            inverse[3 * count] = u.x / det;
            ++inverse;
            const Rest2 w = v - u;
            const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
            double& altitude = altitudes_[static_cast<std::size_t>(leaves_[p].surface)];
            altitude = std::min(altitude, std::abs(det) / std::sqrt(longest));
        }
    }
    gradients_.resize(12 * firstInPlanes_.back());
    // The boxes at rest of leaves and what is above them; children come before parents.
    restBoxes_.resize(nodes_.size());
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        if (node.surface < 0 || !planes_[static_cast<std::size_t>(node.surface)]) continue;
        const auto of = [&](int child) -> const RestBox& { return restBoxes_[static_cast<std::size_t>(child)]; };
        restBoxes_[n] = node.leaf < 0 ? of(node.left).joined(of(node.right)) : restBoxOf(node.leaf);
    }
    constexpr double hair = 1.02;  // reserve for the bumps and gaps
    for (std::size_t k = 0; k < elements_.surfaces().size(); ++k)
        requiredFlatness_.push_back(hair * nearShare *
                                    std::min(restShare, 2 * elements_.surfaces()[k].thickness / altitudes_[k]));
}

// In the plane of its surface, which has one.
Bvh::RestBox Bvh::restBoxOf(int leaf) const {
    const BvhLeaf& own = leaves_[static_cast<std::size_t>(leaf)];
    const Plane& plane = *planes_[static_cast<std::size_t>(own.surface)];
    RestBox box;
    for (int i : own.corners) {
        const dvec3& x = elements_.rest()[static_cast<std::size_t>(i)];
        const Rest2 at(glm::dot(x, plane.right), glm::dot(x, plane.up));
        box = box.joined({at, at});
    }
    return box;
}

void Bvh::measureFlatness(std::span<const int> leaves, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    toMeasure_.clear();
    for (int p : leaves) {
        char& isMeasured = isMeasured_[static_cast<std::size_t>(p)];
        if (isMeasured != 0) continue;
        isMeasured = 1;
        toMeasure_.push_back(p);
    }
    core::parallelFor(static_cast<int>(toMeasure_.size()), flatAtOnce, [&](int k) {
        measureOne(static_cast<std::size_t>(toMeasure_[static_cast<std::size_t>(k)]), x0, x1);
    });
}

GradientRows Bvh::gradientsOf(std::size_t leaf) const {
    return {static_cast<int>(2 * leaves_[leaf].triangles.size()), gradients_.data() + 12 * firstInPlanes_[leaf]};
}

void Bvh::measureOne(std::size_t number, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    const BvhLeaf& leaf = leaves_[number];
    const std::size_t n = leaf.triangles.size();
    const FlatnessKernels kernels = flatnessKernels();
    const GradientRows gradients = gradientsOf(number);
    Flatness& flatness = flatness_[number] = {};
    // A leaf that lost a triangle gets no bound.
    for (int t : leaf.triangles)
        if (elements_.triangles()[static_cast<std::size_t>(t)].isGone) return;
    // F of each triangle at x0, then at x1.
    thread_local std::vector<double> scratch;
    scratch.resize(6 * n);
    const auto row = [&](std::size_t k) { return scratch.data() + k * n; };
    const double* inverse = inverses_.data() + 4 * firstInPlanes_[number];
    for (const std::size_t half : {0U, 1U}) {
        const std::span<const dvec3> x = half == 0 ? x0 : x1;
        for (std::size_t i = 0; i < n; ++i) {
            const std::array<int, 3>& c = elements_.triangles()[static_cast<std::size_t>(leaf.triangles[i])].points;
            const dvec3 origin = x[static_cast<std::size_t>(c[0])];
            const dvec3 u = x[static_cast<std::size_t>(c[1])] - origin, v = x[static_cast<std::size_t>(c[2])] - origin;
            for (std::size_t k = 0; k < 3; ++k) {
                row(k)[i] = u[static_cast<int>(k)];
                row(k + 3)[i] = v[static_cast<int>(k)];
            }
        }
        kernels.findGradients({static_cast<int>(n),
                               {row(0), row(1), row(2)},
                               {row(3), row(4), row(5)},
                               {inverse, inverse + n, inverse + 2 * n, inverse + 3 * n}},
                              gradients_.data() + 12 * firstInPlanes_[number] + half * n, gradients.n);
    }
    // R: the mean of all F, made orthonormal.
    for (std::size_t i = 0; i < n; ++i)
        for (const std::size_t at : {i, n + i}) {
            const double* own = gradients.rows + at;
            flatness.right += dvec3(own[0], own[2 * n], own[4 * n]);
            flatness.up += dvec3(own[6 * n], own[8 * n], own[10 * n]);
        }
    const double size = length(flatness.right);
    if (!(size > 0)) return void(flatness = {});
    flatness.right /= size;
    flatness.up -= glm::dot(flatness.up, flatness.right) * flatness.right;
    const double height = length(flatness.up);
    if (!(height > 0)) return void(flatness = {});
    flatness.up /= height;
    flatness.normal = glm::cross(flatness.right, flatness.up);
    // Bounds over all F.
    kernels.findLeast(gradients, &flatness.right[0], &flatness.up[0], scratch.data());
    flatness.least = *std::min_element(scratch.data(), scratch.data() + 2 * n);
    kernels.findMost(gradients, scratch.data());
    flatness.most = std::sqrt(*std::max_element(scratch.data(), scratch.data() + 2 * n));
}

std::vector<int> Bvh::leavesBetween(int a, int b) const {
    const int surface = leaves_[static_cast<std::size_t>(a)].surface;
    std::vector<int> found;
    if (surface != leaves_[static_cast<std::size_t>(b)].surface || !planes_[static_cast<std::size_t>(surface)])
        return found;
    const RestBox boxA = restBoxOf(a), boxB = restBoxOf(b);
    // A straight line between the two leaves stays in this box. Leaves that reach into it by a hair are left out.
    const double in = reachIn * elements_.shortestEdge(surface);
    const RestBox box{glm::min(boxA.low, boxB.low) + in, glm::max(boxA.high, boxB.high) - in};
    findLeavesIn(box, planeRoots_[static_cast<std::size_t>(surface)], found);
    if (found.size() > mostBetween) return {};
    std::sort(found.begin(), found.end());
    return found;
}

void Bvh::findLeavesIn(const RestBox& box, int number, std::vector<int>& leaves) const {
    if (leaves.size() > mostBetween || !restBoxes_[static_cast<std::size_t>(number)].overlaps(box)) return;
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.leaf >= 0) return leaves.push_back(node.leaf);
    findLeavesIn(box, node.left, leaves);
    findLeavesIn(box, node.right, leaves);
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
        thread_local std::vector<double> leasts;
        const GradientRows gradients = gradientsOf(static_cast<std::size_t>(p));
        leasts.resize(static_cast<std::size_t>(gradients.n));
        flatnessKernels().findLeast(gradients, &right[0], &up[0], leasts.data());
        flattest = std::min(flattest, *std::min_element(leasts.begin(), leasts.end()));
        if (flattest < least) return -1.0;
    }
    return flattest;
}

}  // namespace taut::contact
