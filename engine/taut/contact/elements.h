// The triangles and edges of all surfaces of a group in one numbering, and their connectivity. Knows places at rest
// only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "taut/contact/contact_surface.h"

namespace taut::contact {

struct Triangle {
    std::array<int, 3> points;
    std::array<int, 3> edges;  // edge k: points k, k + 1
    int surface;
    bool isGone = false;
};

struct Edge {
    int a, b;  // the same point twice for a ball: a point without triangles and edges, left by damage
    int surface;
    bool isLine;  // of no triangle: its ends push too in pairs of edges
    bool isGone = false;
    std::array<int, 2> triangles{-1, -1};  // on either side, the lower first; more than two count as a border
    std::array<int, 2> wings{-1, -1};      // points, as of a surface
};

class Elements {
  public:
    // rest (points) [m]. A surface that may meet none has no triangles and edges here.
    Elements(std::vector<ContactSurface> surfaces, std::vector<dvec3> rest);

    // Removes triangles (by their number in the surface) and edges (by their points) of a surface. An edge stays while
    // one of its triangles does. Points that are left without triangle and edge become balls, which come last among the
    // edges.
    void setGone(int surface, const std::function<bool(std::size_t triangle)>& isTriangleGone,
                 const std::function<bool(int a, int b)>& isEdgeSevered);
    // Call it after the last setGone().
    void refresh();
    // Two points of a seam: their elements count as neighbours and never touch. To be called before any block.
    void sew(int a, int b);
    // Two surfaces that do not touch each other, as bodies that a joint ties. Likewise.
    void keepApart(int surfaceA, int surfaceB);
    bool areOne(int a, int b) const {
        return oneOf_[static_cast<std::size_t>(a)] == oneOf_[static_cast<std::size_t>(b)];
    }
    bool areNeighbours(int point, const Triangle& triangle) const {
        const std::array<int, 3>& c = triangle.points;
        return areOne(point, c[0]) + areOne(point, c[1]) + areOne(point, c[2]) > 0;  // without a branch
    }
    bool areNeighbours(const Edge& a, const Edge& b) const {
        return areOne(a.a, b.a) + areOne(a.a, b.b) + areOne(a.b, b.a) + areOne(a.b, b.b) > 0;
    }

    const std::vector<ContactSurface>& surfaces() const { return surfaces_; }
    const ContactSurface& surface(int i) const { return surfaces_[static_cast<std::size_t>(i)]; }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    const std::vector<Edge>& edges() const { return edges_; }
    int edgesWithoutBalls() const { return firstBall_; }
    // The elements of a surface go from its first to before the first of the next surface.
    int firstTriangleOf(int surface) const {
        return static_cast<int>(firstTriangleOf_[static_cast<std::size_t>(surface)]);
    }
    int firstEdgeOf(int surface) const { return static_cast<int>(firstEdgeOf_[static_cast<std::size_t>(surface)]); }
    int surfaceOf(int point) const { return surfaceOf_[static_cast<std::size_t>(point)]; }
    const std::vector<dvec3>& rest() const { return rest_; }
    int pointCount() const { return static_cast<int>(rest_.size()); }
    // The points at the other ends of its edges.
    std::span<const int> neighbours(int point) const {
        const auto i = static_cast<std::size_t>(point);
        return {ring_.data() + ringStart_[i], ring_.data() + ringStart_[i + 1]};
    }
    // The lowest triangle at a point; -1: none.
    int firstTriangle(int point) const { return firstTriangle_[static_cast<std::size_t>(point)]; }
    double shortestEdge(int surface) const { return shortest_[static_cast<std::size_t>(surface)]; }  // [m] at rest
    double longestEdge(int surface) const { return longest_[static_cast<std::size_t>(surface)]; }    // [m] at rest

    bool shareBond(int surfaceA, int surfaceB) const {
        return surface(surfaceA).bond == surface(surfaceB).bond && !isRigid(surfaceA) && !isRigid(surfaceB);
    }
    // [m] The distance that a point and a triangle, or two edges, keep (their four points). Elements of one body may be
    // closer at rest than their thickness: they keep at most restShare of their distance at rest.
    double thicknessOf(const std::array<int, 4>& points, bool isPoint) const;
    // Whether elements of two surfaces, or of one, may touch each other.
    bool mayMeet(int surfaceA, int surfaceB) const {
        const ContactSurface &a = surface(surfaceA), &b = surface(surfaceB);
        if ((a.isConvex && b.isConvex) || (a.isFormula && b.meetsShapes) || (b.isFormula && a.meetsShapes))
            return false;
        return mayTouch(surfaceA, surfaceB);
    }
    // Whether two surfaces, or one with itself, may touch.
    bool mayTouch(int surfaceA, int surfaceB) const {
        const ContactSurface &a = surface(surfaceA), &b = surface(surfaceB);
        if (isStill(surfaceA) && isStill(surfaceB)) return false;
        if (a.solid >= 0 && a.solid == b.solid) return false;
        if (const std::vector<int>& own = apart_[static_cast<std::size_t>(surfaceA)];
            std::find(own.begin(), own.end(), surfaceB) != own.end())
            return false;
        if (surfaceA == surfaceB) return a.meetsItself && !a.isOfCollider();
        if (a.isOfCollider() || b.isOfCollider())
            return a.isOfCollider() != b.isOfCollider() && a.meetsRigid && b.meetsRigid;
        return a.meetsOthers && b.meetsOthers;
    }
    // Whether there is any that it may meet.
    bool meetsAny(int surface) const { return meetsAny_[static_cast<std::size_t>(surface)] != 0; }
    bool isRigid(int number) const { return surface(number).isRigid; }

    // A rigid surface, or one of points that do not move at all, stands still: its leaves need not be fitted again.
    // Two that stand still do not meet. After a surface that is not rigid began or ended to stand still, call drop() of
    // the group.
    void setStill(int surface, bool isStill) { isStill_[static_cast<std::size_t>(surface)] = isStill ? 1 : 0; }
    bool isStill(int surface) const { return isStill_[static_cast<std::size_t>(surface)] != 0; }

    std::uint64_t bytes() const;

  private:
    void addSurface(int number);

    std::vector<ContactSurface> surfaces_;
    std::vector<std::vector<int>> apart_;  // (surfaces) surfaces that it does not touch
    std::vector<dvec3> rest_;
    std::vector<Triangle> triangles_;
    std::vector<Edge> edges_;
    std::vector<std::size_t> firstTriangleOf_, firstEdgeOf_;  // (surfaces + 1)
    int firstBall_ = 0;
    std::vector<bool> isSevered_;  // (edges without balls)
    std::vector<int> surfaceOf_;   // (points)
    std::vector<int> oneOf_;       // (points) the lowest point that it is sewn to, with all between; else itself
    std::vector<int> ring_, firstTriangle_;
    std::vector<std::size_t> ringStart_;
    std::vector<double> shortest_, longest_;  // (surfaces)
    std::vector<char> isStill_;               // (surfaces)
    std::vector<char> meetsAny_;              // (surfaces) else it has no elements
};

}  // namespace taut::contact
