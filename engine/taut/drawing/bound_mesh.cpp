#include "taut/drawing/private/bound_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/parallel.h"
#include "taut/spec/private/rotation.h"
#include "taut/spec/spec.h"
#include "taut/view/primitives.h"

namespace taut::world {
namespace {

constexpr int boundAtOnce = 64;        // vertices in a task
constexpr double mostEdgesAway = 2.0;  // of the longest edge, or cell, of the bound body

// The mesh drawn in place of a body: its skin, or the mesh of a block.
const MeshData& meshOf(const Body& body) {
    const FinishSpec& finish = body.spec->finish;
    return finish.skinData != nullptr ? *finish.skinData : *body.spec->meshSource()->meshData;
}

std::vector<dvec3> placesOf(const MeshData& mesh, const MeshPlace& place) {
    std::vector<dvec3> places;
    for (const dvec3& x : mesh.positions) places.push_back(place.of(x));
    return places;
}

[[noreturn]] void failFar(const Body& body, std::size_t vertex, double distance, double most) {
    const FinishSpec& finish = body.spec->finish;
    const MeshData& mesh = *finish.skinData;
    const auto has = [&](const std::array<int, 3>& t) { return core::contains(t, static_cast<int>(vertex)); };
    const auto face = static_cast<std::size_t>(std::find_if(mesh.triangles.begin(), mesh.triangles.end(), has) -
                                               mesh.triangles.begin());
    const std::string line = face < mesh.lines.size() ? fmt::format(":{}", mesh.lines[face]) : "";
    throw core::Error(
        core::ErrorKind::badContent,
        at(body.spec->source) +
            fmt::format(
                "cannot use this skin: {}{}: error: a corner of this face is {:.3g} m from {}, more than {:.3g} m\n"
                "  place it on the initial body, in metres of the scene: taut export SCENE --frames 0-0 -o start.glb "
                "writes that, or make the body's cells larger",
                finish.skin, line, distance, body.fullName(), most));
}

// A triangle and the weights of its corners at the place that is nearest, or nearly so.
struct Foot {
    double square = std::numeric_limits<double>::infinity();  // [m²]
    std::size_t triangle = 0;
    dvec3 weights{0.0};
};

struct RestTriangle {
    std::array<dvec3, 3> x;
    dvec3 centre;
    double radius;  // [m] of a ball about the centre that holds it

    // How the weights of the corners change along a way in its plane.
    dvec3 weightsAlong(const dvec3& way) const {
        const dvec3 e = x[1] - x[0], f = x[2] - x[0];
        const double ee = glm::dot(e, e), ef = glm::dot(e, f), ff = glm::dot(f, f), area = ee * ff - ef * ef;
        if (!(area > 0.0)) return dvec3(0.0);
        const double we = glm::dot(way, e), wf = glm::dot(way, f);
        const double v = (ff * we - ef * wf) / area, w = (ee * wf - ef * we) / area;
        return {-v - w, v, w};
    }
    dvec3 at(const dvec3& weights) const { return weights.x * x[0] + weights.y * x[1] + weights.z * x[2]; }
};

Foot footOf(const dvec3& p, std::span<const RestTriangle> triangles) {
    Foot foot;
    double nearest = std::numeric_limits<double>::infinity();  // [m]
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const RestTriangle& triangle = triangles[t];
        const double reach = nearest + triangle.radius;
        const dvec3 away = p - triangle.centre;
        if (glm::dot(away, away) > reach * reach) continue;
        dvec3 weights = glm::max(dvec3(1.0, 0.0, 0.0) + triangle.weightsAlong(p - triangle.x[0]), 0.0);
        weights /= weights.x + weights.y + weights.z;
        const dvec3 way = p - triangle.at(weights);
        if (glm::dot(way, way) >= foot.square) continue;
        foot = {glm::dot(way, way), t, weights};
        nearest = std::sqrt(foot.square);
    }
    return foot;
}

std::shared_ptr<view::Topology> topologyOf(const MeshData& mesh) {
    auto topology = std::make_shared<view::Topology>();
    for (const std::array<int, 3>& t : mesh.triangles)
        for (const int v : t) topology->triangles.push_back(static_cast<std::uint32_t>(v));
    for (const dvec2& uv : mesh.uv) topology->uv.emplace_back(uv);
    return topology;
}

}  // namespace

dvec3 MeshPlace::of(const dvec3& x) const {
    return shift + rotated(turn, scale * x);
}

std::vector<glm::vec3> startOf(const Body& body) {
    std::vector<glm::vec3> places;
    for (int i = 0; i < body.model.pointCount(); ++i)
        places.emplace_back(body.model.positions[static_cast<std::size_t>(i)] - jitterOf(body, i));
    return places;
}

