#include "taut/bodies/private/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "taut/bodies/private/carried_surface.h"
#include "taut/bodies/private/remains.h"

namespace taut::world {
namespace {

using Triangle = std::array<int, 3>;

constexpr double finest = 0.5;       // of a cell: no edge beside a cut is longer
constexpr int halvings = 20;         // until a crossing is known
constexpr int faceDivisions = 4;     // of a cut face that is partly outside of the mesh
constexpr double offLattice = 1e-7;  // of a cell: nothing is looked at straight through an edge

// What is inside of a closed mesh, from what lies over a place: it goes round it at least once.
class Inside {
  public:
    // Places in cells of the lattice, which has so many.
    Inside(std::vector<dvec3> places, std::span<const Triangle> triangles, glm::ivec3 counts)
        : places_(std::move(places)), counts_(counts), columns_(numberOf({counts.x, counts.y})) {
        for (const Triangle& t : triangles) {
            const dvec3 &a = at(t[0]), &b = at(t[1]), &c = at(t[2]);
            const glm::ivec2 low = columnAt(glm::min(a, glm::min(b, c))), high = columnAt(glm::max(a, glm::max(b, c)));
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) columns_[numberOf({x, y})].push_back(t);
        }
    }

    bool has(dvec3 place) const {
        place += offLattice * dvec3(1.0, 0.618, 0.0);
        int around = 0;
        for (const Triangle& t : columns_[numberOf(columnAt(place))]) {
            const dvec3 a = at(t[0]) - place, b = at(t[1]) - place, c = at(t[2]) - place;
            const double ofA = b.x * c.y - b.y * c.x, ofB = c.x * a.y - c.y * a.x, ofC = a.x * b.y - a.y * b.x;
            const double all = ofA + ofB + ofC;
            const bool isOver = (ofA > 0) == (ofB > 0) && (ofB > 0) == (ofC > 0) && all != 0.0;
            if (isOver && (ofA * a.z + ofB * b.z + ofC * c.z) / all > 0) around += all > 0 ? 1 : -1;
        }
        return around > 0;
    }

  private:
    const dvec3& at(int i) const { return places_[static_cast<std::size_t>(i)]; }
    glm::ivec2 columnAt(const dvec3& place) const {
        return glm::clamp(glm::ivec2(glm::floor(dvec2(place))), glm::ivec2(0), glm::ivec2(counts_) - 1);
    }
    std::size_t numberOf(glm::ivec2 column) const {
        return static_cast<std::size_t>(column.x) +
               static_cast<std::size_t>(counts_.x) * static_cast<std::size_t>(column.y);
    }

    std::vector<dvec3> places_;
    glm::ivec3 counts_;
    std::vector<std::vector<Triangle>> columns_;
};

class MeshCutter {
  public:
    MeshCutter(const Body& body, const PlacedMesh& mesh)
        : body_(body), frame_(body), remains_(body), neighbours_(body.model.positions.size()), mesh_(mesh) {
        for (const auto& [a, b] : remains_.springs()) {
            neighbours_[static_cast<std::size_t>(a)].push_back(b);
            neighbours_[static_cast<std::size_t>(b)].push_back(a);
        }
        for (const mechanics::LatticeCell& cell : frame_.lattice().cells) {
            int number = static_cast<int>(mechanics::cellTetrahedra.size()) - 1;
            while (number >= 0 && remains_.groupsOf(cornersOf(cell, number)).size() == 1) --number;
            firstGone_.push_back(number);
        }
        findStandIns();
        std::vector<dvec3> places;
        for (const dvec3& place : mesh.places) places.push_back(inCells(place));
        inside_.emplace(std::move(places), mesh.triangles, frame_.lattice().counts);
        while (refine()) {
        }
        for (const dvec3& place : mesh_.places) owners_.push_back(ownerAt(place));
    }

