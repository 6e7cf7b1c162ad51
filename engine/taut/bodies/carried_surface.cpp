#include "taut/bodies/private/carried_surface.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "taut/core/error.h"
#include "taut/damage/private/cut_mesh.h"
#include "taut/damage/private/skin_pieces.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/spec.h"

namespace taut::world {

BlockFrame frameOf(const Body& body) {
    const auto& block = dynamic_cast<const BlockSpec&>(*body.spec);
    return {block.lattice(), body.model.positions.front() - jitterOf(body, 0), rotationOf(block.rotation)};
}

MeshPlace shiftOf(const Body& body, const BlockFrame& frame) {
    const auto& block = dynamic_cast<const BlockSpec&>(*body.spec);
    const mechanics::Lattice& lattice = frame.lattice();
    const mechanics::BlockShape shape = block.shapeOf(lattice);
    const dvec3 first = body.model.positions.front() - jitterOf(body, 0);
    return {first - (shape.centre + shape.axes * (lattice.cell * dvec3(lattice.points.front()) - 0.5 * shape.size))};
}

MeshPlace meshPlaceOf(const Body& body, const BlockFrame& frame) {
    const auto& block = dynamic_cast<const BlockSpec&>(*body.spec);
    return {shiftOf(body, frame).shift + block.position, rotationOf(block.rotation), block.scale};
}

namespace {

using Triangle = std::array<int, 3>;

struct Mesh {
    std::vector<dvec3> places;
    std::vector<Triangle> triangles;
};

// Keeps the first of several with the same key, and the remaining triangles.
template <class KeyOf>
Mesh joined(const Mesh& mesh, const KeyOf& keyOf) {
    Mesh joined;
    std::map<decltype(keyOf(0)), int> known;
    std::vector<int> numbers;
    for (std::size_t v = 0; v < mesh.places.size(); ++v) {
        const auto [at, isNew] = known.try_emplace(keyOf(v), static_cast<int>(joined.places.size()));
        numbers.push_back(at->second);
        if (isNew) joined.places.push_back(mesh.places[v]);
    }
    std::set<Triangle> seen;
    for (const Triangle& t : mesh.triangles) {
        Triangle own;
        for (std::size_t k = 0; k < 3; ++k) own[k] = numbers[t[k]];
        if (own[0] == own[1] || own[1] == own[2] || own[2] == own[0]) continue;
        Triangle sorted = own;
        std::sort(sorted.begin(), sorted.end());
        if (seen.insert(sorted).second) joined.triangles.push_back(own);
    }
    return joined;
}

// The mesh with vertices no closer than the sides of cubes, nearly: of those in a cube that hang together there, the
// one stays that stands out most.
Mesh thinned(const Mesh& mesh, double side) {
    const std::size_t count = mesh.places.size();
    const auto cubeOf = [&](int v) { return glm::ivec3(glm::floor(mesh.places[v] / side)); };
    std::vector<dvec3> normals(count, dvec3(0.0));
    std::vector<int> parent(count);
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[v] != v) {
            int& up = parent[v];
            up = parent[up];
            v = up;
        }
        return static_cast<std::size_t>(v);
    };
    for (const Triangle& t : mesh.triangles) {
        const auto at = [&](std::size_t k) { return mesh.places[t[k]]; };
        const dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
        for (std::size_t k = 0; k < 3; ++k) {
            normals[t[k]] += normal;
            const std::size_t a = root(t[k]), b = root(t[(k + 1) % 3]);
            if (cubeOf(t[k]) == cubeOf(t[(k + 1) % 3])) parent[std::max(a, b)] = static_cast<int>(std::min(a, b));
        }
    }
    std::vector<dvec3> outwards(count, dvec3(0.0));  // (roots)
    for (std::size_t v = 0; v < count; ++v) outwards[root(static_cast<int>(v))] += normals[v];
    std::vector<std::size_t> kept(count, count);  // (roots)
    const auto height = [&](std::size_t v, std::size_t of) { return glm::dot(mesh.places[v], outwards[of]); };
    for (std::size_t v = 0; v < count; ++v) {
        const std::size_t own = root(static_cast<int>(v));
        if (kept[own] == count || height(v, own) > height(kept[own], own)) kept[own] = v;
    }
    Mesh chosen = mesh;
    for (std::size_t v = 0; v < count; ++v) chosen.places[v] = mesh.places[kept[root(static_cast<int>(v))]];
    return joined(chosen, [&](std::size_t v) { return root(static_cast<int>(v)); });
}

CarriedSurface surfaceOf(const Skin& skin) {
    CarriedSurface surface;
    for (const SkinVertex& vertex : skin.vertices) {
        surface.rest.push_back(vertex.rest);
        mechanics::CarriedPoint& point = surface.points.emplace_back();
        TAUT_EXPECTS(vertex.terms.size() <= point.points.size());
        point.points.fill(vertex.terms.front().point);
        for (std::size_t k = 0; k < vertex.terms.size(); ++k) {
            point.points[k] = vertex.terms[k].point;
            point.weights[k] = static_cast<double>(vertex.terms[k].weight);
        }
    }
    for (const SkinTriangle& triangle : skin.triangles) surface.triangles.push_back(triangle.vertices);
    return surface;
}

}  // namespace

CarriedSurface carriedSurface(const Body& body) {
    constexpr double fineness = 1.0 / 3.0, coarseness = 1.5;  // of a cell
    const bool isCut = body.damage.goneTetrahedra() > 0;
    // At a cut its thickness behind it, so that the drawn surface ends where the touching body begins.
    const double back = body.spec->thickness;
    if (!body.spec->hasCarriedSurface())
        return isCut ? surfaceOf(bluntSkinOf(body.model, body.damage, back)) : CarriedSurface{};
    const auto& block = dynamic_cast<const BlockSpec&>(*body.spec);
    const BlockFrame frame = frameOf(body);
    const MeshData& file = *block.meshData;
    // A file may have a place several times, with other normals or texture coordinates.
    Mesh mesh = joined(Mesh{file.positions, file.triangles}, [&](std::size_t v) {
        const dvec3& x = file.positions[v];
        return std::array{x.x, x.y, x.z};
    });
    mesh = thinned(mesh, fineness * block.cell / block.scale);
    PlacedMesh placed{{}, std::vector<dvec2>(mesh.places.size()), std::move(mesh.triangles)};
    const MeshPlace place = meshPlaceOf(body, frame);
    for (const dvec3& x : mesh.places) placed.places.push_back(place.of(x));
    refine(placed, coarseness * block.cell, [](const Triangle&) { return true; });
    if (isCut) return surfaceOf(bluntMesh(body.model, body.damage, frame, placed, back));
    CarriedSurface surface;
    for (const dvec3& x : placed.places) {
        const dvec3 local = frame.inside(x) / frame.lattice().cell;
        surface.points.push_back(mechanics::carriedBy(frame.lattice().carrierOf(local), local));
    }
    surface.rest = std::move(placed.places);
    surface.triangles = std::move(placed.triangles);
    return surface;
}

}  // namespace taut::world
