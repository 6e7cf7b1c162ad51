#include "taut/world/private/element_contacts.h"

#include <algorithm>
#include <cmath>

namespace taut::world {
namespace {

// Of the thickness:
constexpr double closeShare = 0.05;   // nearer pairs count even if they do not approach
constexpr double betweenShare = 0.8;  // edges and faces keep this distance from colliders

double longestEdge(const contact::Elements& elements, int surface, std::span<const dvec3> x) {
    double square = 0;
    for (int e = elements.firstEdgeOf(surface); e < elements.firstEdgeOf(surface + 1); ++e) {
        const contact::Edge& edge = elements.edges()[e];
        const dvec3 way = x[edge.b] - x[edge.a];
        if (!edge.isGone) square = std::max(square, glm::dot(way, way));
    }
    return std::sqrt(square);
}

}  // namespace

struct ElementContacts::Query {
    const contact::Elements& elements;
    std::span<const dvec3> x0, x1;
    double seconds;
    const ShapeInMotion& shape;
    int number;  // of the shape
    collision::ClosedShape closed;
    int surface;
    double thickness;  // [m]
    double longest;    // [m] edge of the surface

    // [m] A place that is further from the shape, and goes no further than `way`, does not meet it.
    double reach(double way) const { return way + shape.travel + (1 + closeShare) * thickness; }
    // [m] Least distance of an element from the shape. Points keep the whole thickness from colliders by themselves, so
    // that elements that lie flat on a collider, or bent about it, need no touch.
    double kept() const { return shape.surface >= 0 ? thickness : betweenShare * thickness; }
};

std::span<const ElementTouch> ElementContacts::find(const contact::Elements& elements, std::span<const dvec3> x0,
                                                    std::span<const dvec3> x1, double seconds,
                                                    std::span<const ShapeInMotion> shapes, const MayTouch& mayTouch) {
    touches_.clear();
    local_.resize(x0.size());
    near_.resize(x0.size());
    ways_.resize(x0.size());
    isNear_.resize(x0.size());
    for (int s = 0; s < static_cast<int>(elements.surfaces().size()); ++s) {
        const contact::ContactSurface& surface = elements.surface(s);
        if (!surface.meetsShapes || surface.isConvex) continue;
        core::Aabb box;
        for (const int i : surface.points) {
            box.add(x0[i]);
            box.add(x1[i]);
        }
        box.grow((1 + closeShare) * surface.thickness);
        double longest = -1;  // found where it is needed
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            const ShapeInMotion& shape = shapes[k];
            const collision::ClosedShape closed = shape.convex->closed();
            // A hull's triangles meet elements in engine/contact. They are its surface, so that GJK, of 0.8 to 9 µs an
            // element where a formula takes 0.2 to 0.3, would be no more exact.
            if (closed.kind == collision::ClosedKind::none || shape.convex->isHalfSpace()) continue;
            if (!box.overlaps(shape.box, 0.0) || !mayTouch(s, shape.surface, shape.collider)) continue;
            if (longest < 0) longest = longestEdge(elements, s, x0);
            const Query query{.elements = elements,
                              .x0 = x0,
                              .x1 = x1,
                              .seconds = seconds,
                              .shape = shape,
                              .number = static_cast<int>(k),
                              .closed = closed,
                              .surface = s,
                              .thickness = surface.thickness,
                              .longest = longest};
            if (!measurePoints(query)) continue;
            if (shape.surface >= 0) addPoints(query);
            addEdges(query);
            addFaces(query);
        }
    }
    return touches_;
}

// Returns whether any point is so near that an element of it may touch -> isNear_.
bool ElementContacts::measurePoints(const Query& query) {
    bool areAny = false;
    for (const int i : query.elements.surface(query.surface).points) {
        const auto k = static_cast<std::size_t>(i);
        local_[k] = query.shape.from.toLocal(query.x0[k]);
        near_[k] = collision::distanceTo(query.closed, local_[k]);
        ways_[k] = glm::length(query.x1[k] - query.x0[k]);
        isNear_[k] = near_[k].distance < query.reach(ways_[k]) + query.longest ? 1 : 0;
        areAny = areAny || isNear_[k] != 0;
    }
    return areAny;
}

void ElementContacts::addPoints(const Query& query) {
    for (const int i : query.elements.surface(query.surface).points) {
        const collision::Nearest& near = near_[i];
        if (near.distance < query.reach(ways_[i]))
            add(query, 3 * i, {i, -1, -1}, {near.distance, near.normal, {1.0, 0.0, 0.0}});
    }
}

void ElementContacts::addEdges(const Query& query) {
    const std::vector<contact::Edge>& edges = query.elements.edges();
    for (int e = query.elements.firstEdgeOf(query.surface); e < query.elements.firstEdgeOf(query.surface + 1); ++e) {
        const contact::Edge& edge = edges[e];
        if (edge.isGone || edge.a == edge.b) continue;
        const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
        if (isNear_[a] == 0 && isNear_[b] == 0) continue;
        const double reach = query.reach(std::max(ways_[a], ways_[b]));
        if (near_[a].distance + near_[b].distance - glm::length(local_[b] - local_[a]) > 2 * reach) continue;
        const auto near = collision::nearestInEdge(query.closed, local_[a], local_[b], near_[a], near_[b]);
        if (near && near->distance < reach) add(query, 3 * e + 1, {edge.a, edge.b, -1}, *near);
    }
}

