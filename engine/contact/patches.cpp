#include "taut/contact/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "taut/contact/closest.h"
#include "taut/core/parallel.h"

namespace taut::contact {
namespace {

constexpr std::size_t patchSize = 12;         // elements at most
constexpr int atOnce = 16;                    // patches a task
constexpr double jitter = 0.05, gaps = 2e-3;  // of an edge, of the area
constexpr std::size_t mostAbout = 48;         // patches

double widest(const dvec3& size, int& axis) {
    axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return size[axis];
}

double twiceArea(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Of the convex hull, by Andrew's monotone chain.
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

Patches::Patches(const Elements& elements)
    : elements_(elements),
      patchOfPoint_(static_cast<std::size_t>(elements.pointCount()), -1),
      patchOfEdge_(static_cast<std::size_t>(elements.edgesWithoutBalls()), -1) {
    std::vector<int> roots;
    const std::vector<dvec3>& rest = elements.rest();
    const auto at = [&](int i) { return rest[static_cast<std::size_t>(i)]; };
    std::vector<dvec3> triangleCentres, edgeCentres;
    for (const Triangle& t : elements.triangles())
        triangleCentres.push_back((at(t.points[0]) + at(t.points[1]) + at(t.points[2])) / 3.0);
    for (int e = 0; e < elements.edgesWithoutBalls(); ++e) {
        const Edge& edge = elements.edges()[static_cast<std::size_t>(e)];
        edgeCentres.push_back(0.5 * (at(edge.a) + at(edge.b)));
    }
    for (int s = 0; s < static_cast<int>(elements.surfaces().size()); ++s) {
        findPlane(s);
        std::vector<int> triangles, lines;
        for (int t = elements.firstTriangleOf(s); t < elements.firstTriangleOf(s + 1); ++t) triangles.push_back(t);
        for (int e = elements.firstEdgeOf(s); e < elements.firstEdgeOf(s + 1); ++e)
            if (elements.edges()[static_cast<std::size_t>(e)].isLine) lines.push_back(e);
        if (!triangles.empty()) roots.push_back(addTree(std::move(triangles), triangleCentres, s, true));
        if (!lines.empty()) roots.push_back(addTree(std::move(lines), edgeCentres, s, false));
        // Points of neither, of which damage may have made balls.
        std::vector<int> others;
        for (int i : elements.surface(s).points)
            if (elements.surfaceOf(i) == s && patchOfPoint_[static_cast<std::size_t>(i)] < 0) others.push_back(i);
        if (others.empty()) continue;
        Patch patch;
        patch.surface = s;
        patch.points = patch.corners = std::move(others);
        for (int i : patch.points) patchOfPoint_[static_cast<std::size_t>(i)] = count();
        patches_.push_back(std::move(patch));
        nodes_.push_back({-1, -1, count() - 1, s, elements.surface(s).thickness});
        roots.push_back(static_cast<int>(nodes_.size()) - 1);
    }
    if (!roots.empty()) root_ = joinRoots(roots);
    motions_.resize(patches_.size());
    times_.resize(patches_.size());
    std::size_t corners = 0;
    for (const Patch& patch : patches_) {
        firstRemembered_.push_back(corners);
        corners += patch.corners.size();
    }
    remembered_.assign(corners, dvec3(1e150));
    firstAt_.assign(static_cast<std::size_t>(elements.pointCount()) + 1, 0);
    for (const Patch& patch : patches_)
        for (int i : patch.corners) ++firstAt_[static_cast<std::size_t>(i) + 1];
    for (std::size_t i = 1; i < firstAt_.size(); ++i) firstAt_[i] += firstAt_[i - 1];
    patchesAt_.resize(corners);
    std::vector<std::size_t> next(firstAt_.begin(), firstAt_.end() - 1);
    for (int p = 0; p < count(); ++p)
        for (int i : patches_[static_cast<std::size_t>(p)].corners) patchesAt_[next[static_cast<std::size_t>(i)]++] = p;
    boxes_.resize(nodes_.size());
    flatness_.resize(patches_.size());
    isKnown_.assign(patches_.size(), 0);
    prepareFlatness();
    takeBalls();
}

// Flat if all points lie in one plane, and convex if the triangles fill their convex hull; but for what breaks
// symmetry.
void Patches::findPlane(int number) {
    planes_.emplace_back();
    const Surface& surface = elements_.surface(number);
    if (surface.triangles.empty() || !surface.meetsItself) return;
    const auto at = [&](int i) { return elements_.rest()[static_cast<std::size_t>(i)]; };
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
    dvec3 right(0.0);
    for (int i : surface.points) {
        const dvec3 d = at(i) - origin;
        if (length(d) > length(right)) right = d;
    }
    right /= length(right);
    const dvec3 up = glm::cross(normal, right);
    std::vector<glm::dvec2> flat;
    for (int i : surface.points) {
        const dvec3 d = at(i) - origin;
        if (std::abs(glm::dot(d, normal)) > jitter * elements_.shortestEdge(number)) return;
        flat.emplace_back(glm::dot(d, right), glm::dot(d, up));
    }
    if (area < (1 - gaps) * hullArea(std::move(flat))) return;
    planes_.back() = Plane{right, up};
}

int Patches::addTree(std::vector<int> items, const std::vector<dvec3>& centres, int surface, bool areTriangles) {
    if (items.size() <= patchSize) return addPatch(items, surface, areTriangles);
    Box box;
    for (int i : items) box.add(centres[static_cast<std::size_t>(i)]);
    int axis = 0;
    widest(box.high - box.low, axis);
    const auto middle = items.begin() + std::ssize(items) / 2;
    std::nth_element(items.begin(), middle, items.end(), [&](int a, int b) {
        const double x = centres[static_cast<std::size_t>(a)][axis], y = centres[static_cast<std::size_t>(b)][axis];
        return x < y || (x == y && a < b);
    });
    std::vector<int> low(items.begin(), middle), high(middle, items.end());
    std::sort(low.begin(), low.end());
    std::sort(high.begin(), high.end());
    const int left = addTree(std::move(low), centres, surface, areTriangles);
    const int right = addTree(std::move(high), centres, surface, areTriangles);
    nodes_.push_back({left, right, -1, surface, elements_.surface(surface).thickness});
    return static_cast<int>(nodes_.size()) - 1;
}

int Patches::addPatch(const std::vector<int>& items, int surface, bool areTriangles) {
    const int number = count();
    Patch patch;
    patch.surface = surface;
    const auto addPoint = [&](int i) {
        patch.corners.push_back(i);
        int& owner = patchOfPoint_[static_cast<std::size_t>(i)];
        if (owner >= 0) return;
        owner = number;
        patch.points.push_back(i);
    };
    const auto addEdge = [&](int e) {
        int& owner = patchOfEdge_[static_cast<std::size_t>(e)];
        if (owner >= 0) return;
        owner = number;
        patch.edges.push_back(e);
    };
    for (int item : items) {
        if (areTriangles) {
            const Triangle& triangle = elements_.triangles()[static_cast<std::size_t>(item)];
            patch.triangles.push_back(item);
            for (int i : triangle.points) addPoint(i);
            for (int e : triangle.edges) addEdge(e);
        } else {
            const Edge& edge = elements_.edges()[static_cast<std::size_t>(item)];
            addPoint(edge.a);
            addPoint(edge.b);
            addEdge(item);
        }
    }
    for (std::vector<int>* list : {&patch.edges, &patch.points, &patch.corners}) {
        std::sort(list->begin(), list->end());
        list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    patches_.push_back(std::move(patch));
    nodes_.push_back({-1, -1, number, surface, elements_.surface(surface).thickness});
    return static_cast<int>(nodes_.size()) - 1;
}

int Patches::joinRoots(std::span<const int> roots) {
    if (roots.size() == 1) return roots.front();
    const int left = joinRoots(roots.first(roots.size() / 2)), right = joinRoots(roots.subspan(roots.size() / 2));
    const Node &a = nodes_[static_cast<std::size_t>(left)], &b = nodes_[static_cast<std::size_t>(right)];
    const int surface = a.surface == b.surface ? a.surface : -1;
    nodes_.push_back({left, right, -1, surface, std::max(a.thickness, b.thickness)});
    return static_cast<int>(nodes_.size()) - 1;
}

void Patches::takeBalls() {
    for (Patch& patch : patches_) std::erase_if(patch.edges, [&](int e) { return e >= elements_.edgesWithoutBalls(); });
    for (std::size_t e = static_cast<std::size_t>(elements_.edgesWithoutBalls()); e < elements_.edges().size(); ++e) {
        const int owner = patchOfPoint_[static_cast<std::size_t>(elements_.edges()[e].a)];
        patches_[static_cast<std::size_t>(owner)].edges.push_back(static_cast<int>(e));
    }
}

void Patches::remember(std::size_t number, std::span<const dvec3> x) {
    const PatchMotion& motion = motions_[number];
    dvec3* remembered = remembered_.data() + firstRemembered_[number];
    for (int i : patches_[number].corners) *remembered++ = x[static_cast<std::size_t>(i)] - motion.centre;
    ++times_[number];
}

void Patches::findWay(std::size_t number, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    const Patch& patch = patches_[number];
    PatchMotion& motion = motions_[number];
    dvec3 sum(0.0), ways(0.0);
    for (int i : patch.corners) {
        const dvec3 &from = x0[static_cast<std::size_t>(i)], &to = x1[static_cast<std::size_t>(i)];
        motion.box.add(from);
        motion.box.add(to);
        sum += from;
        ways += to - from;
    }
    const double share = 1.0 / static_cast<double>(patch.corners.size());
    motion.centre = share * sum;
    motion.way = share * ways;
    double square = 0;
    for (int i : patch.corners) {
        const dvec3 stray = x1[static_cast<std::size_t>(i)] - x0[static_cast<std::size_t>(i)] - motion.way;
        square = std::max(square, glm::dot(stray, stray));
    }
    motion.stray = std::sqrt(square);
}

void Patches::correct(std::span<const int> points, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    corrected_.clear();
    for (int i : points) {
        const auto own = static_cast<std::size_t>(i);
        for (std::size_t k = firstAt_[own]; k < firstAt_[own + 1]; ++k) corrected_.push_back(patchesAt_[k]);
    }
    std::sort(corrected_.begin(), corrected_.end());
    corrected_.erase(std::unique(corrected_.begin(), corrected_.end()), corrected_.end());
    for (int p : corrected_) findWay(static_cast<std::size_t>(p), x0, x1);
}

void Patches::follow(std::span<const dvec3> x0, std::span<const dvec3> x1, double most) {
    core::parallelFor((count() + atOnce - 1) / atOnce, [&](int task) {
        for (int p = task * atOnce; p < std::min((task + 1) * atOnce, count()); ++p) {
            const Patch& patch = patches_[static_cast<std::size_t>(p)];
            const bool isStill = elements_.isStill(patch.surface);
            char& isKnown = isKnown_[static_cast<std::size_t>(p)];
            if (isStill && isKnown != 0) continue;
            isKnown = isStill ? 1 : 0;
            PatchMotion& motion = motions_[static_cast<std::size_t>(p)];
            motion.box = {};
            findWay(static_cast<std::size_t>(p), x0, x1);
            const auto bend = [&] {
                const dvec3* remembered = remembered_.data() + firstRemembered_[static_cast<std::size_t>(p)];
                double bent = 0;
                for (int i : patch.corners) {
                    const dvec3 before = x0[static_cast<std::size_t>(i)] - motion.centre - *remembered;
                    const dvec3 after = x1[static_cast<std::size_t>(i)] - motion.centre - motion.way - *remembered;
                    bent = std::max({bent, glm::dot(before, before), glm::dot(after, after)});
                    ++remembered;
                }
                return std::sqrt(bent);
            };
            motion.bent = bend();
            if (most > 0 && !(motion.bent <= most)) {
                remember(static_cast<std::size_t>(p), x0);
                motion.bent = bend();
            }
            motion.times = times_[static_cast<std::size_t>(p)];
            if (planes_[static_cast<std::size_t>(patch.surface)]) measureFlatness(static_cast<std::size_t>(p), x0, x1);
        }
    });
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        if (node.patch >= 0) {
            boxes_[n] = motions_[static_cast<std::size_t>(node.patch)].box;
        } else {
            boxes_[n] = boxes_[static_cast<std::size_t>(node.left)];
            boxes_[n].add(boxes_[static_cast<std::size_t>(node.right)]);
        }
    }
}

double Patches::findNear(double more, std::vector<PatchPair>& pairs) const {
    pairs.clear();
    double slack = std::numeric_limits<double>::infinity();
    if (root_ >= 0) meetItself(root_, more, slack, pairs);
    std::sort(pairs.begin(), pairs.end());
    return slack;
}

void Patches::meetItself(int number, double more, double& slack, std::vector<PatchPair>& pairs) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.surface >= 0 && !elements_.mayMeet(node.surface, node.surface)) return;
    if (node.patch >= 0) return pairs.push_back(patchPair(node.patch, node.patch));
    const std::vector<int>& about = about_[static_cast<std::size_t>(number)];
    if (!about.empty()) {
        const double own = flatness(about);
        if (own >= enough(node.surface)) return void(slack = std::min(slack, own * leastAltitude(node.surface)));
    }
    meetItself(node.left, more, slack, pairs);
    meetItself(node.right, more, slack, pairs);
    meet(node.left, node.right, more, pairs);
}

void Patches::meet(int a, int b, double more, std::vector<PatchPair>& pairs) const {
    const Node &first = nodes_[static_cast<std::size_t>(a)], &second = nodes_[static_cast<std::size_t>(b)];
    const Box &boxA = boxes_[static_cast<std::size_t>(a)], &boxB = boxes_[static_cast<std::size_t>(b)];
    if (!boxA.overlaps(boxB, nearShare * (first.thickness + second.thickness) + more)) return;
    if (first.surface >= 0 && second.surface >= 0 && !elements_.mayMeet(first.surface, second.surface)) return;
    if (first.patch >= 0 && second.patch >= 0) {
        pairs.push_back(patchPair(first.patch, second.patch));
        return;
    }
    const auto sizeOf = [](const Box& box) {
        const dvec3 size = box.high - box.low;
        return size.x + size.y + size.z;
    };
    if (second.patch >= 0 || (first.patch < 0 && sizeOf(boxA) >= sizeOf(boxB))) {
        meet(first.left, b, more, pairs);
        meet(first.right, b, more, pairs);
    } else {
        meet(a, second.left, more, pairs);
        meet(a, second.right, more, pairs);
    }
}

void Patches::prepareFlatness() {
    inverses_.resize(elements_.triangles().size());
    restBoxes_.resize(patches_.size());
    altitudes_.assign(elements_.surfaces().size(), 1e300);
    for (std::size_t p = 0; p < patches_.size(); ++p) {
        const std::optional<Plane>& plane = planes_[static_cast<std::size_t>(patches_[p].surface)];
        if (!plane) continue;
        const auto flat = [&](int i) {
            const dvec3& x = elements_.rest()[static_cast<std::size_t>(i)];
            return Rest2(glm::dot(x, plane->right), glm::dot(x, plane->up));
        };
        for (int i : patches_[p].corners) {
            restBoxes_[p].low = glm::min(restBoxes_[p].low, flat(i));
            restBoxes_[p].high = glm::max(restBoxes_[p].high, flat(i));
        }
        for (int t : patches_[p].triangles) {
            const std::array<int, 3>& corners = elements_.triangles()[static_cast<std::size_t>(t)].points;
            const Rest2 u = flat(corners[1]) - flat(corners[0]), v = flat(corners[2]) - flat(corners[0]);
            const double det = u.x * v.y - u.y * v.x;
            inverses_[static_cast<std::size_t>(t)] = {v.y / det, -v.x / det, -u.y / det, u.x / det};
            const Rest2 w = v - u;
            const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
            double& altitude = altitudes_[static_cast<std::size_t>(patches_[p].surface)];
            altitude = std::min(altitude, std::abs(det) / std::sqrt(longest));
        }
    }
    constexpr double hair = 1.02;  // for what is not quite flat or convex
    for (std::size_t k = 0; k < elements_.surfaces().size(); ++k)
        enough_.push_back(hair * nearShare *
                          std::min(restShare, 2 * elements_.surfaces()[k].thickness / altitudes_[k]));
    about_.resize(nodes_.size());
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        if (node.patch >= 0 || node.surface < 0 || !planes_[static_cast<std::size_t>(node.surface)]) continue;
        RestBox box;
        const auto add = [&](auto&& self, const Node& below) -> void {
            if (below.patch < 0) {
                self(self, nodes_[static_cast<std::size_t>(below.left)]);
                self(self, nodes_[static_cast<std::size_t>(below.right)]);
                return;
            }
            const RestBox& own = restBoxes_[static_cast<std::size_t>(below.patch)];
            box.low = glm::min(box.low, own.low);
            box.high = glm::max(box.high, own.high);
        };
        add(add, node);
        about_[n] = about(box, node.surface, patches_.size());
    }
}

