#include "taut/bodies/private/skin_pieces.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace taut::world {
namespace {

class Cutter {
  public:
    explicit Cutter(const Body& body) : model_(body.model), damage_(body.damage), fans_(model_.positions.size()) {
        for (const mechanics::Spring& s : model_.springs)
            if (s.kind != mechanics::SpringKind::bend && !damage_.isSevered(s.a, s.b)) held_.insert(edge(s.a, s.b));
        eachTetrahedron(false, [this](const std::array<int, 4>& corners) { addFan(corners); });
        if (!model_.cells.empty()) return;
        for (std::size_t t = 0; t < model_.triangles.size(); ++t)
            if (!damage_.isTriangleGone(t)) addFan(model_.triangles[t]);
    }

    Skin cut() {
        for (std::size_t t = 0; t < model_.triangles.size(); ++t) addTriangle(static_cast<int>(t));
        eachTetrahedron(true, [this](const std::array<int, 4>& corners) { addCutFaces(corners); });
        for (const auto& [ends, number] : known_) {
            SkinVertex& vertex = skin_.vertices[static_cast<std::size_t>(number)];
            if (ends.second >= 0) vertex.terms = termsBeyond(ends.first, vertex.rest - rest(ends.first));
        }
        return std::move(skin_);
    }

    Skin blunt(double back) {
        std::map<int, std::vector<CutEdge>> cuts;  // (points)
        for (const auto& [ends, share] : damage_.edges()) {
            const dvec3 along = rest(ends.second) - rest(ends.first);
            cuts[ends.first].push_back({along, share * along});
            cuts[ends.second].push_back({-along, (share - 1.0) * along});
        }
        const auto add = [&](const std::array<int, 3>& corners, int source) {
            SkinTriangle& triangle = skin_.triangles.emplace_back(SkinTriangle{corners, source});
            for (int& corner : triangle.vertices) corner = vertexAt(corner);
        };
        for (std::size_t t = 0; t < model_.triangles.size(); ++t)
            if (!damage_.isTriangleGone(t)) add(model_.triangles[t], static_cast<int>(t));
        for (const std::array<int, 3>& face : bareFaces()) add(face, -1);
        for (const auto& [ends, number] : known_) {
            const auto found = cuts.find(ends.first);
            if (found == cuts.end() || fans_[static_cast<std::size_t>(ends.first)].empty()) continue;
            SkinVertex& vertex = skin_.vertices[static_cast<std::size_t>(number)];
            const dvec3 way = wayOut(found->second, back);
            vertex.terms = termsBeyond(ends.first, way);
            vertex.rest += way;
        }
        return std::move(skin_);
    }

  private:
    using Corners = std::vector<int>;

    struct CutEdge {
        dvec3 along, cut;  // [m] from a point: to its other end, and to where it is severed
    };

    // Straight to the plane of the cuts, nearly. All of a plane go by the same map, which no surface crosses itself by.
    // So where something tore, and cuts lie in no plane, they stay.
    static dvec3 wayOut(std::span<const CutEdge> edges, double back) {
        constexpr double share = 0.95, leastTwist = 1e-3, flatness = 0.1;
        dvec3 mean(0.0), out(0.0), normal(0.0);
        for (const CutEdge& edge : edges) {
            mean += edge.cut / static_cast<double>(edges.size());
            out += edge.along;
        }
        for (std::size_t i = 0; i < edges.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const dvec3 across = glm::cross(edges[i].cut - mean, edges[j].cut - mean);
                normal += glm::dot(across, out) < 0 ? -across : across;
            }
        const bool areInLine = !(glm::length(normal) > leastTwist * glm::dot(edges[0].along, edges[0].along));
        if (areInLine) normal = out;
        if (!(glm::length(normal) > 0)) return dvec3(0.0);
        normal = glm::normalize(normal);
        const auto isBeside = [&](const CutEdge& edge) {
            return std::abs(glm::dot(edge.cut - mean, normal)) > flatness * glm::length(edge.along);
        };
        if (!areInLine && std::any_of(edges.begin(), edges.end(), isBeside)) return dvec3(0.0);
        return (share * glm::dot(mean, normal) - back) * normal;
    }

