#include "taut/mechanics/private/triangulation.h"

#include <cmath>
#include <deque>
#include <utility>

#include "taut/core/error.h"

namespace taut::mechanics {
namespace {

__extension__ using Wide = __int128;

// Places are whole numbers below 2³⁰, so that a turn has at most 62 bits and the terms of a circle 125.
constexpr std::int64_t most = std::int64_t{1} << 30;

}  // namespace

// The points fill the middle of a square of two triangles, whose corners come last.
Triangulation::Triangulation(std::span<const glm::dvec2> points, glm::dvec2 low, double size)
    : low_(low), scale_(static_cast<double>(most / 2) / size) {
    for (const glm::dvec2& p : points) places_.push_back(placeOf(p));
    const int n = static_cast<int>(points.size());
    places_.insert(places_.end(), {{0, 0}, {most, 0}, {most, most}, {0, most}});
    triangleOf_.resize(places_.size());
    triangles_.resize(2);
    set(0, {n, n + 1, n + 2}, {-1, 1, -1});
    set(1, {n, n + 2, n + 3}, {-1, -1, 0});
    for (int i = 0; i < n; ++i) insert(i);
}

void Triangulation::keepRings(std::vector<int> next) {
    next_ = std::move(next);
    for (std::size_t i = 0; i < next_.size(); ++i) makeEdge(static_cast<int>(i), next_[i]);
    dropOutside();
}

// The other corners of the triangles around a point of no ring, against the clock.
template <class Visit>
void Triangulation::eachAround(int point, const Visit& visit) const {
    const int first = triangleOf_[point];
    int t = first;
    do {
        const std::size_t k = slotOf(at(t), point);
        visit(at(t).corners[(k + 1) % 3], at(t).corners[(k + 2) % 3]);
        t = at(t).beyond[(k + 1) % 3];
    } while (t != first);
}

// Each point goes to the mean of the middles of the circles around its triangles, weighted by their areas (Chen 2004:
// optimal Delaunay triangulations).
void Triangulation::relax(std::span<glm::dvec2> points) {
    for (std::size_t i = next_.size(); i < points.size(); ++i) {
        glm::dvec2 sum(0.0);  // of middles from here times four areas
        double area = 0;      // twice
        eachAround(static_cast<int>(i), [&](int a, int b) {
            const glm::dvec2 p = points[a] - points[i];
            const glm::dvec2 q = points[b] - points[i];
            const double pp = p.x * p.x + p.y * p.y, qq = q.x * q.x + q.y * q.y;
            sum += glm::dvec2(q.y * pp - p.y * qq, p.x * qq - q.x * pp);
            area += p.x * q.y - p.y * q.x;
        });
        const glm::dvec2 to = points[i] + 0.5 / area * sum;
        const Place place = placeOf(to);
        bool turnsOver = false;
        eachAround(static_cast<int>(i),
                   [&](int a, int b) { turnsOver = turnsOver || turn(places_[a], places_[b], place) <= 0; });
        if (turnsOver) continue;
        points[i] = to;
        places_[i] = place;
    }
    std::vector<Edge> all;
    for (const Triangle& triangle : triangles_)
        for (std::size_t k = 0; k < 3 && !triangle.isDropped; ++k)
            all.push_back({triangle.corners[k], triangle.corners[(k + 1) % 3]});
    restoreDelaunay(std::move(all));
}

std::vector<std::array<int, 3>> Triangulation::triangles() const {
    std::vector<std::array<int, 3>> left;
    for (const Triangle& triangle : triangles_)
        if (!triangle.isDropped) left.push_back(triangle.corners);
    return left;
}

Triangulation::Place Triangulation::placeOf(glm::dvec2 p) const {
    const glm::dvec2 q = glm::dvec2((p.x - low_.x) * scale_, (p.y - low_.y) * scale_);
    return {most / 4 + static_cast<std::int64_t>(std::floor(q.x + 0.5)),
            most / 4 + static_cast<std::int64_t>(std::floor(q.y + 0.5))};
}

// Twice the area of a triangle, above 0 if it is counter-clockwise.
std::int64_t Triangulation::turn(const Place& a, const Place& b, const Place& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
std::int64_t Triangulation::turn(int a, int b, int c) const {
    return turn(places_[a], places_[b], places_[c]);
}

// Whether the point is within the circle through the corners, by the determinant of Guibas and Stolfi (1985).
bool Triangulation::isInCircle(const Triangle& of, int point) const {
    const Place& d = places_[point];
    std::array<Place, 3> p{};
    std::array<std::int64_t, 3> square{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Place& corner = places_[of.corners[k]];
        p[k] = {corner.x - d.x, corner.y - d.y};
        square[k] = p[k].x * p[k].x + p[k].y * p[k].y;
    }
    Wide sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Place &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
        sum += static_cast<Wide>(square[k]) * (a.x * b.y - a.y * b.x);
    }
    return sum > 0;
}

bool Triangulation::isKept(int a, int b) const {
    const auto leads = [&](int from, int to) { return from < static_cast<int>(next_.size()) && next_[from] == to; };
    return leads(a, b) || leads(b, a);
}

std::size_t Triangulation::slotOf(const Triangle& triangle, int point) {
    return triangle.corners[0] == point ? 0 : triangle.corners[1] == point ? 1 : 2;
}

// The triangle to the left of the way from a to b; -1: there is no such edge. Looks at those around a, against the
// clock, and if that ends at the side of the square, with it.
int Triangulation::triangleAt(int a, int b) const {
    const int first = triangleOf_[a];
    for (const std::size_t side : {1U, 2U}) {
        int t = first;
        do {
            const std::size_t k = slotOf(at(t), a);
            if (at(t).corners[(k + 1) % 3] == b) return t;
            t = at(t).beyond[(k + side) % 3];
        } while (t != first && t >= 0);
    }
    return -1;
}

// The corner of the triangle across the edge opposite corner k.
int Triangulation::apexBeyond(int t, std::size_t k) const {
    const Triangle& u = at(at(t).beyond[k]);
    return u.corners[(slotOf(u, at(t).corners[(k + 1) % 3]) + 1) % 3];
}

void Triangulation::set(int t, const std::array<int, 3>& corners, const std::array<int, 3>& beyond) {
    at(t).corners = corners;
    at(t).beyond = beyond;
    for (const int corner : corners) triangleOf_[corner] = t;
}

void Triangulation::relink(int t, int from, int to) {
    if (t < 0) return;
    for (int& beyond : at(t).beyond)
        if (beyond == from) beyond = to;
}

// Three triangles take the place of the one in which the point lies. On an edge of it one of them has no area, until
// that edge is flipped: all of the other side is in the circle around three points on a line.
void Triangulation::insert(int point) {
    int t = last_;
    for (std::size_t k = 0; k < 3;) {
        const auto& corners = at(t).corners;
        const bool isBeyond = turn(corners[(k + 1) % 3], corners[(k + 2) % 3], point) < 0;
        if (isBeyond) t = at(t).beyond[k];
        k = isBeyond ? 0 : k + 1;
    }
    const auto [a, b, c] = at(t).corners;
    const auto [beyondA, beyondB, beyondC] = at(t).beyond;
    const int u = static_cast<int>(triangles_.size()), v = u + 1;
    triangles_.resize(triangles_.size() + 2);
    set(t, {a, b, point}, {u, v, beyondC});
    set(u, {b, c, point}, {v, t, beyondA});
    set(v, {c, a, point}, {t, u, beyondB});
    relink(beyondA, t, u);
    relink(beyondB, t, v);
    restoreDelaunay({{a, b}, {b, c}, {c, a}});
    last_ = triangleOf_[point];
}

//       b              b
//     / | \          / u \      .
//   p t | u q  ->  p ----- q    t: corner k is p
//     \ | /          \ t /      .
//       a              a
void Triangulation::flip(int t, std::size_t k) {
    const Triangle one = at(t);
    const int u = one.beyond[k];
    const Triangle other = at(u);
    const int p = one.corners[k], a = one.corners[(k + 1) % 3], b = one.corners[(k + 2) % 3];
    const int q = apexBeyond(t, k);
    const int pa = one.beyond[(k + 2) % 3], bp = one.beyond[(k + 1) % 3];
    const int aq = other.beyond[slotOf(other, b)], qb = other.beyond[slotOf(other, a)];
    set(t, {p, a, q}, {aq, u, pa});
    set(u, {p, q, b}, {qb, bp, t});
    relink(aq, u, t);
    relink(bp, t, u);
}

// Flips edges until no circle around a triangle holds the corner beyond an edge (Lawson 1977). Those kept stay.
void Triangulation::restoreDelaunay(std::vector<Edge> edges) {
    while (!edges.empty()) {
        const auto [a, b] = edges.back();
        edges.pop_back();
        const int t = isKept(a, b) ? -1 : triangleAt(a, b);
        if (t < 0) continue;
        const std::size_t k = (slotOf(at(t), a) + 2) % 3;
        if (at(t).beyond[k] < 0) continue;
        const int p = at(t).corners[k], q = apexBeyond(t, k);
        if (!isInCircle(at(t), q)) continue;
        flip(t, k);
        edges.insert(edges.end(), {{p, a}, {a, q}, {q, b}, {b, p}});
    }
}

// The edges that cross the way from a to b.
std::vector<Triangulation::Edge> Triangulation::edgesAcross(int a, int b) const {
    // Among the triangles around a the one that the way leads through.
    int t = triangleOf_[a], right = 0, left = 0;
    for (const int first = t;;) {
        const std::size_t k = slotOf(at(t), a);
        right = at(t).corners[(k + 1) % 3];
        left = at(t).corners[(k + 2) % 3];
        if (turn(a, b, right) < 0 && turn(a, b, left) > 0) break;
        t = at(t).beyond[(k + 1) % 3];
        TAUT_EXPECTS(t != first);
    }
    std::vector<Edge> edges;
    for (int apex = a; apex != b;) {
        edges.push_back({right, left});
        const std::size_t k = slotOf(at(t), apex);
        apex = apexBeyond(t, k);
        t = at(t).beyond[k];
        if (apex == b) break;
        // Goes on through the side of the next triangle whose ends lie on both sides of the way.
        const int opposite = turn(a, b, apex) > 0 ? left : right;
        (turn(a, b, apex) > 0 ? left : right) = apex;
        apex = opposite;
    }
    return edges;
}

// Flips the edges across the line from a to b until it is an edge (Sloan 1993).
void Triangulation::makeEdge(int a, int b) {
    if (triangleAt(a, b) >= 0) return;
    const std::vector<Edge> found = edgesAcross(a, b);
    std::deque<Edge> across(found.begin(), found.end());
    std::vector<Edge> made;
    while (!across.empty()) {
        const auto [c, d] = across.front();
        across.pop_front();
        const int t = triangleAt(c, d);
        const std::size_t k = (slotOf(at(t), c) + 2) % 3;
        const int p = at(t).corners[k], q = apexBeyond(t, k);
        if (!(turn(p, q, c) < 0 && turn(p, q, d) > 0) && !(turn(p, q, c) > 0 && turn(p, q, d) < 0)) {
            across.push_back({c, d});  // until flips around it make room
            continue;
        }
        flip(t, k);
        const bool meetsEnd = p == a || p == b || q == a || q == b;
        const bool crosses = !meetsEnd && (turn(a, b, p) > 0) != (turn(a, b, q) > 0);
        if (crosses)
            across.push_back({p, q});
        else
            made.push_back({p, q});
    }
    restoreDelaunay(std::move(made));
}

// Goes from the corner of the square through all triangles. Each ring that it crosses leads from outside to inside or
// back.
void Triangulation::dropOutside() {
    std::vector<bool> isKnown(triangles_.size(), false);
    std::deque<int> toDo{triangleOf_.back()};
    at(toDo.front()).isDropped = isKnown[toDo.front()] = true;
    while (!toDo.empty()) {
        const int t = toDo.front();
        toDo.pop_front();
        for (std::size_t k = 0; k < 3; ++k) {
            const int u = at(t).beyond[k];
            if (u < 0 || isKnown[u]) continue;
            isKnown[u] = true;
            at(u).isDropped = at(t).isDropped != isKept(at(t).corners[(k + 1) % 3], at(t).corners[(k + 2) % 3]);
            toDo.push_back(u);
        }
    }
}

}  // namespace taut::mechanics
