#include "taut/damage/private/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "taut/damage/private/inside.h"
#include "taut/damage/private/remains.h"
#include "taut/damage/private/sides.h"

namespace taut::world {
namespace {

using Triangle = std::array<int, 3>;

constexpr double finest = 0.5;  // of a cell: no edge beside a cut is longer
constexpr int halvings = 20;    // until a crossing is known
constexpr int finer = 2;        // times that a cut face which is partly outside of the mesh is split into four

class MeshCutter {
  public:
    MeshCutter(const mechanics::Model& model, const Damage& damage, const BlockFrame& frame, const PlacedMesh& mesh)
        : model_(model),
          damage_(damage),
          frame_(frame),
          remains_(model, damage),
          sides_(damage, frame_, remains_),
          inside_(inCells(mesh.places), mesh.triangles, glm::ivec2(frame_.lattice().counts)),
          mesh_(mesh) {
        const dvec3& cell = frame_.lattice().cell;
        refine(mesh_, finest * std::min({cell.x, cell.y, cell.z}),
               [this](const Triangle& t) { return isBesideDamage(t); });
        std::vector<bool> isNeeded(mesh_.places.size(), false);
        for (const Triangle& t : mesh_.triangles) {
            isBeside_.push_back(isBesideDamage(t));
            if (isBeside_.back())
                for (const int v : t) isNeeded[v] = true;
        }
        for (std::size_t v = 0; v < isNeeded.size(); ++v)
            carriers_.push_back(isNeeded[v] ? sides_.carrierAt(mesh_.places[v]) : -1);
    }

    Skin cut() {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto add = [&](int a, int b, int c) { addTriangle({a, b, c}, static_cast<int>(t)); };
            const Triangle& corners = mesh_.triangles[t];
            const std::vector<Corners> groups = groupsOf(t);
            if (groups.size() == 1)
                add(vertexAt(corners[0]), vertexAt(corners[1]), vertexAt(corners[2]));
            else
                splitTriangle(
                    corners, groups, [this](int v) { return vertexAt(v); },
                    [this](int v, int w) { return vertexBeyond(v, w); }, add);
        }
        addFaces(
            cutFacesOf(model_, damage_), [this](const std::array<SkinVertex, 3>& face) { addInside(face, finer); });
        sides_.eachPlaneBeside([&](const glm::ivec3& cube, const Sides::Plane& plane) { addFaceIn(cube, plane); });
        return std::move(skin_);
    }

    Skin blunt(double back) {
        const auto isCarried = [this](int v) {
            const int carrier = carriers_[v];
            return carrier >= 0 && remains_.isAnyWholeAt(carrier);
        };
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const Triangle& corners = mesh_.triangles[t];
            if (!isBeside_[t] || (groupsOf(t).size() == 1 && std::all_of(corners.begin(), corners.end(), isCarried)))
                addTriangle({vertexAt(corners[0]), vertexAt(corners[1]), vertexAt(corners[2])}, static_cast<int>(t));
        }
        // A point in one place with another of the mesh would have no direction in which to press that.
        Skin faces = bluntSkinOf(model_, damage_, back);
        std::erase_if(faces.triangles, [&](const SkinTriangle& t) {
            return t.source >= 0 || std::any_of(t.vertices.begin(), t.vertices.end(),
                                                [&](int v) { return !isDeeper(faces.vertices[v].rest, back); });
        });
        addFaces(faces, [](const std::array<SkinVertex, 3>&) {});
        addLoosePoints();
        return std::move(skin_);
    }

  private:
    std::vector<dvec3> inCells(std::span<const dvec3> places) const {
        std::vector<dvec3> all;
        for (const dvec3& place : places) all.push_back(sides_.inCells(place));
        return all;
    }
    bool has(const dvec3& place) const { return inside_.has(sides_.inCells(place)); }

    bool isDeeper(const dvec3& place, double depth) const {
        for (int axis = 0; axis < 3; ++axis)
            for (const double way : {-depth, depth}) {
                dvec3 beside = place;
                beside[axis] += way;
                if (!has(beside)) return false;
            }
        return true;
    }

    // Of a triangle of the mesh.
    std::vector<Corners> groupsOf(std::size_t triangle) const {
        const Triangle& corners = mesh_.triangles[triangle];
        if (!isBeside_[triangle]) return {{corners[0], corners[1], corners[2]}};
        return world::groupsOf(corners, [this](int v, int w) { return sides_.areJoined(carriers_[v], carriers_[w]); });
    }

    bool isBesideDamage(const Triangle& t) const {
        const auto at = [&](std::size_t k) { return sides_.inCells(mesh_.places[t[k]]); };
        const auto cubeOf = [&](const dvec3& x) {
            return glm::clamp(glm::ivec3(glm::floor(x)), glm::ivec3(0), frame_.lattice().counts - 1);
        };
        const dvec3 a = at(0), b = at(1), c = at(2);
        const glm::ivec3 low = cubeOf(glm::min(a, glm::min(b, c))), high = cubeOf(glm::max(a, glm::max(b, c)));
        bool isBeside = false;
        Sides::eachCube(high - low + 1,
                        [&](const glm::ivec3& way) { isBeside = isBeside || !sides_.isWhole(low + way); });
        return isBeside;
    }

