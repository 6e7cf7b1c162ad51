#include "taut/contact/bvh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "taut/contact/closest_points.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr int atOnce = 32, travelAtOnce = 256;  // leaves per task

constexpr double alike = 1e-6;       // sizes that differ by less than this share count as equal
constexpr double middleShare = 0.2;  // of the items: a node may be split this far from the middle
constexpr double wideShare = 0.6;    // of the widest gap there: the least gap to split at

dvec3 unitAcross(const dvec3& along) {
    const dvec3 size = glm::abs(along);
    const dvec3 other =
        size.x <= size.y && size.x <= size.z ? dvec3(1, 0, 0) : (size.y <= size.z ? dvec3(0, 1, 0) : dvec3(0, 0, 1));
    const dvec3 across = glm::cross(along, other);
    return across / length(across);
}

// Axes that turn with a surface, so that the tree turns with it too. They are the shortest edge of its first triangle,
// the direction beside this edge in the triangle's plane, and the normal. A surface without triangles takes its first
// edge, and the direction to the point furthest from this edge.
Axes axesOf(const Elements& elements, int surface) {
    const auto at = [&](int i) { return elements.rest()[static_cast<std::size_t>(i)]; };
    dvec3 along(1.0, 0.0, 0.0), beside(0.0);
    const int firstTriangle = elements.firstTriangleOf(surface), firstEdge = elements.firstEdgeOf(surface);
    if (firstTriangle < elements.firstTriangleOf(surface + 1)) {
        const std::array<int, 3>& c = elements.triangles()[static_cast<std::size_t>(firstTriangle)].points;
        double shortest = 1e300;
        for (std::size_t k = 0; k < 3; ++k) {
            const dvec3 edge = at(c[(k + 1) % 3]) - at(c[k]);
            if (!(length(edge) < (1 - alike) * shortest)) continue;
            shortest = length(edge);
            along = edge;
            beside = at(c[(k + 2) % 3]) - at(c[k]);
        }
    } else if (firstEdge < elements.firstEdgeOf(surface + 1)) {
        const Edge& first = elements.edges()[static_cast<std::size_t>(firstEdge)];
        along = at(first.b) - at(first.a);
        double furthest = 0;
        for (int i : elements.surface(surface).points) {
            const dvec3 d = at(i) - at(first.a);
            const dvec3 aside = d - (glm::dot(d, along) / glm::dot(along, along)) * along;
            if (!(length(aside) > (1 + alike) * furthest + alike * length(along))) continue;
            furthest = length(aside);
            beside = aside;
        }
    }
    if (!(length(along) > 0)) along = dvec3(1.0, 0.0, 0.0);
    along /= length(along);
    beside -= glm::dot(beside, along) * along;
    beside = length(beside) > 0 ? beside / length(beside) : unitAcross(along);
    return {along, beside, glm::cross(along, beside)};
}

// Where to split sorted places: at the gap closest to the middle that is about as wide as the widest gap near there.
// So the rows of a grid stay whole.
std::size_t halfOf(const std::vector<double>& places) {
    const std::size_t n = places.size(), middle = n / 2;
    const auto off = std::max<std::size_t>(1, static_cast<std::size_t>(middleShare * static_cast<double>(n)));
    const std::size_t first = middle > off ? middle - off : 1, last = std::min(n - 1, middle + off);
    double widest = 0;
    for (std::size_t k = first; k <= last; ++k) widest = std::max(widest, places[k] - places[k - 1]);
    for (std::size_t d = 0; d <= off; ++d) {
        if (middle >= first + d && places[middle - d] - places[middle - d - 1] >= wideShare * widest) return middle - d;
        if (middle + d <= last && places[middle + d] - places[middle + d - 1] >= wideShare * widest) return middle + d;
    }
    return middle;
}

}  // namespace

