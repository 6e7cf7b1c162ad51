#include "taut/scene/private/gltf_meshes.h"

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <tuple>
#include <utility>

namespace taut::scene {

using figure::Figure;
using world::dvec2;
using world::dvec3;

namespace {

class GltfMeshReader {
  public:
    GltfMeshReader(GltfModel& gltf, const GltfNodes& nodes, Figure& figure)
        : gltf_(gltf), nodes_(nodes), figure_(figure) {}

    world::MeshData read() {
        const std::vector<tinygltf::Node>& nodes = gltf_.content().nodes;
        for (std::size_t n = 0; n < nodes.size(); ++n)
            if (nodes_.isDrawn[n] && nodes[n].mesh >= 0) readPart(static_cast<int>(n));
        if (figure_.triangles.empty()) gltf_.fail("there are no triangles");
        if (degenerate_ > 0) gltf_.note(fmt::format("{} triangle(s) without area", degenerate_));
        mesh_.positions.resize(vertices_);
        figure::placeVertices(figure_, figure::postureAt(figure_, nullptr, 0.0), mesh_.positions);
        mesh_.triangles = figure_.triangles;
        if (!hasUv_) mesh_.cornerUv.clear();
        if (hasUv_) {
            mesh_.uv.resize(mesh_.positions.size());
            for (std::size_t t = mesh_.triangles.size(); t-- > 0;)
                for (std::size_t k = 0; k < 3; ++k) mesh_.uv[mesh_.triangles[t][k]] = mesh_.cornerUv[t][k];
        }
        for (int i = 0; i < vertices_; ++i) mesh_.numbers.push_back(i + 1);
        return std::move(mesh_);
    }

  private:
    // A vertex of the figure for each place of the part's vertices.
    struct Weld {
        std::map<std::tuple<double, double, double>, int> known;
        int first;  // vertex of the part
    };

    void readPart(int nodeNumber) {
        const tinygltf::Node& node = gltf_.content().nodes[nodeNumber];
        const tinygltf::Mesh& mesh = gltf_.at(gltf_.content().meshes, node.mesh, "mesh");
        figure::Part part;
        part.node = nodes_.numberOf[nodeNumber];
        if (node.skin >= 0) {
            gltf_.at(figure_.skins, node.skin, "skin");
            part.skin = node.skin;
            part.firstInfluence = {0};
        }
        Weld weld{{}, vertices_};
        for (const tinygltf::Primitive& primitive : mesh.primitives) readPrimitive(primitive, mesh.name, weld, part);
        std::vector<double>& weights = figure_.nodes[part.node].weights;
        if (weights.empty()) weights = mesh.weights;
        weights.resize(part.targets.size());
        if (part.positions.empty()) return;
        vertices_ += static_cast<int>(part.positions.size());
        figure_.parts.push_back(std::move(part));
    }

    void readPrimitive(const tinygltf::Primitive& from, const std::string& name, Weld& weld, figure::Part& part) {
        const bool isList = from.mode < 0 || from.mode == TINYGLTF_MODE_TRIANGLES;
        if (!isList && from.mode != TINYGLTF_MODE_TRIANGLE_STRIP && from.mode != TINYGLTF_MODE_TRIANGLE_FAN)
            return gltf_.note(fmt::format("points or lines of mesh \"{}\"", name));
        const auto attribute = [&](const std::string& key) {
            const auto found = from.attributes.find(key);
            return found != from.attributes.end() ? found->second : -1;
        };
        if (attribute("POSITION") < 0) return gltf_.note(fmt::format("a part of mesh \"{}\" without positions", name));
        const GltfNumbers positions = gltf_.numbers(attribute("POSITION"), 3, "POSITION");
        const auto optional = [&](const char* key, std::size_t width) {
            GltfNumbers read{width, {}};
            if (attribute(key) >= 0) read = gltf_.numbers(attribute(key), width, key);
            if (!read.values.empty() && read.count() != positions.count())
                gltf_.fail(fmt::format("mesh \"{}\" has {} of {} for {} of POSITION", name, read.count(), key,
                                       positions.count()));
            return read;
        };
        const GltfNumbers normals = optional("NORMAL", 3), uv = optional("TEXCOORD_0", 2);
        const std::size_t before = part.positions.size();
        const std::vector<int> vertexOf = weldVertices(positions, weld, part);
        readTargets(from, positions.count(), vertexOf, weld, before, part);
        if (part.skin >= 0) readInfluences(attribute, optional, name, vertexOf, weld, before, part);

        // Corners of triangles.
        std::vector<std::size_t> corners;
        if (from.indices >= 0) {
            for (const double v : gltf_.numbers(from.indices, 1, "an index").values) {
                if (!(v >= 0 && v < static_cast<double>(positions.count())))
                    gltf_.fail(fmt::format("mesh \"{}\" has no vertex {}: there are {}", name, v, positions.count()));
                corners.push_back(static_cast<std::size_t>(v));
            }
        } else {
            for (std::size_t i = 0; i < positions.count(); ++i) corners.push_back(i);
        }
        drawn_ += corners.size();
        if (drawn_ > GltfModel::maxElements)
            gltf_.fail(fmt::format("more than {} corners of triangles", GltfModel::maxElements));
        std::vector<std::array<std::size_t, 3>> triangles;
        if (isList) {
            if (corners.size() % 3 != 0)
                gltf_.fail(fmt::format("mesh \"{}\" has {} corners of triangles", name, corners.size()));
            for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
                triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        } else {
            const bool isFan = from.mode == TINYGLTF_MODE_TRIANGLE_FAN;
            for (std::size_t i = 0; i + 2 < corners.size(); ++i)
                triangles.push_back({corners[isFan ? 0 : i], corners[i + 1 + (isFan ? 0 : i % 2)],
                                     corners[i + 2 - (isFan ? 0 : i % 2)]});
        }
        addPiece(from.material, triangles, vertexOf, normals, uv);
    }