    int add(SkinVertex vertex) {
        skin_.vertices.push_back(std::move(vertex));
        return static_cast<int>(skin_.vertices.size()) - 1;
    }
    void addTriangle(const Triangle& t, int source) {
        if (t[0] >= 0 && t[1] >= 0 && t[2] >= 0) skin_.triangles.push_back({t, source});
    }

    // A vertex of the mesh: as part of its cell, or of the rest there. -1: of crumbs.
    int vertexAt(int v) {
        const auto [known, isNew] = known_.try_emplace({v, -1}, -1);
        if (!isNew) return known->second;
        SkinVertex vertex{{}, mesh_.places[v], mesh_.uv[v]};
        const dvec3 x = sides_.inCells(vertex.rest);
        if (const mechanics::LatticeCell& cell = sides_.cellAt(x); sides_.isWhole(cell)) {
            const mechanics::CarriedPoint carried = mechanics::carriedBy(cell, x);
            for (std::size_t k = 0; k < 8; ++k)
                vertex.terms.push_back({carried.points[k], static_cast<float>(carried.weights[k])});
        } else {
            const int carrier = carriers_[v];
            if (carrier < 0) return -1;
            remains_.carry(vertex, carrier);
        }
        return known->second = add(std::move(vertex));
    }

    // Where an edge of the mesh is cut, on the side of v.
    int vertexBeyond(int v, int w) {
        const auto [known, isNew] = known_.try_emplace({v, w}, -1);
        if (!isNew) return known->second;
        const bool isForward = v < w;
        const auto low = static_cast<std::size_t>(isForward ? v : w),
                   high = static_cast<std::size_t>(isForward ? w : v);
        const dvec3 from = mesh_.places[low], way = mesh_.places[high] - from;
        double left = 0.0, right = 1.0;
        for (int k = 0; k < halvings; ++k) {
            const double middle = 0.5 * (left + right);
            (sides_.areJoined(carriers_[low], sides_.carrierAt(from + middle * way)) ? left : right) = middle;
        }
        int carrier = sides_.carrierAt(from + (isForward ? left : right) * way);
        if (const int own = carriers_[v]; !sides_.areJoined(carrier, own)) carrier = own;
        if (carrier < 0) return -1;
        SkinVertex vertex{{}, from + left * way, mesh_.uv[low] + left * (mesh_.uv[high] - mesh_.uv[low])};
        remains_.carry(vertex, carrier);
        return known->second = add(std::move(vertex));
    }

    // Adds the faces that are inside of the mesh as they are, and visits the others.
    template <class Visit>
    void addFaces(const Skin& faces, const Visit& visit) {
        std::map<int, int> numbers;
        const auto at = [&](int v) -> const SkinVertex& { return faces.vertices[v]; };
        for (const SkinTriangle& face : faces.triangles) {
            Triangle t = face.vertices;
            const std::array<SkinVertex, 3> corners{at(t[0]), at(t[1]), at(t[2])};
            if (!isInside(corners)) {
                visit(corners);
                continue;
            }
            for (int& v : t) {
                const auto [number, isNew] = numbers.try_emplace(v, -1);
                if (isNew) number->second = add(at(v));
                v = number->second;
            }
            addTriangle(t, -1);
        }
    }