Bvh::Bvh(const Elements& elements)
    : elements_(elements),
      leafOfPoint_(static_cast<std::size_t>(elements.pointCount()), -1),
      leafOfEdge_(static_cast<std::size_t>(elements.edgesWithoutBalls()), -1) {
    // Over 60 lines: it builds the parts of the tree one after the other, then the arrays that have their size.
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
    // For each surface one tree of triangles, one of lines, and one leaf for other points.
    planes_.resize(elements.surfaces().size());
    planeRoots_.resize(elements.surfaces().size(), -1);
    for (int s = 0; s < static_cast<int>(elements.surfaces().size()); ++s) {
        if (!elements.meetsAny(s)) continue;
        const Axes axes = axesOf(elements, s);
        findPlane(s, axes[0]);
        std::vector<int> triangles, lines;
        for (int t = elements.firstTriangleOf(s); t < elements.firstTriangleOf(s + 1); ++t) triangles.push_back(t);
        for (int e = elements.firstEdgeOf(s); e < elements.firstEdgeOf(s + 1); ++e)
            if (elements.edges()[static_cast<std::size_t>(e)].isLine) lines.push_back(e);
        if (!triangles.empty()) {
            roots.push_back(addTree(std::move(triangles), triangleCentres, s, axes, true));
            planeRoots_[static_cast<std::size_t>(s)] = roots.back();
        }
        if (!lines.empty()) roots.push_back(addTree(std::move(lines), edgeCentres, s, axes, false));
        // Points of no triangle and no line. Damage has made them balls, or may do so later.
        std::vector<int> others;
        for (int i : elements.surface(s).points)
            if (elements.surfaceOf(i) == s && leafOfPoint_[static_cast<std::size_t>(i)] < 0) others.push_back(i);
        if (others.empty()) continue;
        BvhLeaf leaf;
        leaf.surface = s;
        leaf.points = leaf.corners = std::move(others);
        for (int i : leaf.points) leafOfPoint_[static_cast<std::size_t>(i)] = count();
        leaves_.push_back(std::move(leaf));
        nodes_.push_back({-1, -1, count() - 1, s, elements.surface(s).thickness});
        roots.push_back(static_cast<int>(nodes_.size()) - 1);
    }
    if (!roots.empty()) root_ = joinRoots(roots);
    motions_.resize(leaves_.size());
    references_.resize(leaves_.size());
    // Reference shapes, and the leaves at each point.
    std::size_t corners = 0;
    for (const BvhLeaf& leaf : leaves_) {
        firstReference_.push_back(corners);
        corners += leaf.corners.size();
    }
    referenceShape_.assign(corners, dvec3(1e150));
    firstAt_.assign(static_cast<std::size_t>(elements.pointCount()) + 1, 0);
    for (const BvhLeaf& leaf : leaves_)
        for (int i : leaf.corners) ++firstAt_[static_cast<std::size_t>(i) + 1];
    for (std::size_t i = 1; i < firstAt_.size(); ++i) firstAt_[i] += firstAt_[i - 1];
    leavesAt_.resize(corners);
    std::vector<std::size_t> next(firstAt_.begin(), firstAt_.end() - 1);
    for (int p = 0; p < count(); ++p)
        for (int i : leaves_[static_cast<std::size_t>(p)].corners) leavesAt_[next[static_cast<std::size_t>(i)]++] = p;
    boxes_.resize(nodes_.size());
    flatness_.resize(leaves_.size());
    isMeasured_.assign(leaves_.size(), 0);
    isFollowed_.assign(leaves_.size(), 0);
    travel_.assign(leaves_.size(), 0.0);
    all_.resize(leaves_.size());
    std::iota(all_.begin(), all_.end(), 0);
    isStillFollowed_.assign(leaves_.size(), 0);
    prepareFlatness();
    takeBalls();
}