    Skin cut() {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const Triangle& corners = mesh_.triangles[t];
            const auto add = [&](int a, int b, int c) { addTriangle({a, b, c}, static_cast<int>(t)); };
            const std::vector<Corners> groups = groupsOf(corners);
            if (groups.size() == 1)
                add(vertexAt(corners[0]), vertexAt(corners[1]), vertexAt(corners[2]));
            else
                splitTriangle(
                    corners, groups, [this](int v) { return vertexAt(v); },
                    [this](int v, int w) { return vertexBeyond(v, w); }, add);
        }
        const Skin faces = cutFacesOf(body_);
        for (const SkinTriangle& face : faces.triangles) addInside(faces, face);
        addFacesBeside();
        return std::move(skin_);
    }

    Skin blunt(double back) {
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const Triangle& corners = mesh_.triangles[t];
            const auto isCarried = [this](int v) {
                const int owner = owners_[static_cast<std::size_t>(v)];
                return owner >= 0 && remains_.isAnyWholeAt(owner);
            };
            if (groupsOf(corners).size() == 1 && std::all_of(corners.begin(), corners.end(), isCarried))
                addTriangle({vertexAt(corners[0]), vertexAt(corners[1]), vertexAt(corners[2])}, static_cast<int>(t));
        }
        const Skin faces = bluntSkinOf(body_, back);
        addLoosePoints();
        const auto isInside = [&](int v) { return has(faces.vertices[static_cast<std::size_t>(v)].rest); };
        for (const SkinTriangle& face : faces.triangles)
            if (face.source < 0 && std::all_of(face.vertices.begin(), face.vertices.end(), isInside))
                addTriangle({faceVertex(faces, face.vertices[0]), faceVertex(faces, face.vertices[1]),
                             faceVertex(faces, face.vertices[2])},
                            -1);
        return std::move(skin_);
    }

  private:
    // Points at which nothing is whole, as in a slice that is one layer of them, touch by themselves; those outside of
    // the mesh where a spring to one inside comes out of it.
    void addLoosePoints() {
        for (int i = 0; i < body_.model.pointCount(); ++i) {
            if (remains_.isAnyWholeAt(i)) continue;
            const std::vector<int>& beside = neighbours_[static_cast<std::size_t>(i)];
            const auto inner = std::find_if(beside.begin(), beside.end(), [&](int b) { return has(remains_.rest(b)); });
            double out = 0.0, in = 1.0;  // on the way to that
            const dvec3 way = inner == beside.end() ? dvec3(0.0) : remains_.rest(*inner) - remains_.rest(i);
            for (int k = 0; k < halvings && inner != beside.end(); ++k) {
                const double middle = 0.5 * (out + in);
                (has(remains_.rest(i) + middle * way) ? in : out) = middle;
            }
            if (inner == beside.end() || has(remains_.rest(i)))
                add({{{i, 1.0F}}, remains_.rest(i), dvec2(0.0)});
            else
                add({{{i, static_cast<float>(1.0 - in)}, {*inner, static_cast<float>(in)}},
                     remains_.rest(i) + in * way,
                     dvec2(0.0)});
        }
    }

    dvec3 inCells(const dvec3& place) const { return frame_.inside(place) / frame_.lattice().cell; }
    bool has(const dvec3& place) const { return inside_->has(inCells(place)); }

    // The number of a tetrahedron of the cell of which the corners do not hold together; -1: none.
    int firstGone(const mechanics::LatticeCell& cell) const {
        return firstGone_[static_cast<std::size_t>(&cell - frame_.lattice().cells.data())];
    }
    bool isWhole(const mechanics::LatticeCell& cell) const { return firstGone(cell) < 0; }

    // The cell that carries what is there; a damaged one beside it, of places that are in none, so that what is on one
    // side of a cut goes with that.
    const mechanics::LatticeCell& cellAt(const dvec3& x) const {
        const mechanics::Lattice& lattice = frame_.lattice();
        const glm::ivec3 at = glm::clamp(glm::ivec3(glm::floor(x)), glm::ivec3(0), lattice.counts - 1);
        const int standIn = standIns_[lattice.indexOf(at)];
        return standIn >= 0 ? lattice.cells[static_cast<std::size_t>(standIn)] : lattice.carrierOf(x);
    }
    void findStandIns() {
        const mechanics::Lattice& lattice = frame_.lattice();
        standIns_.assign(lattice.carriers.size(), -1);
        eachCube(lattice.counts, [&](const glm::ivec3& at) {
            if (lattice.carriers[lattice.indexOf(at)] < 0 || lattice.cellAt(at) >= 0) return;
            int nearest = 4;  // as a square
            eachCube(glm::ivec3(3), [&](const glm::ivec3& beside) {
                const glm::ivec3 way = beside - 1;
                const int cell = lattice.cellAt(at + way), square = way.x * way.x + way.y * way.y + way.z * way.z;
                if (cell < 0 || square >= nearest || isWhole(lattice.cells[static_cast<std::size_t>(cell)])) return;
                nearest = square;
                standIns_[lattice.indexOf(at)] = cell;
            });
        });
    }
    template <class Visit>
    static void eachCube(const glm::ivec3& counts, const Visit& visit) {
        for (int z = 0; z < counts.z; ++z)
            for (int y = 0; y < counts.y; ++y)
                for (int x = 0; x < counts.x; ++x) visit(glm::ivec3(x, y, z));
    }

    struct Tetrahedron {
        std::array<int, 4> corners;
        std::array<double, 4> weights;  // of the corners at a place
    };

    // That in which a place is: it has the corners that lead from 0 to 7 along the axes by how far it is along each. Of
    // a place that is outside of its cell, the first of that which is gone, so that all that is there goes by one
    // plane.
    Tetrahedron tetrahedronAt(const dvec3& place) const {
        const dvec3 x = inCells(place);
        const mechanics::LatticeCell& cell = cellAt(x);
        const dvec3 share = glm::clamp(x - dvec3(cell.at), 0.0, 1.0);
        if (share != x - dvec3(cell.at) && !isWhole(cell)) {
            Tetrahedron gone{cornersOf(cell, firstGone(cell)), {}};
            for (std::size_t k = 0; k < 4; ++k)
                gone.weights[k] = 1.0 / (1.0 + glm::distance(remains_.rest(gone.corners[k]), place));
            return gone;
        }
        std::array<int, 3> axes{0, 1, 2};
        std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return share[a] > share[b]; });
        Tetrahedron own{
            {cell.points[0]},
            {1.0 - share[axes[0]], share[axes[0]] - share[axes[1]], share[axes[1]] - share[axes[2]], share[axes[2]]}};
        std::size_t corner = 0;
        for (std::size_t k = 0; k < 3; ++k)
            own.corners[k + 1] = cell.points[corner += std::size_t{1} << static_cast<unsigned>(axes[k])];
        return own;
    }

    static std::array<int, 4> cornersOf(const mechanics::LatticeCell& cell, int number) {
        const auto& t = mechanics::cellTetrahedra[static_cast<std::size_t>(number)];
        return {cell.points[t[0]], cell.points[t[1]], cell.points[t[2]], cell.points[t[3]]};
    }

    // The corner with which a place goes: of its tetrahedron the nearest one on its side of the cut; crumbs go with the
    // other side. -1: there is nothing but crumbs.
    int ownerAt(const dvec3& place) const {
        const auto [corners, weights] = tetrahedronAt(place);
        const std::vector<Corners> groups = remains_.groupsOf(corners);
        int owner = -1;
        double deepest = -std::numeric_limits<double>::infinity();
        for (const Corners& group : groups) {
            const int carrier = carrierOf(group, corners, weights);
            if (carrier < 0) continue;
            const double depth = groups.size() == 1 ? 0.0 : planeOf(group, corners).depthOf(place);
            if (depth <= deepest) continue;
            deepest = depth;
            owner = carrier;
        }
        return owner;
    }

    // What carries a place on the side of a group: of its corners that with most weight. -1: they are crumbs.
    int carrierOf(const Corners& group, const std::array<int, 4>& corners, const std::array<double, 4>& weights) const {
        int carrier = -1;
        double most = -1.0;
        for (std::size_t k = 0; k < 4; ++k) {
            if (std::find(group.begin(), group.end(), corners[k]) == group.end()) continue;
            const int own = remains_.carrierOf(corners[k]);
            const double weight = weights[k] + (own == corners[k] ? 1.0 : 0.0);
            if (own < 0 || weight <= most) continue;
            most = weight;
            carrier = own;
        }
        return carrier;
    }

    // Of a cut through a tetrahedron, for the side of a group of its corners.
    struct Plane {
        dvec3 middle, normal;  // the unit normal points away from the group; 0 where the cut is no plane
        double depthOf(const dvec3& place) const { return glm::dot(middle - place, normal); }  // [m]
    };
    Plane planeOf(const Corners& group, const std::array<int, 4>& corners) const {
        std::vector<dvec3> cuts;
        dvec3 out(0.0), middle(0.0);
        for (const int a : group)
            for (const int b : corners) {
                if (std::find(group.begin(), group.end(), b) != group.end()) continue;
                const dvec3 along = remains_.rest(b) - remains_.rest(a);
                cuts.push_back(remains_.rest(a) + body_.damage.share(a, b) * along);
                out += along;
                middle += cuts.back();
            }
        middle /= static_cast<double>(cuts.size());
        const dvec3 normal = normalThrough(cuts, middle, out);
        return {middle, glm::length(normal) > 0 ? glm::normalize(normal) : normal};
    }

    // Faces of cuts where the mesh has so little in a cube of the lattice that this has no cell there: the plane beside
    // it goes on.
    void addFacesBeside() {
        const mechanics::Lattice& lattice = frame_.lattice();
        eachCube(lattice.counts, [&](const glm::ivec3& at) {
            const int standIn = standIns_[lattice.indexOf(at)];
            if (standIn < 0) return;
            const mechanics::LatticeCell& cell = lattice.cells[static_cast<std::size_t>(standIn)];
            addFacesIn(at, cornersOf(cell, firstGone(cell)));
        });
    }
    void addFacesIn(const glm::ivec3& at, const std::array<int, 4>& corners) {
        for (const Corners& group : remains_.groupsOf(corners)) {
            const int owner = carrierOf(group, corners, {1.0, 1.0, 1.0, 1.0});
            const Plane plane = planeOf(group, corners);
            if (owner < 0 || !(glm::length(plane.normal) > 0)) continue;
            Skin face;
            for (const dvec3& place : planeIn(at, plane)) {
                SkinVertex& vertex = face.vertices.emplace_back(SkinVertex{{}, place, dvec2(0.0)});
                remains_.carry(vertex, owner);
            }
            ofFaces_.clear();
            for (int k = 2; k < static_cast<int>(face.vertices.size()); ++k) addInside(face, {{0, k - 1, k}, -1});
        }
    }

    // [m] The part of a plane in a cube of the lattice, counter-clockwise seen from where its normal points.
    std::vector<dvec3> planeIn(const glm::ivec3& at, const Plane& plane) const {
        const dvec3& cell = frame_.lattice().cell;
        const dvec3 middle = frame_.place(cell * (dvec3(at) + 0.5));
        const dvec3 n = plane.normal,
                    u = glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0))),
                    v = glm::cross(n, u);
        const dvec3 foot = middle + plane.depthOf(middle) * n;
        const double side = 2.0 * std::max({cell.x, cell.y, cell.z});
        std::vector<dvec3> polygon{foot - side * u - side * v, foot + side * u - side * v, foot + side * u + side * v,
                                   foot - side * u + side * v};
        for (int axis = 0; axis < 3; ++axis)
            for (const bool isHigh : {false, true}) {
                const auto over = [&](const dvec3& place) {
                    const double share = inCells(place)[axis] - at[axis];
                    return isHigh ? 1.0 - share : share;
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

    // Whether two corners that are near each other hold together, by three springs at most.
    bool areJoined(int a, int b) {
        if (a == b || a < 0 || b < 0 || remains_.hold(a, b)) return true;
        const auto [known, isNew] = areJoined_.try_emplace({std::min(a, b), std::max(a, b)}, false);
        if (!isNew) return known->second;
        const std::vector<int>& beside = neighbours_[static_cast<std::size_t>(b)];
        for (const int via : neighbours_[static_cast<std::size_t>(a)])
            if (std::any_of(beside.begin(), beside.end(),
                            [&](int other) { return other == via || remains_.hold(other, via); })) {
                known->second = true;
                break;
            }
        return known->second;
    }

    // Of a triangle of the mesh.
    std::vector<Corners> groupsOf(const Triangle& corners) {
        return world::groupsOf(
            corners,
            [this](int v, int w) {
                return areJoined(owners_[static_cast<std::size_t>(v)], owners_[static_cast<std::size_t>(w)]);
            });
    }

    // Halves edges of triangles beside damaged cells. Returns whether there were any.
    bool refine() {
        const mechanics::Lattice& lattice = frame_.lattice();
        const double most = finest * std::min({lattice.cell.x, lattice.cell.y, lattice.cell.z});
        const auto at = [&](int v) { return mesh_.places[static_cast<std::size_t>(v)]; };
        const auto edge = [](int v, int w) { return std::pair(std::min(v, w), std::max(v, w)); };
        std::map<std::pair<int, int>, int> middles;
        for (const Triangle& t : mesh_.triangles) {
            if (!isBesideDamage(t)) continue;
            for (std::size_t k = 0; k < 3; ++k)
                if (const int v = t[k], w = t[(k + 1) % 3]; glm::distance(at(v), at(w)) > most)
                    middles.try_emplace(edge(v, w), -1);
        }
        for (auto& [ends, middle] : middles) {
            middle = static_cast<int>(mesh_.places.size());
            mesh_.places.push_back(0.5 * (at(ends.first) + at(ends.second)));
            mesh_.uv.push_back(0.5 * (mesh_.uv[static_cast<std::size_t>(ends.first)] +
                                      mesh_.uv[static_cast<std::size_t>(ends.second)]));
        }
        std::vector<Triangle> finer;
        for (const Triangle& t : mesh_.triangles) {
            std::array<int, 3> middle{-1, -1, -1};  // beyond corner k
            for (std::size_t k = 0; k < 3; ++k)
                if (const auto found = middles.find(edge(t[k], t[(k + 1) % 3])); found != middles.end())
                    middle[k] = found->second;
            // From the corner before which no edge is halved, if there is one: the rest is a fan.
            std::size_t first = 0;
            while (first < 3 && (middle[first] < 0 || middle[(first + 2) % 3] >= 0)) ++first;
            first %= 3;
            const int a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
            const int ab = middle[first], bc = middle[(first + 1) % 3], ca = middle[(first + 2) % 3];
            if (ab < 0)
                finer.push_back(t);
            else if (bc < 0)
                finer.insert(finer.end(), {{a, ab, c}, {ab, b, c}});
            else if (ca < 0)
                finer.insert(finer.end(), {{ab, b, bc}, {a, ab, c}, {ab, bc, c}});
            else
                finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh_.triangles = std::move(finer);
        return !middles.empty();
    }

    bool isBesideDamage(const Triangle& t) const {
        const mechanics::Lattice& lattice = frame_.lattice();
        const auto at = [&](std::size_t k) { return inCells(mesh_.places[static_cast<std::size_t>(t[k])]); };
        const glm::ivec3 last = lattice.counts - 1;
        const dvec3 a = at(0), b = at(1), c = at(2);
        const glm::ivec3 low = glm::clamp(glm::ivec3(glm::floor(glm::min(a, glm::min(b, c)))), glm::ivec3(0), last);
        const glm::ivec3 high = glm::clamp(glm::ivec3(glm::floor(glm::max(a, glm::max(b, c)))), glm::ivec3(0), last);
        bool isBeside = false;
        eachCube(high - low + 1, [&](const glm::ivec3& way) {
            const std::size_t cube = lattice.indexOf(low + way);
            const int carrier = standIns_[cube] >= 0 ? standIns_[cube] : lattice.carriers[cube];
            isBeside = isBeside || (carrier >= 0 && !isWhole(lattice.cells[static_cast<std::size_t>(carrier)]));
        });
        return isBeside;
    }

    int add(SkinVertex vertex) {
        skin_.vertices.push_back(std::move(vertex));
        return static_cast<int>(skin_.vertices.size()) - 1;
    }
    void addTriangle(const Triangle& t, int source) {
        if (t[0] >= 0 && t[1] >= 0 && t[2] >= 0) skin_.triangles.push_back({t, source});
    }

    // A vertex of the mesh: as part of its cell, or of what is left there.
    int vertexAt(int v) {
        const auto [known, isNew] = known_.try_emplace({v, -1}, 0);
        if (!isNew) return known->second;
        const dvec3 &place = mesh_.places[static_cast<std::size_t>(v)], x = inCells(place);
        const mechanics::LatticeCell& cell = cellAt(x);
        SkinVertex vertex{{}, place, mesh_.uv[static_cast<std::size_t>(v)]};
        if (isWhole(cell)) {
            const mechanics::CarriedPoint carried = mechanics::carriedBy(cell, x);
            for (std::size_t k = 0; k < 8; ++k)
                vertex.terms.push_back({carried.points[k], static_cast<float>(carried.weights[k])});
        } else {
            const int owner = owners_[static_cast<std::size_t>(v)];
            if (owner < 0) return known->second = -1;
            remains_.carry(vertex, owner);
        }
        return known->second = add(std::move(vertex));
    }

    // Where an edge of the mesh is cut, on the side of v.
    int vertexBeyond(int v, int w) {
        const auto [known, isNew] = known_.try_emplace({v, w}, 0);
        if (!isNew) return known->second;
        const bool isForward = v < w;
        const int low = isForward ? v : w, high = isForward ? w : v;
        const dvec3 &from = mesh_.places[static_cast<std::size_t>(low)],
                    &to = mesh_.places[static_cast<std::size_t>(high)];
        double left = 0.0, right = 1.0;
        for (int k = 0; k < halvings; ++k) {
            const double middle = 0.5 * (left + right);
            const bool isLeft = areJoined(owners_[static_cast<std::size_t>(low)], ownerAt(from + middle * (to - from)));
            (isLeft ? left : right) = middle;
        }
        int owner = ownerAt(from + (isForward ? left : right) * (to - from));
        if (const int of = owners_[static_cast<std::size_t>(v)]; !areJoined(owner, of)) owner = of;
        if (owner < 0) return known->second = -1;
        const dvec3 place = from + left * (to - from);
        const dvec2 &a = mesh_.uv[static_cast<std::size_t>(low)], &b = mesh_.uv[static_cast<std::size_t>(high)];
        SkinVertex vertex{{}, place, a + left * (b - a)};
        remains_.carry(vertex, owner);
        return known->second = add(std::move(vertex));
    }

    int faceVertex(const Skin& faces, int v) {
        const auto [known, isNew] = ofFaces_.try_emplace(v, 0);
        if (isNew) known->second = add(faces.vertices[static_cast<std::size_t>(v)]);
        return known->second;
    }

    // A cut face, as far as it is inside of the mesh.
    void addInside(const Skin& faces, const SkinTriangle& face) {
        constexpr int n = faceDivisions;
        const auto corner = [&](int k) -> const SkinVertex& {
            return faces.vertices[static_cast<std::size_t>(face.vertices[static_cast<std::size_t>(k)])];
        };
        std::array<std::array<bool, n + 1>, n + 1> isIn{};
        const auto placeOf = [&](const dvec3& weights) {
            dvec3 place(0.0);
            for (int k = 0; k < 3; ++k) place += weights[k] * corner(k).rest;
            return place;
        };
        const auto weightsAt = [](int i, int j) { return dvec3(n - i - j, i, j) / static_cast<double>(n); };
        int inside = 0;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j)
                inside +=
                    (isIn[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = has(placeOf(weightsAt(i, j))));
        if (inside == 0) return;
        if (inside == (n + 1) * (n + 2) / 2)
            return addTriangle({faceVertex(faces, face.vertices[0]), faceVertex(faces, face.vertices[1]),
                                faceVertex(faces, face.vertices[2])},
                               -1);
        const auto vertexOf = [&](const dvec3& weights) {
            SkinVertex vertex{{}, placeOf(weights), dvec2(0.0)};
            for (int k = 0; k < 3; ++k)
                if (corner(k).above != 0.0F) {  // no sum of points is between what stands above some
                    remains_.carry(vertex, corner(k).base[0]);
                    return add(std::move(vertex));
                }
            std::map<int, float> terms;
            for (int k = 0; k < 3; ++k)
                for (const auto& [point, weight] : corner(k).terms)
                    terms[point] += static_cast<float>(weights[k]) * weight;
            for (const auto& [point, weight] : terms) vertex.terms.push_back({point, weight});
            return add(std::move(vertex));
        };
        using Grid = std::array<int, 2>;
        const auto addPart = [&](const std::array<Grid, 3>& corners) {
            std::vector<int> polygon;
            for (std::size_t k = 0; k < 3; ++k) {
                const Grid &a = corners[k], &b = corners[(k + 1) % 3];
                const auto in = [&](const Grid& g) {
                    return isIn[static_cast<std::size_t>(g[0])][static_cast<std::size_t>(g[1])];
                };
                dvec3 from = weightsAt(a[0], a[1]), to = weightsAt(b[0], b[1]);
                if (in(a)) polygon.push_back(vertexOf(from));
                if (in(a) == in(b)) continue;
                for (int h = 0; h < halvings; ++h) {
                    const dvec3 middle = 0.5 * (from + to);
                    (has(placeOf(middle)) == in(a) ? from : to) = middle;
                }
                polygon.push_back(vertexOf(from));
            }
            for (std::size_t k = 2; k < polygon.size(); ++k) addTriangle({polygon[0], polygon[k - 1], polygon[k]}, -1);
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                addPart({{{i, j}, {i + 1, j}, {i, j + 1}}});
                if (i + j + 1 < n) addPart({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
            }
    }

    const Body& body_;
    const BlockFrame frame_;
    const Remains remains_;
    std::vector<std::vector<int>> neighbours_;  // (points)
    std::vector<int> firstGone_;                // (cells)
    std::vector<int> standIns_;                 // (cubes of the lattice) cells; -1: none
    PlacedMesh mesh_;                           // refined beside damage
    std::optional<Inside> inside_;
    std::vector<int> owners_;  // (vertices) points
    std::map<std::pair<int, int>, bool> areJoined_;
    std::map<std::pair<int, int>, int> known_;  // vertices of the skin, by those of the mesh
    std::map<int, int> ofFaces_;                // likewise, by those of cut faces
    Skin skin_;
};

}  // namespace

Skin cutMesh(const Body& body, const PlacedMesh& mesh) {
    return MeshCutter(body, mesh).cut();
}

Skin bluntMesh(const Body& body, const PlacedMesh& mesh, double back) {
    return MeshCutter(body, mesh).blunt(back);
}

}  // namespace taut::world
