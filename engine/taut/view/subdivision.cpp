// Catmull and Clark's surface of quadrangles and Loop's of triangles, and where they meet what is both: each face is
// split in its plane, then every vertex goes to the mean of what the faces around it say (Warren and Schaefer: A
// Factored Approach to Subdivision Surfaces, 2004). A border is a cubic B-spline of its own vertices.
//
// Such a surface lies inside of what its vertices bend about, by a sixth of their second differences. So they do not
// control it themselves: each is first moved by as much as the surface would miss it, which leaves the square of that.
#include "taut/view/private/subdivision.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

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

std::size_t sidesOf(const Face& face) {
    return face[3] == noVertex ? 3 : 4;
}

// What lies around a vertex, counter-clockwise: at a border from its first edge to its last.
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
        return std::find_if(corners.begin(), corners.end(), [&](const FaceCorner& c) { return c.next == next; });
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

// Of the sizes of angles in a flat regular mesh, a right one of quadrangles and 60 degrees of triangles.
double angleOf(std::uint32_t opposite) {
    return opposite == noVertex ? 2.0 : 3.0;
}

// How far a vertex inside goes to the mean of its faces; 1 where 360 degrees of angles meet.
double stepOf(const Fan& fan) {
    double angles = 0.0;
    for (const std::uint32_t opposite : fan.opposite) angles += angleOf(opposite);
    return angles == 6.0 ? 1.5 : 12.0 / angles;
}

// Calls add(vertex, weight) for what a vertex of split faces is smoothed to.
template <class Add>
void smooth(std::uint32_t v, const Fan& fan, Add&& add) {
    if (fan.isFixed) return add(v, 1.0);
    if (fan.isBorder) {
        add(v, 0.5);
        add(fan.edges.front(), 0.25);
        add(fan.edges.back(), 0.25);
        return;
    }
    const double step = stepOf(fan);
    double angles = 0.0;
    for (const std::uint32_t opposite : fan.opposite) angles += angleOf(opposite);
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

// The same for two tangents there, the second to the left of the first, where all faces are alike; across a border
// that is not regular, and where both kinds meet, ones that the fan itself has.
template <class Add>
void tangents(std::uint32_t v, const Fan& fan, Add&& add) {
    const std::size_t n = fan.edges.size();
    const auto hasQuad = [](std::uint32_t opposite) { return opposite != noVertex; };
    if (n < 2) return;
    if (!fan.isBorder) {
        double whole = 0.0, angle = 0.0;
        for (const std::uint32_t opposite : fan.opposite) whole += angleOf(opposite);
        const double turn = 2.0 * std::numbers::pi / static_cast<double>(n), c = std::cos(turn);
        const bool isQuad = std::any_of(fan.opposite.begin(), fan.opposite.end(), hasQuad);
        const double edge = isQuad ? 1.0 + c + std::cos(0.5 * turn) * std::sqrt(2.0 * (9.0 + c)) : 1.0;
        const auto at = [&](double share) {
            const double a = 2.0 * std::numbers::pi * share / whole;
            return glm::dvec2(std::cos(a), std::sin(a));
        };
        const auto addFrom = [&](std::uint32_t to, glm::dvec2 weights) {
            add(to, weights);
            add(v, -weights);
        };
        for (std::size_t i = 0; i < fan.opposite.size(); ++i) {
            addFrom(fan.edges[i], edge * at(angle));
            const double next = angle + angleOf(fan.opposite[i]);
            if (hasQuad(fan.opposite[i])) addFrom(fan.opposite[i], at(angle) + at(next));
            angle = next;
        }
        return;
    }
    add(fan.edges.front(), {1.0, 0.0});
    add(fan.edges.back(), {-1.0, 0.0});
    const auto across = [&](std::uint32_t to, double weight) { add(to, {0.0, weight}); };
    if (n == 3 && !fan.isFixed && hasQuad(fan.opposite[0]) && hasQuad(fan.opposite[1])) {
        const std::uint32_t from[] = {fan.edges[0], v, fan.edges[2]};
        const std::uint32_t to[] = {fan.opposite[0], fan.edges[1], fan.opposite[1]};
        for (std::size_t i = 0; i < 3; ++i) {
            across(to[i], i == 1 ? 4.0 : 1.0);
            across(from[i], i == 1 ? -4.0 : -1.0);
        }
    } else if (n > 2 && !fan.isFixed) {
        const double angle = std::numbers::pi / static_cast<double>(n - 1);
        for (std::size_t i = 1; i + 1 < n; ++i)
            across(fan.edges[i], (2.0 - 2.0 * std::cos(angle)) * std::sin(static_cast<double>(i) * angle));
        for (const std::uint32_t end : {fan.edges.front(), fan.edges.back()}) across(end, -std::sin(angle));
    } else {
        const std::size_t skipped = n > 2 ? 1 : 0;
        for (std::size_t i = skipped; i + skipped < n; ++i) {
            across(fan.edges[i], 1.0);
            across(v, -1.0);
        }
    }
}

// Faces with the rows of their vertices.
struct Facets {
    std::vector<Face> faces;
    std::vector<Row> rows;
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
    const auto meanOf = [&](std::span<const std::uint32_t> vertices) {
        for (const std::uint32_t v : vertices)
            sum.add(mesh.rows[v], dvec3(1.0 / static_cast<double>(vertices.size()), 0.0, 0.0));
        mesh.rows.push_back(sum.take());
        return static_cast<std::uint32_t>(mesh.rows.size() - 1);
    };
    const auto middleOf = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
        const auto [entry, isNew] = middles.try_emplace(key, 0);
        if (isNew) entry->second = meanOf(std::array{a, b});
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
        const std::uint32_t m = meanOf(face);
        for (const Face& part : {Face{a, ab, m, da}, Face{ab, b, bc, m}, Face{m, bc, c, cd}, Face{da, m, cd, d}})
            fine.faces.push_back(part);
    }
    fine.rows = std::move(mesh.rows);
    return fine;
}

