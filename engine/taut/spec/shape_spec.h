// The common part of colliders, solids and the parts of their compounds: a shape of the table of shapes.
#pragma once

#include <map>
#include <string>

#include "taut/collision/shape_table.h"
#include "taut/spec/mesh_data.h"
#include "taut/spec/source.h"

namespace taut::world {

struct ShapeSpec : MeshSource {    // the file: of a hull, a mesh, a figure
    std::string shape = "sphere";  // a name from the table of shapes (collision/shape_table.h)
    dvec3 position{0.0};           // [m]
    dvec3 rotation{0.0};           // [rad]
    dvec3 size{1.0};               // box: whole edges [m]
    double radius = 0.5;           // [m]
    double height = 1.0;           // [m] cylinder, cone: whole; capsule: between the centres of its half spheres
    std::map<std::string, double, std::less<>> sizes;  // further sizes of the shape, by key
    double scale = 1.0;                                // of a mesh
    double edge = 0.01;                                // [m] rounding of a drawn box's edges
};

// Throws core::Error(badContent) if the table has no such shape.
const collision::ShapeKind& shapeKindOf(const ShapeSpec& spec, const collision::ShapeKinds& kinds);
collision::ShapeSizes sizesOf(const ShapeSpec& spec, const collision::ShapeKind& kind);

}  // namespace taut::world