void Patches::measureFlatness(std::size_t number, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    const Patch& patch = patches_[number];
    Flatness flatness;
    struct Gradient {
        dvec3 right, up;
    };
    std::array<Gradient, 2 * patchSize> gradients;
    std::size_t count = 0;
    for (int t : patch.triangles) {
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
    const double size = length(flatness.right);
    if (!(size > 0)) return void(flatness_[number] = {});
    flatness.right /= size;
    flatness.up -= glm::dot(flatness.up, flatness.right) * flatness.right;
    const double height = length(flatness.up);
    if (!(height > 0)) return void(flatness_[number] = {});
    flatness.up /= height;
    double least = 1e300, most = 0;
    for (std::size_t g = 0; g < count; ++g) {
        const Gradient& f = gradients[g];
        const double a = glm::dot(flatness.right, f.right), d = glm::dot(flatness.up, f.up);
        const double b = 0.5 * (glm::dot(flatness.right, f.up) + glm::dot(flatness.up, f.right));
        const double half = 0.5 * (a - d);
        least = std::min(least, 0.5 * (a + d) - std::sqrt(half * half + b * b));
        const double p = glm::dot(f.right, f.right), q = glm::dot(f.up, f.up), r = glm::dot(f.right, f.up);
        most = std::max(most, 0.5 * (p + q) + std::sqrt(0.25 * (p - q) * (p - q) + r * r));
    }
    flatness.normal = glm::cross(flatness.right, flatness.up);
    flatness.least = least;
    flatness.most = std::sqrt(most);
    flatness_[number] = flatness;
}

std::vector<int> Patches::about(int a, int b) const {
    const int surface = patches_[static_cast<std::size_t>(a)].surface;
    if (surface != patches_[static_cast<std::size_t>(b)].surface || !planes_[static_cast<std::size_t>(surface)])
        return {};
    const RestBox &boxA = restBoxes_[static_cast<std::size_t>(a)], &boxB = restBoxes_[static_cast<std::size_t>(b)];
    return about({glm::min(boxA.low, boxB.low), glm::max(boxA.high, boxB.high)}, surface, mostAbout);
}

std::vector<int> Patches::about(const RestBox& all, int surface, std::size_t most) const {
    std::vector<int> found;
    for (std::size_t p = 0; p < patches_.size(); ++p) {
        if (patches_[p].surface != surface) continue;
        const RestBox& box = restBoxes_[p];
        if (box.low.x > all.high.x || box.low.y > all.high.y || all.low.x > box.high.x || all.low.y > box.high.y)
            continue;
        if (found.size() == most) return {};
        found.push_back(static_cast<int>(p));
    }
    return found;
}

double Patches::flatness(std::span<const int> about) const {
    if (about.empty()) return -1.0;
    const double least = enough(patches_[static_cast<std::size_t>(about.front())].surface);
    dvec3 right(0.0), up(0.0);
    for (int p : about) {
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
    for (int p : about) {
        const Flatness& own = flatness_[static_cast<std::size_t>(p)];
        // Turned by an angle, from R of the patch to that of all, F t may be led that much further away from R t.
        const double trace = glm::dot(right, own.right) + glm::dot(up, own.up) + glm::dot(normal, own.normal);
        const double cosine = std::min(1.0, 0.5 * (trace - 1.0));
        if (!(cosine > 0)) return -1.0;
        const double aside = std::sqrt(std::max(0.0, own.most * own.most - own.least * own.least));
        flattest = std::min(flattest, own.least * cosine - aside * std::sqrt(1.0 - cosine * cosine));
    }
    return flattest;
}

}  // namespace taut::contact
