// Catmull and Clark's surface of quadrangles and Loop's of triangles, and their mean where they meet: each face is split
// in its plane, then every vertex goes to the mean of the rules of the faces around it (Warren and Schaefer: A
// Factored Approach to Subdivision Surfaces, 2004). A border is a cubic B-spline of its own vertices.
//
// Such a surface lies on the inner side of a bend of its vertices, by a sixth of their second differences. So they do
// not control it themselves: each is first moved by as much as the surface would miss it, which leaves the square of
// that.
#include "taut/view/private/subdivision.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "taut/core/private/parallel.h"

namespace taut::view {
namespace {

using glm::dvec3;

struct Term {
    std::uint32_t vertex;
    dvec3 weights;
};
using Row = std::vector<Term>;

// A sum of rows.
class RowSum {
  public:
    explicit RowSum(std::size_t columns) : sum_(columns, dvec3(0.0)), isTouched_(columns, false) {}
    void add(const Row& row, const dvec3& weights) {
        for (const Term& term : row) {
            sum_[term.vertex] += term.weights.x * weights;
            if (!isTouched_[term.vertex]) touched_.push_back(term.vertex);
            isTouched_[term.vertex] = true;
        }
    }
    Row take() {
        Row row;
        row.reserve(touched_.size());
        for (const std::uint32_t v : touched_) {
            row.push_back({v, sum_[v]});
            sum_[v] = dvec3(0.0);
            isTouched_[v] = false;
        }
        touched_.clear();
        return row;
    }

