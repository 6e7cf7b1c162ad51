#include "taut/contact/bvh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "taut/contact/closest_points.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr int atOnce = 32;  // leaves per task

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
    for (int s = 0; s < static_cast<int>(elements.surfaces().size()); ++s) {
        if (!elements.meetsAny(s)) continue;
        const Axes axes = axesOf(elements, s);
        std::vector<int> triangles, lines;
        for (int t = elements.firstTriangleOf(s); t < elements.firstTriangleOf(s + 1); ++t) triangles.push_back(t);
        for (int e = elements.firstEdgeOf(s); e < elements.firstEdgeOf(s + 1); ++e)
            if (elements.edges()[static_cast<std::size_t>(e)].isLine) lines.push_back(e);
        if (!triangles.empty()) roots.push_back(addTree(std::move(triangles), triangleCentres, s, axes, true));
        if (!lines.empty()) roots.push_back(addTree(std::move(lines), edgeCentres, s, axes, false));
        // Points of no triangle and no line. Damage has made them balls, or may do so later.
        BvhLeaf others;
        others.surface = s;
        for (int i : elements.surface(s).points)
            if (elements.surfaceOf(i) == s && leafOfPoint_[static_cast<std::size_t>(i)] < 0) others.points.push_back(i);
        if (others.points.empty()) continue;
        for (int i : others.points) leafOfPoint_[static_cast<std::size_t>(i)] = count();
        others.corners = others.points;
        roots.push_back(addNode(std::move(others)));
    }
    if (!roots.empty()) root_ = joinRoots(roots);
    motions_.resize(leaves_.size());
    boxes_.resize(nodes_.size());
    // The leaves at each point.
    firstAt_.assign(static_cast<std::size_t>(elements.pointCount()) + 1, 0);
    for (const BvhLeaf& leaf : leaves_)
        for (int i : leaf.corners) ++firstAt_[static_cast<std::size_t>(i) + 1];
    std::partial_sum(firstAt_.begin(), firstAt_.end(), firstAt_.begin());
    leavesAt_.resize(firstAt_.back());
    std::vector<std::size_t> next(firstAt_.begin(), firstAt_.end() - 1);
    for (int p = 0; p < count(); ++p)
        for (int i : leaves_[static_cast<std::size_t>(p)].corners) leavesAt_[next[static_cast<std::size_t>(i)]++] = p;
    refresh();
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
    return addNode(std::move(leaf));
}

int Bvh::addNode(BvhLeaf leaf) {
    nodes_.push_back({-1, -1, count(), leaf.surface, elements_.surface(leaf.surface).thickness});
    leaves_.push_back(std::move(leaf));
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

void Bvh::refresh() {
    for (BvhLeaf& leaf : leaves_) std::erase_if(leaf.edges, [&](int e) { return e >= elements_.edgesWithoutBalls(); });
    for (std::size_t e = static_cast<std::size_t>(elements_.edgesWithoutBalls()); e < elements_.edges().size(); ++e) {
        const int owner = leafOfPoint_[static_cast<std::size_t>(elements_.edges()[e].a)];
        leaves_[static_cast<std::size_t>(owner)].edges.push_back(static_cast<int>(e));
    }
    wasStill_.assign(leaves_.size(), 0);
    isRefitted_.assign(leaves_.size(), 1);
}

void Bvh::fit(std::span<const dvec3> x0, std::span<const dvec3> x1) {
    core::parallelFor(
        count(), atOnce,
        [&](int leaf) {
            const auto p = static_cast<std::size_t>(leaf);
            const bool isStill = elements_.isStill(leaves_[p].surface);
            isRefitted_[p] = isStill && wasStill_[p] != 0 ? 0 : 1;
            wasStill_[p] = isStill ? 1 : 0;
            if (isRefitted_[p] == 0) return;
            LeafMotion& motion = motions_[p];
            motion = {};
            for (int i : leaves_[p].corners) {
                const dvec3 &from = x0[static_cast<std::size_t>(i)], &to = x1[static_cast<std::size_t>(i)];
                motion.box.add(from);
                motion.box.add(to);
                motion.way += to - from;
            }
            motion.way /= static_cast<double>(leaves_[p].corners.size());
            double square = 0;
            for (int i : leaves_[p].corners) {
                const dvec3 own = x1[static_cast<std::size_t>(i)] - x0[static_cast<std::size_t>(i)] - motion.way;
                square = std::max(square, glm::dot(own, own));
            }
            motion.deviation = std::sqrt(square);
        });
}

void Bvh::findNear(std::vector<LeafPair>& pairs) {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        if (node.leaf >= 0) {
            boxes_[n] = motions_[static_cast<std::size_t>(node.leaf)].box;
        } else {
            boxes_[n] = boxes_[static_cast<std::size_t>(node.left)];
            boxes_[n].add(boxes_[static_cast<std::size_t>(node.right)]);
        }
    }
    pairs.clear();
    if (root_ >= 0) findPairsWithin(root_, pairs);
    std::sort(pairs.begin(), pairs.end());
}

void Bvh::findPairsWithin(int number, std::vector<LeafPair>& pairs) const {
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.surface >= 0 && !elements_.mayMeet(node.surface, node.surface)) return;
    if (node.leaf >= 0) return pairs.push_back(leafPair(node.leaf, node.leaf));
    findPairsWithin(node.left, pairs);
    findPairsWithin(node.right, pairs);
    findPairsBetween(node.left, node.right, pairs);
}

void Bvh::findPairsBetween(int a, int b, std::vector<LeafPair>& pairs) const {
    const Node &first = nodes_[static_cast<std::size_t>(a)], &second = nodes_[static_cast<std::size_t>(b)];
    const core::Aabb &boxA = boxes_[static_cast<std::size_t>(a)], &boxB = boxes_[static_cast<std::size_t>(b)];
    if (!boxA.overlaps(boxB, nearShare * (first.thickness + second.thickness))) return;
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
        findPairsBetween(first.left, b, pairs);
        findPairsBetween(first.right, b, pairs);
    } else {
        findPairsBetween(a, second.left, pairs);
        findPairsBetween(a, second.right, pairs);
    }
}

}  // namespace taut::contact