    // Of whole tetrahedra, those that neither another one nor the surface of the model has, counter-clockwise seen from
    // outside.
    std::vector<std::array<int, 3>> bareFaces() const {
        using Face = std::array<int, 3>;
        const auto key = [](Face face) {
            std::sort(face.begin(), face.end());
            return face;
        };
        std::map<Face, int> users;
        for (std::size_t t = 0; t < model_.triangles.size(); ++t)
            if (!damage_.isTriangleGone(t)) ++users[key(model_.triangles[t])];
        std::vector<Face> faces;
        eachTetrahedron(
            false,
            [&](const std::array<int, 4>& p) {
                for (const Face& face :
                     {Face{p[0], p[2], p[1]}, Face{p[0], p[1], p[3]}, Face{p[0], p[3], p[2]}, Face{p[1], p[2], p[3]}}) {
                    ++users[key(face)];
                    faces.push_back(face);
                }
            });
        std::erase_if(faces, [&](const Face& face) { return users[key(face)] > 1; });
        return faces;
    }

    // Visits the corners of the tetrahedra that are gone, or of those that are whole.
    template <class Visit>
    void eachTetrahedron(bool isGone, Visit&& visit) const {
        for (std::size_t c = 0; c < model_.cells.size(); ++c)
            for (std::size_t n = 0; n < mechanics::cellTetrahedra.size(); ++n)
                if (damage_.isTetrahedronGone(c, n) == isGone) visit(tetrahedronOf(model_.cells[c], n));
    }

    static Damage::Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
    const dvec3& rest(int point) const { return model_.positions[static_cast<std::size_t>(point)]; }

    // Whole triangles or tetrahedra at a point, as their other corners. They tell what the surface is like there.
    template <std::size_t N>
    void addFan(const std::array<int, N>& corners) {
        for (int corner : corners) {
            Corners others;
            for (int other : corners)
                if (other != corner) others.push_back(other);
            fans_[static_cast<std::size_t>(corner)].push_back(others);
        }
    }

    // Groups of corners that springs still hold together, in their order.
    template <std::size_t N>
    std::vector<Corners> groupsOf(const std::array<int, N>& corners) const {
        std::vector<Corners> groups;
        for (int corner : corners) {
            Corners merged;
            std::erase_if(groups, [&](const Corners& group) {
                if (std::none_of(group.begin(), group.end(), [&](int o) { return held_.count(edge(corner, o)) > 0; }))
                    return false;
                merged.insert(merged.end(), group.begin(), group.end());
                return true;
            });
            merged.push_back(corner);
            groups.push_back(merged);
        }
        return groups;
    }

    // The vertex at a point.
    int vertexAt(int point) {
        const auto [entry, isNew] = known_.try_emplace({point, -1}, static_cast<int>(skin_.vertices.size()));
        if (isNew) skin_.vertices.push_back({{{point, 1.0F}}, rest(point), model_.uv[static_cast<std::size_t>(point)]});
        return entry->second;
    }

    // The vertex where the edge from a to b is severed, attached to a. Where nothing whole is left at a, that is a
    // itself.
    int vertexBeyond(int a, int b) {
        if (fans_[static_cast<std::size_t>(a)].empty()) return vertexAt(a);
        const auto [entry, isNew] = known_.try_emplace({a, b}, static_cast<int>(skin_.vertices.size()));
        if (!isNew) return entry->second;
        const double share = damage_.share(a, b);
        const dvec2 from = model_.uv[static_cast<std::size_t>(a)], to = model_.uv[static_cast<std::size_t>(b)];
        skin_.vertices.push_back({{}, rest(a) + share * (rest(b) - rest(a)), from + share * (to - from)});
        return entry->second;
    }

    // The place at `way` [m] of the model from a, carried along by the whole triangles at a, as a weighted mean with
    // more weight where they extend less, or by the tetrahedron that extends least. Without any of these, a itself.
    std::vector<SkinVertex::Term> termsBeyond(int a, const dvec3& way) const {
        std::map<int, double> weights;
        double sum = 0, most = 0;
        for (const Corners& others : fans_[static_cast<std::size_t>(a)]) {
            std::vector<double> part = inCorners(a, others, way);
            if (part.empty()) continue;
            double size = 0;
            for (double p : part) size += std::abs(p);
            const double weight = 1 / (1e-3 + size);
            if (others.size() == 3) {
                if (weight <= most) continue;
                most = weight;
                weights.clear();
                sum = 0;
            }
            sum += weight;
            for (std::size_t i = 0; i < others.size(); ++i) {
                weights[others[i]] += weight * part[i];
                weights[a] -= weight * part[i];
            }
        }
        std::vector<SkinVertex::Term> terms;
        double ofA = 1;
        for (const auto& [point, weight] : weights)
            if (point == a)
                ofA += weight / sum;
            else
                terms.push_back({point, static_cast<float>(weight / sum)});
        terms.push_back({a, static_cast<float>(ofA)});
        return terms;
    }