int Bvh::addTree(std::vector<int> items, const std::vector<dvec3>& centres, int surface, const Axes& axes,
                 bool areTriangles) {
    if (items.size() <= leafSize) return addLeaf(items, surface, areTriangles);
    // Choose the axis on which the items extend furthest.
    std::size_t longest = 0;
    double size = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        double low = 1e300, high = -1e300;
        for (int i : items) {
            const double place = glm::dot(axes[k], centres[static_cast<std::size_t>(i)]);
            low = std::min(low, place);
            high = std::max(high, place);
        }
        if (!(high - low > (1 + alike) * size)) continue;
        size = high - low;
        longest = k;
    }
    // Split there, and sort both halves by number.
    std::vector<std::pair<double, int>> inOrder;
    for (int i : items) inOrder.emplace_back(glm::dot(axes[longest], centres[static_cast<std::size_t>(i)]), i);
    std::sort(inOrder.begin(), inOrder.end());
    std::vector<double> places;
    for (const auto& [place, i] : inOrder) places.push_back(place);
    const std::size_t half = halfOf(places);
    std::vector<int> low, high;
    for (std::size_t k = 0; k < inOrder.size(); ++k) (k < half ? low : high).push_back(inOrder[k].second);
    std::sort(low.begin(), low.end());
    std::sort(high.begin(), high.end());
    const int left = addTree(std::move(low), centres, surface, axes, areTriangles);
    const int right = addTree(std::move(high), centres, surface, axes, areTriangles);
    nodes_.push_back({left, right, -1, surface, elements_.surface(surface).thickness});
    return static_cast<int>(nodes_.size()) - 1;
}