  private:
    std::vector<dvec3> sum_;  // (columns)
    std::vector<bool> isTouched_;
    std::vector<std::uint32_t> touched_;
};

void append(const Row& row, SparseRows& rows) {
    for (const Term& term : row) rows.terms.push_back({term.vertex, glm::vec3(term.weights)});
    rows.first.push_back(rows.terms.size());
}

template <class Vector>
std::vector<Vector> product(const SparseRows& rows, std::span<const Vector> x) {
    std::vector<Vector> sums(rows.count(), Vector(0.0F));
    for (std::size_t r = 0; r < sums.size(); ++r)
        for (std::size_t i = rows.first[r]; i < rows.first[r + 1]; ++i)
            sums[r] += rows.terms[i].weights.x * x[rows.terms[i].column];
    return sums;
}

std::size_t sidesOf(const Face& face) {
    return face[3] == noVertex ? 3 : 4;
}

// The neighbours of a vertex, counter-clockwise: at a border from its first edge to its last.
struct Fan {
    std::vector<std::uint32_t> edges;     // the vertices at their other ends
    std::vector<std::uint32_t> opposite;  // (faces) the far corner of a quadrangle, noVertex of a triangle
    bool isBorder = false;
    bool isFixed = false;
};

struct FaceCorner {
    std::uint32_t next, before, opposite;
};

Fan fanOf(const std::vector<FaceCorner>& corners) {
    Fan fan;
    const auto find = [&](std::uint32_t next) {
        return std::find_if(
            corners.begin(), corners.end(), [&](const FaceCorner& c) { return c.next == next; });
    };
    const auto isFirst = [&](const FaceCorner& c) {
        return std::none_of(corners.begin(), corners.end(), [&](const FaceCorner& o) { return o.before == c.next; });
    };
    auto first = std::find_if(corners.begin(), corners.end(), isFirst);
    fan.isBorder = first != corners.end();
    if (!fan.isBorder) first = corners.begin();
    auto at = first;
    while (at != corners.end() && fan.opposite.size() < corners.size()) {
        fan.edges.push_back(at->next);
        fan.opposite.push_back(at->opposite);
        const auto after = find(at->before);
        if (after == corners.end()) fan.edges.push_back(at->before);
        at = after == first ? corners.end() : after;
    }
    // Where two fans meet in one vertex, or there is none, it has no surface to be smoothed to.
    fan.isFixed = corners.empty() || fan.opposite.size() < corners.size();
    return fan;
}

std::vector<Fan> fansOf(const std::vector<Face>& faces, std::size_t vertices) {
    std::vector<std::vector<FaceCorner>> corners(vertices);
    for (const Face& face : faces) {
        const std::size_t n = sidesOf(face);
        for (std::size_t k = 0; k < n; ++k)
            corners[face[k]].push_back(
                {face[(k + 1) % n], face[(k + n - 1) % n], n == 4 ? face[(k + 2) % n] : noVertex});
    }
    std::vector<Fan> fans;
    for (const std::vector<FaceCorner>& around : corners) fans.push_back(fanOf(around));
    return fans;
}

// Of a face in a flat regular mesh, in twelfths of the way round.
double angleOf(std::uint32_t opposite) {
    return opposite == noVertex ? 2.0 : 3.0;
}

double angleAround(const Fan& fan) {
    double sum = 0.0;
    for (const std::uint32_t opposite : fan.opposite) sum += angleOf(opposite);
    return sum;
}

// How far a vertex inside goes to the mean of its faces; 1 where 360 degrees meet.
double stepOf(const Fan& fan) {
    const double angles = angleAround(fan);
    return angles == 6.0 ? 1.5 : 12.0 / angles;
}

// Calls add(vertex, weight) for the smoothed place of a vertex of split faces.
template <class Add>
void smooth(std::uint32_t v, const Fan& fan, Add&& add) {
    if (fan.isFixed) return add(v, 1.0);
    if (fan.isBorder) {
        add(v, 0.5);
        add(fan.edges.front(), 0.25);
        add(fan.edges.back(), 0.25);
        return;
    }
    const double step = stepOf(fan), angles = angleAround(fan);
    add(v, 1.0 - step);
    for (std::size_t i = 0; i < fan.opposite.size(); ++i) {
        const bool isQuad = fan.opposite[i] != noVertex;
        const double share = step * angleOf(fan.opposite[i]) / angles, beside = isQuad ? 0.25 : 0.375;
        add(v, share * 0.25);
        add(fan.edges[i], share * beside);
        add(fan.edges[(i + 1) % fan.edges.size()], share * beside);
        if (isQuad) add(fan.opposite[i], share * 0.25);
    }
}

// The same for where it ends when faces are split for ever: the left eigenvector of that to the eigenvalue 1.
template <class Add>
void limit(std::uint32_t v, const Fan& fan, Add&& add) {
    if (fan.isFixed) return add(v, 1.0);
    if (fan.isBorder) {
        add(v, 2.0 / 3.0);
        add(fan.edges.front(), 1.0 / 6.0);
        add(fan.edges.back(), 1.0 / 6.0);
        return;
    }
    const double edge = stepOf(fan) / static_cast<double>(fan.edges.size());
    double sum = 1.0 + stepOf(fan);
    for (const std::uint32_t opposite : fan.opposite) sum += opposite != noVertex ? 0.25 * edge : 0.0;
    add(v, 1.0 / sum);
    for (const std::uint32_t end : fan.edges) add(end, edge / sum);
    for (const std::uint32_t opposite : fan.opposite)
        if (opposite != noVertex) add(opposite, 0.25 * edge / sum);
}

// The same for two tangents there, the second to the left of the first (Halstead, Kass and DeRose 1993; Hoppe et al.
// 1994). They are the limit's own where all faces are alike; those at corners, across a border of quadrangles that is
// not regular, and where both kinds meet, are but close to it.
template <class Add>
void tangents(std::uint32_t v, const Fan& fan, Add&& add) {
    const std::size_t n = fan.edges.size();
    const auto hasQuad = [](std::uint32_t opposite) { return opposite != noVertex; };
    const auto addWay = [&](std::uint32_t from, std::uint32_t to, glm::dvec2 weights) {
        add(to, weights);
        add(from, -weights);
    };
    if (fan.isFixed || !fan.isBorder) {
        // All around for a vertex inside; at a corner, which may be the end of a slit, as far as its faces reach.
        double angle = 0.0;
        const double unit = 2.0 * std::numbers::pi / (fan.isFixed ? 12.0 : angleAround(fan));
        const double turn = 2.0 * std::numbers::pi / static_cast<double>(n), c = std::cos(turn);
        const bool isQuad = !fan.isFixed && std::any_of(fan.opposite.begin(), fan.opposite.end(), hasQuad);
        const double edge = isQuad ? 1.0 + c + std::cos(0.5 * turn) * std::sqrt(2.0 * (9.0 + c)) : 1.0;
        const auto at = [&](double a) { return glm::dvec2(std::cos(a * unit), std::sin(a * unit)); };
        for (std::size_t i = 0; i < n; ++i) {
            addWay(v, fan.edges[i], edge * at(angle));
            if (i == fan.opposite.size()) break;
            const double next = angle + angleOf(fan.opposite[i]);
            if (isQuad && hasQuad(fan.opposite[i])) addWay(v, fan.opposite[i], at(angle) + at(next));
            angle = next;
        }
        return;
    }
    const glm::dvec2 across(0.0, 1.0);
    addWay(fan.edges.back(), fan.edges.front(), {1.0, 0.0});
    if (n == 3 && hasQuad(fan.opposite[0]) && hasQuad(fan.opposite[1])) {
        addWay(v, fan.edges[1], 4.0 * across);
        addWay(fan.edges[0], fan.opposite[0], across);
        addWay(fan.edges[2], fan.opposite[1], across);
        return;
    }
    const double angle = std::numbers::pi / static_cast<double>(std::max<std::size_t>(n - 1, 2));
    for (std::size_t i = 1; i + 1 < n; ++i)
        add(fan.edges[i], (2.0 - 2.0 * std::cos(angle)) * std::sin(static_cast<double>(i) * angle) * across);
    const double ends = n > 2 ? -std::sin(angle) : 1.0;
    add(fan.edges.front(), ends * across);
    add(fan.edges.back(), ends * across);
    if (n == 2) add(v, -2.0 * across);
}

// Faces with the rows of their vertices.
struct Facets {
    std::vector<Face> faces;
    std::vector<Row> rows;
    std::vector<std::array<std::uint32_t, 2>> middles;  // as of FineMesh
};

// Splits each face into four.
//
//        c        d - 2 - c
//       / \       |   |   |
//      2 - 1      3 - m - 1    Corners keep their place in the parts, so that all diagonals a-c run alike.
//     / \ / \     |   |   |
//    a - 0 - b    a - 0 - b
Facets split(Facets mesh, RowSum& sum) {
    Facets fine;
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    const auto meanOf = [&](std::span<const std::uint32_t> vertices, std::array<std::uint32_t, 2> ends) {
        mesh.middles.push_back(ends);
        for (const std::uint32_t v : vertices)
            sum.add(mesh.rows[v], dvec3(1.0 / static_cast<double>(vertices.size()), 0.0, 0.0));
        mesh.rows.push_back(sum.take());
        return static_cast<std::uint32_t>(mesh.rows.size() - 1);
    };
    const auto middleOf = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
        const auto [entry, isNew] = middles.try_emplace(key, 0);
        if (isNew) entry->second = meanOf(std::array{a, b}, {a, b});
        return entry->second;
    };
    for (const Face& face : mesh.faces) {
        const auto [a, b, c, d] = face;
        if (sidesOf(face) == 3) {
            const std::uint32_t ab = middleOf(a, b), bc = middleOf(b, c), ca = middleOf(c, a);
            for (const Face& part : {Face{a, ab, ca, d}, Face{ab, b, bc, d}, Face{ca, bc, c, d}, Face{ab, bc, ca, d}})
                fine.faces.push_back(part);
            continue;
        }
        const std::uint32_t ab = middleOf(a, b), bc = middleOf(b, c), cd = middleOf(c, d), da = middleOf(d, a);
        const std::uint32_t m = meanOf(face, {a, c});
        for (const Face& part : {Face{a, ab, m, da}, Face{ab, b, bc, m}, Face{m, bc, c, cd}, Face{da, m, cd, d}})
            fine.faces.push_back(part);
    }
    fine.rows = std::move(mesh.rows);
    fine.middles = std::move(mesh.middles);
    return fine;
}

bool isCorner(std::uint32_t v, const Fan& fan, std::span<const dvec3> rest) {
    if (!fan.isBorder || fan.edges.size() < 2) return false;
    const dvec3 in = rest[v] - rest[fan.edges.back()], out = rest[fan.edges.front()] - rest[v];
    return fan.edges.size() == 2 || glm::dot(in, out) < 0.5 * glm::length(in) * glm::length(out);
}

}  // namespace