    // `way` as a combination of the edges from a to the others; least squares if they span only a plane.
    std::vector<double> inCorners(int a, const Corners& others, const dvec3& way) const {
        const dvec3 e = rest(others[0]) - rest(a), f = rest(others[1]) - rest(a);
        if (others.size() == 3) {
            const glm::dmat3 edges(e, f, rest(others[2]) - rest(a));
            if (!(std::abs(glm::determinant(edges)) > 0)) return {};
            const dvec3 parts = glm::inverse(edges) * way;
            return {parts.x, parts.y, parts.z};
        }
        const double ee = glm::dot(e, e), ef = glm::dot(e, f), ff = glm::dot(f, f), det = ee * ff - ef * ef;
        if (!(det > 0)) return {};
        const double we = glm::dot(way, e), wf = glm::dot(way, f);
        return {(ff * we - ef * wf) / det, (ee * wf - ef * we) / det};
    }

    void add(int a, int b, int c, int source) {
        if (a != b && b != c && c != a) skin_.triangles.push_back({{a, b, c}, source});
    }

    void addTriangle(int number) {
        const std::array<int, 3>& t = model_.triangles[static_cast<std::size_t>(number)];
        const std::vector<Corners> groups = damage_.isTriangleGone(static_cast<std::size_t>(number))
                                                ? groupsOf(t)
                                                : std::vector<Corners>{{t[0], t[1], t[2]}};
        if (groups.size() == 1) return add(vertexAt(t[0]), vertexAt(t[1]), vertexAt(t[2]), number);
        for (const Corners& group : groups) {
            // The corner of the triangle that represents the group: the only one in it, or the only one not in it.
            std::size_t k = 0;
            const auto isIn = [&](int corner) { return std::find(group.begin(), group.end(), corner) != group.end(); };
            while (isIn(t[k]) != (group.size() == 1)) ++k;
            const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            if (group.size() == 1) {
                add(vertexAt(a), vertexBeyond(a, b), vertexBeyond(a, c), number);
            } else {
                add(vertexAt(b), vertexAt(c), vertexBeyond(c, a), number);
                add(vertexAt(b), vertexBeyond(c, a), vertexBeyond(b, a), number);
            }
        }
    }

    // Adds the faces that a cut through a tetrahedron bares on each part: a triangle, or a quadrangle between two
    // pairs.
    void addCutFaces(const std::array<int, 4>& corners) {
        for (const Corners& group : groupsOf(corners)) {
            Corners others;
            for (int corner : corners)
                if (std::find(group.begin(), group.end(), corner) == group.end()) others.push_back(corner);
            std::vector<int> face;
            if (group.size() == 2)
                face = {vertexBeyond(group[0], others[0]), vertexBeyond(group[0], others[1]),
                        vertexBeyond(group[1], others[1]), vertexBeyond(group[1], others[0])};
            else
                for (int a : group)
                    for (int b : others) face.push_back(vertexBeyond(a, b));
            // Where nothing whole is left at a corner its vertices are one.
            face.erase(std::unique(face.begin(), face.end()), face.end());
            if (face.size() > 1 && face.front() == face.back()) face.pop_back();
            if (face.size() < 3) continue;
            const auto at = [&](std::size_t i) { return skin_.vertices[static_cast<std::size_t>(face[i])].rest; };
            dvec3 inside(0.0);
            for (int a : group) inside += rest(a) / static_cast<double>(group.size());
            dvec3 normal(0.0);  // some of its triangles may have no area
            for (std::size_t i = 2; i < face.size(); ++i) normal += glm::cross(at(i - 1) - at(0), at(i) - at(0));
            const bool isOutward = glm::dot(normal, at(0) - inside) > 0;
            for (std::size_t i = 2; i < face.size(); ++i)
                isOutward ? add(face[0], face[i - 1], face[i], -1) : add(face[0], face[i], face[i - 1], -1);
        }
    }

    const mechanics::Model& model_;
    const Damage& damage_;
    std::vector<std::vector<Corners>> fans_;  // (points)
    std::set<Damage::Edge> held_;             // edges with springs that are whole
    std::map<std::pair<int, int>, int> known_;
    Skin skin_;
};

}  // namespace

glm::vec3 SkinVertex::at(std::span<const glm::vec3> positions) const {
    glm::vec3 x(0.0F);
    for (const Term& term : terms) x += term.weight * positions[static_cast<std::size_t>(term.point)];
    return x;
}

Skin bluntSkinOf(const Body& body, double back) {
    return Cutter(body).blunt(back);
}

Skin skinOf(const Body& body) {
    return Cutter(body).cut();
}

}  // namespace taut::world