int Bvh::addLeaf(const std::vector<int>& items, int surface, bool areTriangles) {
    const int number = count();
    BvhLeaf leaf;
    leaf.surface = surface;
    const auto addPoint = [&](int i) {
        leaf.corners.push_back(i);
        int& owner = leafOfPoint_[static_cast<std::size_t>(i)];
        if (owner >= 0) return;
        owner = number;
        leaf.points.push_back(i);
    };
    const auto addEdge = [&](int e) {
        int& owner = leafOfEdge_[static_cast<std::size_t>(e)];
        if (owner >= 0) return;
        owner = number;
        leaf.edges.push_back(e);
    };
    for (int item : items) {
        if (areTriangles) {
            const Triangle& triangle = elements_.triangles()[static_cast<std::size_t>(item)];
            leaf.triangles.push_back(item);
            for (int i : triangle.points) addPoint(i);
            for (int e : triangle.edges) addEdge(e);
        } else {
            const Edge& edge = elements_.edges()[static_cast<std::size_t>(item)];
            addPoint(edge.a);
            addPoint(edge.b);
            addEdge(item);
        }
    }
    for (std::vector<int>* list : {&leaf.edges, &leaf.points, &leaf.corners}) {
        std::sort(list->begin(), list->end());
        list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    leaves_.push_back(std::move(leaf));
    nodes_.push_back({-1, -1, number, surface, elements_.surface(surface).thickness});
    return static_cast<int>(nodes_.size()) - 1;
}

int Bvh::joinRoots(std::span<const int> roots) {
    if (roots.size() == 1) return roots.front();
    const int left = joinRoots(roots.first(roots.size() / 2)), right = joinRoots(roots.subspan(roots.size() / 2));
    const Node &a = nodes_[static_cast<std::size_t>(left)], &b = nodes_[static_cast<std::size_t>(right)];
    const int surface = a.surface == b.surface ? a.surface : -1;
    nodes_.push_back({left, right, -1, surface, std::max(a.thickness, b.thickness)});
    return static_cast<int>(nodes_.size()) - 1;
}

void Bvh::takeBalls() {
    for (BvhLeaf& leaf : leaves_) std::erase_if(leaf.edges, [&](int e) { return e >= elements_.edgesWithoutBalls(); });
    for (std::size_t e = static_cast<std::size_t>(elements_.edgesWithoutBalls()); e < elements_.edges().size(); ++e) {
        const int owner = leafOfPoint_[static_cast<std::size_t>(elements_.edges()[e].a)];
        leaves_[static_cast<std::size_t>(owner)].edges.push_back(static_cast<int>(e));
    }
}

void Bvh::takeReference(std::size_t number, std::span<const dvec3> x) {
    const LeafMotion& motion = motions_[number];
    dvec3* shape = referenceShape_.data() + firstReference_[number];
    for (int i : leaves_[number].corners) *shape++ = x[static_cast<std::size_t>(i)] - motion.centre;
    ++references_[number];
}

void Bvh::findWay(std::size_t number, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    const BvhLeaf& leaf = leaves_[number];
    LeafMotion& motion = motions_[number];
    dvec3 sum(0.0), ways(0.0);
    motion.before = {};
    for (int i : leaf.corners) {
        const dvec3 &from = x0[static_cast<std::size_t>(i)], &to = x1[static_cast<std::size_t>(i)];
        motion.before.add(from);
        motion.box.add(to);
        sum += from;
        ways += to - from;
    }
    motion.box.add(motion.before);
    // The mean way, then how far points deviate from it and from the reference shape.
    const double share = 1.0 / static_cast<double>(leaf.corners.size());
    motion.centre = share * sum;
    motion.way = share * ways;
    const dvec3* shape = referenceShape_.data() + firstReference_[number];
    double deviation = 0, deformation = 0;
    for (int i : leaf.corners) {
        const dvec3 before = x0[static_cast<std::size_t>(i)] - motion.centre, after = x1[static_cast<std::size_t>(i)];
        const dvec3 own = after - motion.centre - motion.way - before;
        const dvec3 bend = before - *shape++, bendAfter = bend + own;
        deviation = std::max(deviation, glm::dot(own, own));
        deformation = std::max(deformation, std::max(glm::dot(bend, bend), glm::dot(bendAfter, bendAfter)));
    }
    motion.deviation = std::sqrt(deviation);
    motion.deformation = std::sqrt(deformation);
}

void Bvh::correct(std::span<const int> points, std::span<const dvec3> x0, std::span<const dvec3> x1) {
    isCorrected_.assign(leaves_.size(), 0);
    for (int i : points) {
        const auto k = static_cast<std::size_t>(i);
        for (std::size_t at = firstAt_[k]; at < firstAt_[k + 1]; ++at)
            isCorrected_[static_cast<std::size_t>(leavesAt_[at])] = 1;
        ways_[k] = glm::dot(x1[k] - x0[k], x1[k] - x0[k]);
    }
    core::parallelFor(count(), atOnce, [&](int leaf) {
        const auto p = static_cast<std::size_t>(leaf);
        if (isCorrected_[p] == 0) return;
        findTravel(p);
        if (isFollowed_[p] != 0) findWay(p, x0, x1);
        isMeasured_[p] = 0;
    });
}

void Bvh::addShifts(std::span<const int> points, std::span<const dvec3> from, std::span<const dvec3> to,
                    std::span<double> shifts) const {
    for (int i : points) {
        const auto k = static_cast<std::size_t>(i);
        const double shift = length(to[k] - from[k]);
        for (std::size_t at = firstAt_[k]; at < firstAt_[k + 1]; ++at) {
            double& most = shifts[static_cast<std::size_t>(leavesAt_[at])];
            most = std::max(most, shift);
        }
    }
}

void Bvh::findTravel(std::size_t number) {
    double most = 0;
    for (int i : leaves_[number].corners) most = std::max(most, ways_[static_cast<std::size_t>(i)]);
    travel_[number] = std::sqrt(most);
}

void Bvh::start(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    ways_.resize(x0.size());
    for (std::size_t i = 0; i < x0.size(); ++i) ways_[i] = glm::dot(x1[i] - x0[i], x1[i] - x0[i]);
    core::parallelFor(count(), travelAtOnce, [&](int p) { findTravel(static_cast<std::size_t>(p)); });
    std::fill(isMeasured_.begin(), isMeasured_.end(), 0);
    std::fill(isFollowed_.begin(), isFollowed_.end(), 0);
}

void Bvh::follow(std::span<const int> leaves, std::span<const dvec3> x0, std::span<const dvec3> x1, double most) {
    toFollow_.clear();
    for (int p : leaves) {
        char& isFollowed = isFollowed_[static_cast<std::size_t>(p)];
        if (isFollowed == 0) toFollow_.push_back(p);
        isFollowed = 1;
    }
    core::parallelFor(static_cast<int>(toFollow_.size()), atOnce, [&](int k) {
        const auto p = static_cast<std::size_t>(toFollow_[static_cast<std::size_t>(k)]);
        const bool isStill = elements_.isStill(leaves_[p].surface);
        char& isStillFollowed = isStillFollowed_[p];
        if (isStill && isStillFollowed != 0) return;
        isStillFollowed = isStill ? 1 : 0;
        LeafMotion& motion = motions_[p];
        motion.box = {};
        findWay(p, x0, x1);
        if (most > 0 && !(motion.deformation <= most)) {
            takeReference(p, x0);
            motion.deformation = motion.deviation;
        }
        motion.reference = references_[p];
    });
}

void Bvh::followAll(std::span<const dvec3> x0, std::span<const dvec3> x1, double most) {
    follow(all_, x0, x1, most);
}

void Bvh::findNear(std::span<const core::Aabb> boxes, double more, std::vector<LeafPair>& pairs) {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        if (node.leaf >= 0) {
            boxes_[n] = boxes[static_cast<std::size_t>(node.leaf)];
        } else {
            boxes_[n] = boxes_[static_cast<std::size_t>(node.left)];
            boxes_[n].add(boxes_[static_cast<std::size_t>(node.right)]);
        }
    }
    pairs.clear();
    if (root_ >= 0) findPairsWithin(root_, more, pairs);
    std::sort(pairs.begin(), pairs.end());
}