    // By its corners and the middles of its sides.
    bool isInside(const std::array<SkinVertex, 3>& face) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (!has(face[k].rest) || !has(0.5 * (face[k].rest + face[(k + 1) % 3].rest))) return false;
        return true;
    }

    // Adds a face as far as it is inside of the mesh.
    void addInside(const std::array<SkinVertex, 3>& face, int levels) {
        const auto& [a, b, c] = face;
        if (levels > 0 && !isInside(face)) {
            const SkinVertex ab = between(a, b, 0.5), bc = between(b, c, 0.5), ca = between(c, a, 0.5);
            for (const std::array<SkinVertex, 3>& part :
                 {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
                addInside(part, levels - 1);
            return;
        }
        std::vector<int> polygon;
        for (std::size_t k = 0; k < 3; ++k) {
            const SkinVertex &from = face[k], &to = face[(k + 1) % 3];
            const bool isIn = has(from.rest);
            if (isIn) polygon.push_back(add(from));
            if (isIn == has(to.rest)) continue;
            double left = 0.0, right = 1.0;
            for (int h = 0; h < halvings; ++h) {
                const double middle = 0.5 * (left + right);
                (has(glm::mix(from.rest, to.rest, middle)) == isIn ? left : right) = middle;
            }
            polygon.push_back(add(between(from, to, left)));
        }
        for (std::size_t k = 2; k < polygon.size(); ++k) addTriangle({polygon[0], polygon[k - 1], polygon[k]}, -1);
    }

    SkinVertex between(const SkinVertex& a, const SkinVertex& b, double share) const {
        SkinVertex vertex{{}, glm::mix(a.rest, b.rest, share), dvec2(0.0)};
        for (const SkinVertex* end : {&a, &b})
            if (end->above != 0.0F) {  // no sum of points lies between points above some
                remains_.carry(vertex, end->base[0]);
                return vertex;
            }
        std::map<int, float> terms;
        for (const auto& [point, weight] : a.terms) terms[point] += static_cast<float>(1.0 - share) * weight;
        for (const auto& [point, weight] : b.terms) terms[point] += static_cast<float>(share) * weight;
        for (const auto& [point, weight] : terms) vertex.terms.push_back({point, weight});
        return vertex;
    }

    // One side of a plane, as far as it is in a cube of the lattice and inside of the mesh.
    void addFaceIn(const glm::ivec3& cube, const Sides::Plane& plane) {
        if (plane.carrier < 0 || !(glm::length(plane.normal) > 0)) return;
        std::vector<SkinVertex> corners;
        for (const dvec3& place : planeIn(cube, plane))
            remains_.carry(corners.emplace_back(SkinVertex{{}, place, dvec2(0.0)}), plane.carrier);
        for (std::size_t k = 2; k < corners.size(); ++k) addInside({corners[0], corners[k - 1], corners[k]}, finer);
    }

    // [m] The part of a plane in a cube of the lattice, counter-clockwise seen from where its normal points.
    std::vector<dvec3> planeIn(const glm::ivec3& cube, const Sides::Plane& plane) const {
        const dvec3& cell = frame_.lattice().cell;
        const dvec3 middle = frame_.place(cell * (dvec3(cube) + 0.5)),
                    foot = middle + plane.depthOf(middle) * plane.normal;
        const dvec3 aside = std::abs(plane.normal.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        const dvec3 u = 2.0 * std::max({cell.x, cell.y, cell.z}) * glm::normalize(glm::cross(plane.normal, aside)),
                    v = glm::cross(plane.normal, u);
        std::vector<dvec3> polygon{foot - u - v, foot + u - v, foot + u + v, foot - u + v};
        for (int side = 0; side < 6; ++side) {
            const auto over = [&](const dvec3& place) {
                const double share = sides_.inCells(place)[side / 2] - cube[side / 2];
                return side % 2 == 0 ? share : 1.0 - share;
            };
            std::vector<dvec3> kept;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                const double ofA = over(a), ofB = over(b);
                if (ofA >= 0) kept.push_back(a);
                if ((ofA >= 0) != (ofB >= 0)) kept.push_back(a + ofA / (ofA - ofB) * (b - a));
            }
            polygon = std::move(kept);
        }
        return polygon;
    }

    // Points without any complete cell, as in a slice of one layer of points, touch by themselves; points outside of
    // the mesh where a spring to one inside comes out of it.
    void addLoosePoints() {
        for (int i = 0; i < model_.pointCount(); ++i) {
            if (remains_.isAnyWholeAt(i)) continue;
            SkinVertex vertex{{{i, 1.0F}}, remains_.rest(i), dvec2(0.0)};
            const Corners& beside = remains_.besideOf(i);
            const auto inner = std::find_if(beside.begin(), beside.end(), [&](int b) { return has(remains_.rest(b)); });
            if (inner != beside.end() && !has(vertex.rest)) {
                const SkinVertex other{{{*inner, 1.0F}}, remains_.rest(*inner), dvec2(0.0)};
                double out = 0.0, in = 1.0;
                for (int k = 0; k < halvings; ++k) {
                    const double middle = 0.5 * (out + in);
                    (has(glm::mix(vertex.rest, other.rest, middle)) ? in : out) = middle;
                }
                vertex = between(vertex, other, in);
            }
            add(std::move(vertex));
        }
    }

    const mechanics::Model& model_;
    const Damage& damage_;
    const BlockFrame& frame_;
    const Remains remains_;
    const Sides sides_;
    const Inside inside_;                       // of the mesh
    PlacedMesh mesh_;                           // refined beside damage
    std::vector<bool> isBeside_;                // (triangles) damage
    std::vector<int> carriers_;                 // (vertices of these)
    std::map<std::pair<int, int>, int> known_;  // vertices of the skin, by those of the mesh
    Skin skin_;
};

}  // namespace

Skin cutMesh(const mechanics::Model& model, const Damage& damage, const BlockFrame& frame, const PlacedMesh& mesh) {
    return MeshCutter(model, damage, frame, mesh).cut();
}

Skin bluntMesh(const mechanics::Model& model, const Damage& damage, const BlockFrame& frame, const PlacedMesh& mesh,
               double back) {
    return MeshCutter(model, damage, frame, mesh).blunt(back);
}

}  // namespace taut::world