bool isCorner(std::uint32_t v, const Fan& fan, std::span<const dvec3> rest) {
    if (!fan.isBorder || fan.edges.size() < 2) return false;
    const dvec3 in = rest[v] - rest[fan.edges.back()], out = rest[fan.edges.front()] - rest[v];
    return fan.edges.size() == 2 || glm::dot(in, out) < 0.5 * glm::length(in) * glm::length(out);
}

}  // namespace

FineMesh subdivided(std::vector<Face> faces, std::span<const dvec3> rest, bool keepsCorners, int levels) {
    const std::size_t count = rest.size();
    std::vector<Fan> fans = fansOf(faces, count);
    std::vector<bool> isFixed(count, false);
    RowSum sum(count);
    const auto unit = [](std::uint32_t v) { return Row{{v, dvec3(1.0, 0.0, 0.0)}}; };
    Facets mesh{std::move(faces), {}};
    for (std::uint32_t v = 0; v < count; ++v) {
        if (fans[v].isFixed || (keepsCorners && isCorner(v, fans[v], rest))) isFixed[v] = fans[v].isFixed = true;
        sum.add(unit(v), dvec3(2.0, 0.0, 0.0));
        limit(v, fans[v], [&](std::uint32_t of, double weight) { sum.add(unit(of), dvec3(-weight, 0.0, 0.0)); });
        mesh.rows.push_back(sum.take());
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

    FineMesh fine;
    fine.first.push_back(0);
    for (std::uint32_t v = 0; v < mesh.rows.size(); ++v) {
        limit(v, fans[v], [&](std::uint32_t of, double w) { sum.add(mesh.rows[of], dvec3(w, 0.0, 0.0)); });
        tangents(v, fans[v], [&](std::uint32_t of, glm::dvec2 w) { sum.add(mesh.rows[of], dvec3(0.0, w.x, w.y)); });
        for (const Term& term : sum.take()) fine.terms.push_back({term.vertex, glm::vec3(term.weights)});
        fine.first.push_back(fine.terms.size());
    }
    for (const Face& face : mesh.faces) {
        fine.triangles.insert(fine.triangles.end(), {face[0], face[1], face[2]});
        if (face[3] != noVertex) fine.triangles.insert(fine.triangles.end(), {face[0], face[2], face[3]});
    }
    return fine;
}

Geometry FineMesh::geometry(std::span<const glm::vec3> positions) const {
    Geometry geometry;
    geometry.positions.reserve(first.size() - 1);
    geometry.normals.reserve(first.size() - 1);
    for (std::size_t v = 0; v + 1 < first.size(); ++v) {
        glm::vec3 place(0.0F), along(0.0F), across(0.0F);
        for (std::size_t i = first[v]; i < first[v + 1]; ++i) {
            const auto& [vertex, weights] = terms[i];
            place += weights.x * positions[vertex];
            along += weights.y * positions[vertex];
            across += weights.z * positions[vertex];
        }
        const glm::vec3 normal = glm::cross(along, across);
        const float square = glm::dot(normal, normal);
        geometry.positions.push_back(place);
        geometry.normals.push_back(square > 0.0F ? normal / std::sqrt(square) : glm::vec3(0.0F, 1.0F, 0.0F));
    }
    return geometry;
}

std::vector<glm::vec2> FineMesh::spread(std::span<const glm::vec2> uv) const {
    std::vector<glm::vec2> fine(first.size() - 1, glm::vec2(0.0F));
    for (std::size_t v = 0; v < fine.size(); ++v)
        for (std::size_t i = first[v]; i < first[v + 1]; ++i) fine[v] += terms[i].weights.x * uv[terms[i].vertex];
    return fine;
}

}  // namespace taut::view
