// The Delaunay triangulation of points in a plane that keeps to given rings. It decides in whole numbers, exactly, so
// that no rounding can turn a triangle over. It knows no cloth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace taut::mechanics {

class Triangulation {
  public:
    // Of points in the square from `low` on whose sides are `size`, no two of them nearer than a billionth of it.
    Triangulation(std::span<const glm::dvec2> points, glm::dvec2 low, double size);

    // Makes edges of rings of the first points, in which next[i] comes after i, and drops triangles outside of them.
    // Expects that the rings neither cross nor touch each other or further points.
    void keepRings(std::vector<int> next);

    // Moves points that are on no ring so that triangles become more alike, if none turns over, and restores the
    // Delaunay triangulation. `points` are the given points.
    void relax(std::span<glm::dvec2> points);

    std::vector<std::array<int, 3>> triangles() const;  // counter-clockwise, without those dropped

  private:
    struct Place {
        std::int64_t x, y;
    };
    struct Triangle {
        std::array<int, 3> corners;  // counter-clockwise
        std::array<int, 3> beyond;   // the triangle across the edge opposite corner k; -1: none
        bool isDropped = false;
    };
    using Edge = std::array<int, 2>;

    Place placeOf(glm::dvec2 p) const;
    static std::int64_t turn(const Place& a, const Place& b, const Place& c);
    std::int64_t turn(int a, int b, int c) const;
    bool isInCircle(const Triangle& of, int point) const;
    bool isKept(int a, int b) const;

    Triangle& at(int t) { return triangles_[t]; }
    const Triangle& at(int t) const { return triangles_[t]; }
    static std::size_t slotOf(const Triangle& triangle, int point);
    int triangleAt(int a, int b) const;
    int apexBeyond(int t, std::size_t k) const;
    void set(int t, const std::array<int, 3>& corners, const std::array<int, 3>& beyond);
    void relink(int t, int from, int to);

    void insert(int point);
    void flip(int t, std::size_t k);
    void restoreDelaunay(std::vector<Edge> edges);
    std::vector<Edge> edgesAcross(int a, int b) const;
    void makeEdge(int a, int b);
    void dropOutside();
    template <class Visit>
    void eachAround(int point, const Visit& visit) const;

    glm::dvec2 low_;
    double scale_;
    std::vector<Place> places_;    // (points), then those of the corners of a square around all
    std::vector<int> triangleOf_;  // (points) one of those around it
    std::vector<Triangle> triangles_;
    std::vector<int> next_;  // (points on rings)
    int last_ = 0;           // near which the next point will be
};

}  // namespace taut::mechanics