    std::vector<int> weldVertices(const GltfNumbers& positions, Weld& weld, figure::Part& part) const {
        std::vector<int> vertexOf;
        for (std::size_t i = 0; i < positions.count(); ++i) {
            const dvec3 p = positions.place(i) + dvec3(0.0);  // -0 becomes +0
            const auto [found, isNew] =
                weld.known.try_emplace({p.x, p.y, p.z}, weld.first + static_cast<int>(part.positions.size()));
            if (isNew) part.positions.push_back(p);
            vertexOf.push_back(found->second);
        }
        return vertexOf;
    }

    // Each new vertex of the part takes the data of the first one merged into it.
    template <class Take>
    static void eachNew(const std::vector<int>& vertexOf, const Weld& weld, std::size_t before, const Take& take) {
        std::size_t next = before;
        for (std::size_t i = 0; i < vertexOf.size(); ++i) {
            const auto own = static_cast<std::size_t>(vertexOf[i] - weld.first);
            if (own == next) {
                take(own, i);
                ++next;
            }
        }
    }

    void readTargets(const tinygltf::Primitive& from, std::size_t count, const std::vector<int>& vertexOf,
                     const Weld& weld, std::size_t before, figure::Part& part) const {
        if (part.targets.size() < from.targets.size()) part.targets.resize(from.targets.size());
        for (std::size_t t = 0; t < part.targets.size(); ++t) {
            part.targets[t].resize(part.positions.size(), dvec3(0.0));
            if (t >= from.targets.size()) continue;
            const auto found = from.targets[t].find("POSITION");
            if (found == from.targets[t].end()) continue;
            const GltfNumbers moves = gltf_.numbers(found->second, 3, "a morph target");
            if (moves.count() != count) gltf_.fail("a morph target has another number of vertices than its mesh");
            eachNew(vertexOf, weld, before,
                    [&](std::size_t own, std::size_t i) { part.targets[t][own] = moves.place(i); });
        }
    }

    template <class Attribute, class Optional>
    void readInfluences(const Attribute& attribute, const Optional& optional, const std::string& name,
                        const std::vector<int>& vertexOf, const Weld& weld, std::size_t before, figure::Part& part) {
        std::vector<GltfNumbers> joints, weights;
        for (int set = 0; attribute(fmt::format("JOINTS_{}", set)) >= 0; ++set) {
            joints.push_back(optional(fmt::format("JOINTS_{}", set).c_str(), 4));
            weights.push_back(optional(fmt::format("WEIGHTS_{}", set).c_str(), 4));
            if (weights.back().values.empty()) gltf_.fail(fmt::format("mesh \"{}\" has JOINTS without WEIGHTS", name));
        }
        if (joints.empty()) gltf_.fail(fmt::format("mesh \"{}\" has a skin but no JOINTS_0", name));
        const std::size_t jointCount = figure_.skins[part.skin].joints.size();
        eachNew(vertexOf, weld, before, [&](std::size_t, std::size_t i) {
            const std::size_t first = part.influences.size();
            double sum = 0;
            for (std::size_t set = 0; set < joints.size(); ++set)
                for (std::size_t k = 0; k < 4; ++k) {
                    const double joint = joints[set][i][k], weight = weights[set][i][k];
                    if (!(weight > 0)) continue;
                    if (!(joint >= 0 && joint < static_cast<double>(jointCount)))
                        gltf_.fail(
                            fmt::format("mesh \"{}\" follows joint {}: its skin has {}", name, joint, jointCount));
                    part.influences.push_back({static_cast<int>(joint), weight});
                    sum += weight;
                }
            if (part.influences.size() == first)
                gltf_.fail(fmt::format("mesh \"{}\" has a vertex that follows no joint", name));
            for (std::size_t k = first; k < part.influences.size(); ++k) part.influences[k].weight /= sum;
            part.firstInfluence.push_back(part.influences.size());
        });
    }