FineMesh subdivided(std::vector<Face> faces, std::span<const dvec3> rest, bool keepsCorners, int levels,
                    std::span<const std::uint32_t> kept) {
    const std::size_t count = rest.size();
    std::vector<Fan> fans = fansOf(faces, count);
    std::vector<bool> isFixed(count, false);
    for (const std::uint32_t v : kept) isFixed[v] = fans[v].isFixed = true;
    RowSum sum(count);
    const auto unit = [](std::uint32_t v) { return Row{{v, dvec3(1.0, 0.0, 0.0)}}; };
    Facets mesh{std::move(faces), {}, {}};
    FineMesh fine;
    for (std::uint32_t v = 0; v < count; ++v) {
        if (fans[v].isFixed || (keepsCorners && isCorner(v, fans[v], rest))) isFixed[v] = fans[v].isFixed = true;
        sum.add(unit(v), dvec3(2.0, 0.0, 0.0));
        limit(v, fans[v], [&](std::uint32_t of, double weight) { sum.add(unit(of), dvec3(-weight, 0.0, 0.0)); });
        append(sum.take(), fine.controls);
        mesh.rows.push_back(unit(v));
    }
    for (int level = 0; level < levels; ++level) {
        mesh = split(std::move(mesh), sum);
        fans = fansOf(mesh.faces, mesh.rows.size());
        std::vector<Row> smoothed;
        for (std::uint32_t v = 0; v < mesh.rows.size(); ++v) {
            if (v < count && isFixed[v]) fans[v].isFixed = true;
            smooth(v, fans[v], [&](std::uint32_t of, double w) { sum.add(mesh.rows[of], dvec3(w, 0.0, 0.0)); });
            smoothed.push_back(sum.take());
        }
        mesh.rows = std::move(smoothed);
    }

    for (std::uint32_t v = 0; v < mesh.rows.size(); ++v) {
        limit(
            v, fans[v], [&](std::uint32_t of, double w) { sum.add(mesh.rows[of], dvec3(w, 0.0, 0.0)); });
        tangents(v, fans[v], [&](std::uint32_t of, glm::dvec2 w) { sum.add(mesh.rows[of], dvec3(0.0, w.x, w.y)); });
        append(sum.take(), fine.surface);
    }
    for (const Face& face : mesh.faces) {
        fine.triangles.insert(fine.triangles.end(), {face[0], face[1], face[2]});
        if (face[3] != noVertex) fine.triangles.insert(fine.triangles.end(), {face[0], face[2], face[3]});
    }
    fine.middles = std::move(mesh.middles);
    return fine;
}