void ElementContacts::addFaces(const Query& query) {
    const std::vector<contact::Triangle>& triangles = query.elements.triangles();
    for (int t = query.elements.firstTriangleOf(query.surface); t < query.elements.firstTriangleOf(query.surface + 1);
         ++t) {
        const contact::Triangle& triangle = triangles[t];
        const auto isNear = [&](int i) { return isNear_[i] != 0; };
        if (triangle.isGone || std::none_of(triangle.points.begin(), triangle.points.end(), isNear)) continue;
        double least = 1e300, way = 0;
        for (const int point : triangle.points) {
            const auto i = static_cast<std::size_t>(point);
            least = std::min(least, near_[i].distance);
            way = std::max(way, ways_[i]);
        }
        const double reach = query.reach(way);
        if (least > reach + query.longest) continue;
        const auto at = [&](std::size_t k) { return local_[triangle.points[k]]; };
        const auto near = collision::nearestInFace(*query.shape.convex, at(0), at(1), at(2));
        // A face is pierced between its corners; where one of them is in the shape, that one tells the way out.
        if (near && near->distance < reach && (near->distance > 0 || least >= 0))
            add(query, 3 * t + 2, triangle.points, *near);
    }
}

void ElementContacts::add(const Query& query, int element, const std::array<int, 3>& points,
                          const collision::ElementNear& near) {
    const ShapeInMotion& shape = query.shape;
    const double thickness = query.kept() + shape.thickness;
    std::array<dvec3, 3> x{}, ways{};  // in the axes of the shape
    for (std::size_t k = 0; k < 3 && points[k] >= 0; ++k) {
        const auto i = static_cast<std::size_t>(points[k]);
        x[k] = local_[i];
        ways[k] = shape.to.toLocal(query.x1[i]) - x[k];
    }
    const auto wayOf = [&](const collision::ElementNear& at) {
        return at.weights[0] * ways[0] + at.weights[1] * ways[1] + at.weights[2] * ways[2];
    };
    const dvec3 way = wayOf(near);
    const double closing = -glm::dot(near.normal, way), gap = near.distance - query.kept();
    if (!(gap < closeShare * thickness || closing > gap)) return;

    // A place that a block keeps from its start pushes too late where an element rocks, and feeds the rocking. So it is
    // the place where the element is expected at the end, or after a way of one thickness.
    collision::ElementNear at = near;
    double share = 0;  // of the way
    if (shape.collider >= 0) {
        share = std::min(1.0, thickness / glm::length(way));
        for (std::size_t k = 0; k < 3; ++k) x[k] += share * ways[k];
        at = nearestOf(query, points, x);
    }
    ElementTouch touch{.surface = query.surface,
                       .solid = shape.surface,
                       .collider = shape.collider,
                       .shape = query.number,
                       .element = element,
                       .points = points,
                       .weights = {at.weights[0], at.weights[1], at.weights[2]},
                       .normal = shape.from.directionToWorld(at.normal),
                       .place = dvec3(0.0),
                       .gap = at.distance - query.kept() - share * glm::dot(at.normal, wayOf(at)),
                       .closing = closing,
                       .speed = glm::length(way) / query.seconds,
                       .thickness = thickness,
                       .velocity = dvec3(0.0),
                       .spin = collision::spinBetween(shape.from, shape.to, query.seconds)};
    for (std::size_t k = 0; k < 3 && points[k] >= 0; ++k) touch.place += touch.weights[k] * query.x0[points[k]];
    const dvec3 on = touch.place - near.distance * touch.normal;  // of the shape
    touch.velocity = (shape.to.toWorld(shape.from.toLocal(on)) - on) / query.seconds;
    touches_.push_back(touch);
}

// Where an element whose points are at x is nearest to the shape, at a corner too.
collision::ElementNear ElementContacts::nearestOf(const Query& query, const std::array<int, 3>& points,
                                                  const std::array<dvec3, 3>& x) {
    std::array<collision::Nearest, 3> corners;
    std::size_t count = 0, least = 0;
    for (; count < 3 && points[count] >= 0; ++count) {
        corners[count] = collision::distanceTo(query.closed, x[count]);
        if (corners[count].distance < corners[least].distance) least = count;
    }
    std::optional<collision::ElementNear> near;
    if (count == 2) near = collision::nearestInEdge(query.closed, x[0], x[1], corners[0], corners[1]);
    if (count == 3) near = collision::nearestInFace(*query.shape.convex, x[0], x[1], x[2]);
    if (near && (near->distance > 0 || corners[least].distance >= 0)) return *near;
    collision::ElementNear corner{corners[least].distance, corners[least].normal, {}};
    corner.weights[least] = 1.0;
    return corner;
}

}  // namespace taut::world
