// Meshes of the collider shapes, centred at the origin, for drawing. Sizes in metres, all expected to be above zero but
// where a function says else; axis of revolution is y.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "taut/view/frame_view.h"

namespace taut::view {

struct Mesh {
    std::shared_ptr<const Topology> topology;
    std::shared_ptr<const Geometry> geometry;
};

Mesh sphereMesh(float radius);
// Edges rounded for the eye: catch the light; radius >= 0. Where it stands, those of its foot are not: they would leave
// a slit above the ground, all but black.
Mesh boxMesh(glm::vec3 halfSize, float edgeRadius, bool stands = false);
Mesh cylinderMesh(float radius, float height);
Mesh coneMesh(float radius, float height);        // centre at half height, tip up
Mesh capsuleMesh(float radius, float height);     // height >= 0 between the centres of the two half spheres
Mesh quadMesh(glm::vec3 normal, float halfSize);  // a finite piece of a tilted plane through the origin

// A triangle mesh with normals: smooth where neighbours meet at less than creaseAngle [rad], sharp elsewhere. positions
// (vertices) [m], triangles (3 · triangles) numbers of vertices; expects those to exist.
Mesh creasedMesh(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles, float creaseAngle);

// Area-weighted vertex normals (vertices) of an indexed mesh, arrays as above; a vertex without area gets (0, 1, 0).
void smoothNormals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles,
                   std::span<glm::vec3> normals);

}  // namespace taut::view