void Bvh::findPairsWithin(int number, double more, std::vector<LeafPair>& pairs) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.surface >= 0 && !elements_.mayMeet(node.surface, node.surface)) return;
    if (node.leaf >= 0) return pairs.push_back(leafPair(node.leaf, node.leaf));
    findPairsWithin(node.left, more, pairs);
    findPairsWithin(node.right, more, pairs);
    findPairsBetween(node.left, node.right, more, pairs);
}

void Bvh::findPairsBetween(int a, int b, double more, std::vector<LeafPair>& pairs) const {
    const Node &first = nodes_[static_cast<std::size_t>(a)], &second = nodes_[static_cast<std::size_t>(b)];
    const core::Aabb &boxA = boxes_[static_cast<std::size_t>(a)], &boxB = boxes_[static_cast<std::size_t>(b)];
    if (!boxA.overlaps(boxB, nearShare * (first.thickness + second.thickness) + more)) return;
    if (first.surface >= 0 && second.surface >= 0 && !elements_.mayMeet(first.surface, second.surface)) return;
    if (first.leaf >= 0 && second.leaf >= 0) {
        pairs.push_back(leafPair(first.leaf, second.leaf));
        return;
    }
    const auto sizeOf = [](const core::Aabb& box) {
        const dvec3 size = box.high - box.low;
        return size.x + size.y + size.z;
    };
    if (second.leaf >= 0 || (first.leaf < 0 && sizeOf(boxA) >= sizeOf(boxB))) {
        findPairsBetween(first.left, b, more, pairs);
        findPairsBetween(first.right, b, more, pairs);
    } else {
        findPairsBetween(a, second.left, more, pairs);
        findPairsBetween(a, second.right, more, pairs);
    }
}

}  // namespace taut::contact