BoundMesh::BoundMesh(const Body& body, const MeshPlace& place, std::span<const std::uint32_t> triangles,
                     const view::Geometry& rest, std::span<const glm::vec2> uv) {
    std::vector<RestTriangle> flat;
    double longest = 0.0;
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        RestTriangle& triangle = flat.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) triangle.x[k] = dvec3(rest.positions[triangles[t + k]]);
        triangle.centre = (triangle.x[0] + triangle.x[1] + triangle.x[2]) / 3.0;
        triangle.radius = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle.radius = std::max(triangle.radius, glm::distance(triangle.x[k], triangle.centre));
            longest = std::max(longest, glm::distance(triangle.x[k], triangle.x[(k + 1) % 3]));
        }
    }
    const std::vector<dvec3> places = placesOf(meshOf(body), place);
    std::vector<Foot> feet(places.size());
    core::parallelFor(static_cast<int>(places.size()), boundAtOnce, [&](int v) {
        feet[static_cast<std::size_t>(v)] = footOf(places[static_cast<std::size_t>(v)], flat);
    });
    auto topology = topologyOf(meshOf(body));
    const bool hasUv = !topology->uv.empty();
    for (std::size_t v = 0; v < places.size(); ++v) {
        Foot& foot = feet[v];
        const double most = mostEdgesAway * longest;
        if (!(foot.square <= most * most)) failFar(body, v, std::sqrt(foot.square), most);
        const std::uint32_t* corners = triangles.data() + 3 * foot.triangle;
        const RestTriangle& triangle = flat[foot.triangle];
        // The normal turns between the corners: the foot goes to where it leads to the vertex.
        double above = 0.0;
        for (int i = 0; i < 8; ++i) {
            dvec3 normal(0.0);
            for (int k = 0; k < 3; ++k) normal += foot.weights[k] * dvec3(rest.normals[corners[k]]);
            normal = glm::normalize(normal);
            const dvec3 way = places[v] - triangle.at(foot.weights);
            above = glm::dot(way, normal);
            foot.weights += triangle.weightsAlong(way - above * normal);
        }
        Vertex& vertex = vertices_.emplace_back();
        vertex.above = static_cast<float>(above);
        glm::vec2 along(0.0F);
        for (int k = 0; k < 3; ++k) {
            const auto weight = static_cast<float>(foot.weights[k]);
            vertex.terms[static_cast<std::size_t>(k)] = {corners[k], weight};
            along += weight * uv[corners[k]];
        }
        if (!hasUv) topology->uv.push_back(along);
    }
    topology_ = topology;
}

PlacedMesh placedMesh(const Body& body, const MeshPlace& place, const BlockFrame& frame) {
    const MeshData& mesh = *body.spec->meshSource()->meshData;
    PlacedMesh placed{placesOf(mesh, place), mesh.uv, mesh.triangles};
    if (mesh.uv.empty())
        for (const dvec3& x : placed.places) placed.uv.emplace_back(frame.inside(x));
    return placed;
}

BoundMesh::BoundMesh(const Body& body, const MeshPlace& place, const BlockFrame& frame) {
    const dvec3 cell = frame.lattice().cell;
    const double most = mostEdgesAway * std::max({cell.x, cell.y, cell.z});
    auto topology = topologyOf(meshOf(body));
    const bool hasUv = !topology->uv.empty();
    const std::vector<dvec3> places = placesOf(meshOf(body), place);
    for (std::size_t v = 0; v < places.size(); ++v) {
        const dvec3 local = frame.inside(places[v]);
        const mechanics::LatticeCell& carrier = frame.lattice().carrierOf(local / cell);
        const dvec3 share = local / cell - dvec3(carrier.at);
        const double outside = glm::length(cell * (share - glm::clamp(share, 0.0, 1.0)));
        if (!(outside <= most)) failFar(body, v, outside, most);
        const mechanics::CarriedPoint carried = mechanics::carriedBy(carrier, local / cell);
        Vertex& vertex = vertices_.emplace_back();
        for (std::size_t c = 0; c < 8; ++c)
            vertex.terms[c] = {static_cast<std::uint32_t>(carried.points[c]), static_cast<float>(carried.weights[c])};
        if (!hasUv) topology->uv.emplace_back(local);
    }
    topology_ = topology;
}

view::Geometry BoundMesh::geometry(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals) const {
    view::Geometry geometry{std::vector<glm::vec3>(vertices_.size()), std::vector<glm::vec3>(vertices_.size())};
    core::parallelFor(static_cast<int>(vertices_.size()), boundAtOnce, [&](int number) {
        const auto v = static_cast<std::size_t>(number);
        glm::vec3 place(0.0F), normal(0.0F);
        for (const auto& [at, weight] : vertices_[v].terms) {
            place += weight * positions[at];
            if (!normals.empty()) normal += weight * normals[at];
        }
        const float length = glm::length(normal);
        geometry.positions[v] = length > 0.0F ? place + vertices_[v].above / length * normal : place;
    });
    view::smoothNormals(geometry.positions, topology_->triangles, geometry.normals);
    return geometry;
}

}  // namespace taut::world
