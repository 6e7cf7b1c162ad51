#include "taut/damage/private/skin_pieces.h"

#include <algorithm>
#include <cmath>

#include "taut/damage/private/remains.h"

namespace taut::world {
namespace {

class Cutter {
  public:
    Cutter(const mechanics::Model& model, const Damage& damage)
        : model_(model), damage_(damage), remains_(model, damage) {}

    Skin cut() {
        for (std::size_t t = 0; t < model_.triangles.size(); ++t) addTriangle(static_cast<int>(t));
        return faces(true);
    }

    // Faces exposed by cuts.
    Skin faces(bool ofCrumbsToo) {
        const auto isCarried = [this](int corner) { return remains_.carrierOf(corner) >= 0; };
        remains_.eachTetrahedron(true, [&](const std::array<int, 4>& corners) {
            for (const Corners& group : remains_.groupsOf(corners))
                if (ofCrumbsToo || std::all_of(group.begin(), group.end(), isCarried)) addCutFace(corners, group);
        });
        for (const auto& [ends, number] : known_) {
            SkinVertex& vertex = skin_.vertices[number];
            if (ends.second >= 0) remains_.carry(vertex, ends.first);
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
        for (int i = 0; i < model_.pointCount(); ++i)
            if (!remains_.isAnyWholeAt(i)) vertexAt(i);
        for (const auto& [ends, number] : known_) {
            const auto found = cuts.find(ends.first);
            if (found == cuts.end() || !remains_.isAnyWholeAt(ends.first)) continue;
            SkinVertex& vertex = skin_.vertices[number];
            vertex.rest += wayOut(found->second, back);
            remains_.carry(vertex, ends.first);
        }
        return std::move(skin_);
    }

  private:
    struct CutEdge {
        dvec3 along, cut;  // [m] from a point: to its other end, and to where it is severed
    };

    // Straight to the plane of the cuts, nearly. All of a plane go by the same map, which no surface crosses itself by.
    // So where something tore, and cuts lie in no plane, they stay.
    static dvec3 wayOut(std::span<const CutEdge> edges, double back) {
        constexpr double share = 0.95, leastTwist = 1e-3, flatness = 0.1;
        dvec3 mean(0.0), out(0.0);
        std::vector<dvec3> cuts;
        for (const CutEdge& edge : edges) {
            cuts.push_back(edge.cut);
            mean += edge.cut / static_cast<double>(edges.size());
            out += edge.along;
        }
        dvec3 normal = normalThrough(cuts, mean, out);
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

    // Faces of complete tetrahedra that neither another one nor the surface of the model has, counter-clockwise seen
    // from outside.
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
        remains_.eachTetrahedron(
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

    const dvec3& rest(int point) const { return remains_.rest(point); }

    // The vertex at a point.
    int vertexAt(int point) {
        const auto [entry, isNew] = known_.try_emplace({point, -1}, static_cast<int>(skin_.vertices.size()));
        if (isNew) skin_.vertices.push_back({{{point, 1.0F}}, rest(point), model_.uv[point]});
        return entry->second;
    }

    // The vertex where the edge from a to b is severed, attached to a. Where nothing at a can carry it, that is a
    // itself.
    int vertexBeyond(int a, int b) {
        if (remains_.carrierOf(a) < 0) return vertexAt(a);
        const auto [entry, isNew] = known_.try_emplace({a, b}, static_cast<int>(skin_.vertices.size()));
        if (!isNew) return entry->second;
        const double share = damage_.share(a, b);
        const dvec2 from = model_.uv[a], to = model_.uv[b];
        skin_.vertices.push_back({{}, rest(a) + share * (rest(b) - rest(a)), from + share * (to - from)});
        return entry->second;
    }

    void add(int a, int b, int c, int source) {
        if (a != b && b != c && c != a) skin_.triangles.push_back({{a, b, c}, source});
    }

    void addTriangle(int number) {
        const std::array<int, 3>& t = model_.triangles[number];
        if (!damage_.isTriangleGone(static_cast<std::size_t>(number)))
            return add(vertexAt(t[0]), vertexAt(t[1]), vertexAt(t[2]), number);
        const std::vector<Corners> groups = remains_.groupsOf(t);
        if (groups.size() == 1) return add(vertexAt(t[0]), vertexAt(t[1]), vertexAt(t[2]), number);
        splitTriangle(
            t, groups, [this](int a) { return vertexAt(a); }, [this](int a, int b) { return vertexBeyond(a, b); },
            [&](int a, int b, int c) { add(a, b, c, number); });
    }

    // Adds the face that a cut through a tetrahedron bares on a part: a triangle, or a quadrangle between two pairs.
    void addCutFace(const std::array<int, 4>& corners, const Corners& group) {
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
        if (face.size() < 3) return;
        const auto at = [&](std::size_t i) { return skin_.vertices[face[i]].rest; };
        dvec3 inside(0.0);
        for (int a : group) inside += rest(a) / static_cast<double>(group.size());
        dvec3 normal(0.0);  // some of its triangles may have no area
        for (std::size_t i = 2; i < face.size(); ++i) normal += glm::cross(at(i - 1) - at(0), at(i) - at(0));
        const bool isOutward = glm::dot(normal, at(0) - inside) > 0;
        for (std::size_t i = 2; i < face.size(); ++i)
            isOutward ? add(face[0], face[i - 1], face[i], -1) : add(face[0], face[i], face[i - 1], -1);
    }

    const mechanics::Model& model_;
    const Damage& damage_;
    const Remains remains_;
    std::map<std::pair<int, int>, int> known_;
    Skin skin_;
};

}  // namespace

glm::vec3 SkinVertex::at(std::span<const glm::vec3> positions) const {
    glm::vec3 x(0.0F);
    const auto place = [&](int point) { return positions[point]; };
    for (const Term& term : terms) x += term.weight * place(term.point);
    if (above == 0.0F) return x;
    const glm::vec3 normal = glm::cross(place(base[1]) - place(base[0]), place(base[2]) - place(base[0]));
    const float length = glm::length(normal);
    return length > 0.0F ? x + above / length * normal : x;
}

Skin bluntSkinOf(const mechanics::Model& model, const Damage& damage, double back) {
    return Cutter(model, damage).blunt(back);
}

Skin skinOf(const mechanics::Model& model, const Damage& damage) {
    return Cutter(model, damage).cut();
}

Skin cutFacesOf(const mechanics::Model& model, const Damage& damage) {
    return Cutter(model, damage).faces(false);
}

}  // namespace taut::world
