// Meshes in GL buffers, uploaded once for each pointer and given back when the pointer's owner is gone.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "taut/render/private/gl.h"
#include "taut/render/private/light_box.h"
#include "taut/view/frame_view.h"

namespace taut::render {

// The identity of the triangles and their places: equal values in two pictures look the same from the light and from
// above.
struct ShadowShape {
    std::uint64_t geometry = 0, topology = 0;  // numbers of uploads, each used once
    glm::mat4 transform{1.0F};
    bool twoSided = false;
    bool operator==(const ShadowShape&) const = default;
};

// A surface ready to be drawn.
struct DrawItem {
    const view::Surface* surface = nullptr;
    GLuint vertices = 0;  // buffer: positions, then normals
    GLuint corners = 0;   // buffer: uv
    GLuint indices = 0;   // buffer
    GLsizei indexCount = 0;
    std::size_t vertexCount = 0;
    Bounds bounds;               // in the world
    std::vector<Bounds> pieces;  // in the world, of so many triangles each that their shape shows
    ShadowShape shape;
    bool isStill = false;  // as in the call before
};

class MeshCache {
  public:
    explicit MeshCache(const Gl& gl);

    // Uploads new data. Expects topology, geometry and finish of every surface, of matching sizes.
    std::vector<DrawItem> items(const std::vector<view::Surface>& surfaces);

    // Draws the triangles of an item with the program in use: positions at location 0, normals 1, uv 2; at 3
    // the positions of another item's vertices, if they are given.
    void draw(const DrawItem& item, GLuint otherVertices = 0) const;

    std::size_t size() const { return geometries_.size() + topologies_.size(); }

  private:
    struct GeometryEntry {
        std::weak_ptr<const view::Geometry> owner;
        GlObject vertices;
        Bounds bounds;
        std::uint64_t number = 0;
        std::weak_ptr<const view::Topology> topology;  // whose triangles the pieces are made of
        std::vector<Bounds> pieces;
    };
    struct TopologyEntry {
        std::weak_ptr<const view::Topology> owner;
        GlObject corners, indices;
        std::uint64_t number = 0;
    };
    GeometryEntry& upload(const std::shared_ptr<const view::Geometry>& geometry);
    const TopologyEntry& upload(const std::shared_ptr<const view::Topology>& topology);
    void forgetExpired();
    GlObject takeBuffer();

    const Gl* gl_;
    GlObject layout_;
    std::map<const view::Geometry*, GeometryEntry> geometries_;
    std::map<const view::Topology*, TopologyEntry> topologies_;
    std::uint64_t uploads_ = 0;
    std::vector<ShadowShape> before_;  // of the surfaces of the call before
    std::vector<GlObject> spare_;      // buffers of forgotten meshes, to be filled again
};

}  // namespace taut::render