Geometry FineMesh::geometry(std::span<const glm::vec3> positions, float room) const {
    constexpr int verticesAtOnce = 512;
    const std::vector<glm::vec3> x = product(controls, positions);
    std::vector<glm::vec3> flat(positions.begin(), positions.end());
    flat.reserve(surface.count());
    for (const auto& [a, b] : middles) flat.push_back(0.5F * (flat[a] + flat[b]));
    Geometry geometry{std::move(flat), std::vector<glm::vec3>(surface.count())};
    core::parallelFor(static_cast<int>(surface.count()), verticesAtOnce, [&](int vertex) {
        const auto v = static_cast<std::size_t>(vertex);
        glm::vec3 place(0.0F), along(0.0F), across(0.0F);
        for (std::size_t i = surface.first[v]; i < surface.first[v + 1]; ++i) {
            const auto& [column, weights] = surface.terms[i];
            place += weights.x * x[column];
            along += weights.y * x[column];
            across += weights.z * x[column];
        }
        const glm::vec3 way = place - geometry.positions[v];
        const float share = glm::dot(way, way) / (room * room);
        geometry.positions[v] += way / std::sqrt(std::sqrt(1.0F + share * share));
        const glm::vec3 normal = glm::cross(along, across);
        const float square = glm::dot(normal, normal);
        geometry.normals[v] = square > 0.0F ? normal / std::sqrt(square) : glm::vec3(0.0F, 1.0F, 0.0F);
    });
    return geometry;
}

std::vector<glm::vec2> FineMesh::spread(std::span<const glm::vec2> uv) const {
    return product<glm::vec2>(surface, product(controls, uv));
}

}  // namespace taut::view
