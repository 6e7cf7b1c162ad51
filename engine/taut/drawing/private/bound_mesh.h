// A mesh from a file that is drawn in place of a cloth or a block and goes with it. It knows no file format.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "taut/body/body.h"
#include "taut/damage/private/block_frame.h"
#include "taut/damage/private/placed_mesh.h"
#include "taut/drawing/drawing.h"
#include "taut/view/frame_view.h"

namespace taut::world {

// Each vertex is a weighted sum of places of the body, and stands above that along the normal there:
//
//          p             Of a cloth, as fine as it is drawn, the places are the corners of the nearest triangle, and
//          |             the normal is the smooth one between theirs.
//     a----+--b          Of a block they are the corners of the cell in which the vertex is, or which is nearest.
class BoundMesh {
  public:
    // To triangles of a cloth, where they are before anything moves. Expects finish.skinData. Throws
    // core::Error(badContent), with file and line, for a vertex that is too far away.
    BoundMesh(const Body& body, const MeshPlace& place, std::span<const std::uint32_t> triangles,
              const view::Geometry& rest, std::span<const glm::vec2> uv);
    // To the cells of a block: its skin, with the same error, or else the mesh from which it is made.
    BoundMesh(const Body& body, const MeshPlace& place, const BlockFrame& frame);

    const std::shared_ptr<const view::Topology>& topology() const { return topology_; }
    // positions, normals: of the body; normals of a cloth alone.
    view::Geometry geometry(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals) const;

  private:
    struct Term {
        std::uint32_t place;
        float weight;
    };
    struct Vertex {
        std::array<Term, 8> terms{};
        float above = 0.0F;  // [m]
    };
    std::vector<Vertex> vertices_;
    std::shared_ptr<const view::Topology> topology_;
};

// The mesh from which a block is made, before anything moves.
PlacedMesh placedMesh(const Body& body, const MeshPlace& place, const BlockFrame& frame);

// (points) [m] Where a body is before anything moves, without jitter.
std::vector<glm::vec3> startOf(const Body& body);

}  // namespace taut::world