    // Corners with the same place, normal and texture coordinates share a drawn vertex.
    void addPiece(int material, const std::vector<std::array<std::size_t, 3>>& triangles,
                  const std::vector<int>& vertexOf, const GltfNumbers& normals, const GltfNumbers& uv) {
        figure::Piece piece;
        readMaterial(material, piece);
        std::vector<int> smoothOf(vertexOf.size()), drawnOf(vertexOf.size(), -1);
        std::map<std::tuple<int, double, double, double>, int> smooth;
        for (std::size_t i = 0; i < vertexOf.size(); ++i) {
            const dvec3 n = normals.values.empty() ? dvec3(0.0) : normals.place(i);
            smoothOf[i] =
                smooth.try_emplace({vertexOf[i], n.x, n.y, n.z}, figure_.smoothCount + static_cast<int>(smooth.size()))
                    .first->second;
        }
        figure_.smoothCount += static_cast<int>(smooth.size());
        for (const std::array<std::size_t, 3>& corners : triangles) {
            const std::array<int, 3> t{vertexOf[corners[0]], vertexOf[corners[1]], vertexOf[corners[2]]};
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
                ++degenerate_;
                continue;
            }
            figure_.triangles.push_back(t);
            std::array<dvec2, 3> cornerUv{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t i = corners[k];
                // glTF's texture coordinates begin at the upper left.
                if (!uv.values.empty()) cornerUv[k] = {uv[i][0], 1.0 - uv[i][1]};
                if (drawnOf[i] < 0) {
                    drawnOf[i] = static_cast<int>(piece.vertices.size());
                    piece.vertices.push_back(vertexOf[i]);
                    piece.smooth.push_back(smoothOf[i]);
                    piece.uv.emplace_back(cornerUv[k]);
                }
                piece.triangles.push_back(static_cast<std::uint32_t>(drawnOf[i]));
            }
            mesh_.cornerUv.push_back(cornerUv);
        }
        hasUv_ = hasUv_ && !uv.values.empty();
        if (!piece.triangles.empty()) figure_.pieces.push_back(std::move(piece));
    }

    void readMaterial(int number, figure::Piece& piece) {
        if (number < 0) return;
        const tinygltf::Material& material = gltf_.at(gltf_.content().materials, number, "material");
        const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
        if (pbr.baseColorFactor.size() == 4) piece.colour = glm::make_vec3(pbr.baseColorFactor.data());
        piece.colour = glm::clamp(piece.colour, 0.0, 1.0);
        piece.roughness = std::clamp(pbr.roughnessFactor, 0.0, 1.0);
        if (pbr.baseColorTexture.index < 0) return;
        const int source = gltf_.at(gltf_.content().textures, pbr.baseColorTexture.index, "texture").source;
        if (source < 0) return;
        const tinygltf::Image& image = gltf_.at(gltf_.content().images, source, "image");
        piece.texture = gltf_.pictureFile(image);
        if (piece.texture.empty()) gltf_.note("pictures in its text or in its buffers");
    }

    GltfModel& gltf_;
    const GltfNodes& nodes_;
    Figure& figure_;
    world::MeshData mesh_;
    int vertices_ = 0;
    std::size_t drawn_ = 0;  // corners of triangles
    int degenerate_ = 0;     // triangles
    bool hasUv_ = true;
};

}  // namespace

world::MeshData readGltfMeshes(GltfModel& gltf, const GltfNodes& nodes, Figure& figure) {
    return GltfMeshReader(gltf, nodes, figure).read();
}

}  // namespace taut::scene
