// All shapes of colliders by name. The table is a value: a program may add shapes of its own. A new shape of the engine
// is one file in shapes/, with its distance, its mesh and its row, and one line in shape_table.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "taut/collision/convex.h"
#include "taut/collision/form.h"
#include "taut/core/table.h"
#include "taut/view/primitives.h"

namespace taut::collision {

// The sizes that shapes are made from; each shape takes those it needs. Lengths are in metres, about the shape's own
// origin; round shapes have the axis y.
struct ShapeSizes {
    dvec3 normal{0.0, 1.0, 0.0};           // of a plane through the origin, away from the solid; of any length
    dvec3 halfSize{0.5};                   //
    double radius = 0.5;                   //
    double height = 1.0;                   // of a capsule between the two centres, else whole
    std::vector<dvec3> vertices;           //
    std::vector<std::uint32_t> triangles;  // (3 · triangles) counter-clockwise seen from outside
    double edge = 0.0;                     // rounding of edges, for the eye
    bool stands = false;                   // with its lower side on a ground
    std::map<std::string, double, std::less<>> own;  // what a shape adds to these, by its key
};

// A size that only this shape has, beyond the fields of all colliders.
struct OwnSize {
    std::string_view key;  // as scenes write it, "tube_m"
    std::string_view unit;
    double least, most;  // closed limits
    double standard;     // when a scene does not say
    std::string_view help;
};

// A row of the table of shapes. The texts are not copied.
struct ShapeKind {
    std::string_view name;                 // as scenes write it
    std::vector<std::string_view> fields;  // of a collider, besides its place: "radius", "height", "size", …
    std::vector<OwnSize> own;
    bool isBounded;  // else it cannot be a part of a compound

    // Throws core::Error(badContent) for sizes that make no form.
    std::function<std::shared_ptr<const Form>(const ShapeSizes& sizes)> form;
    std::function<view::Mesh(const ShapeSizes& sizes)> mesh;  // about the same origin
    // As it touches other convex shapes, its edges rounded by so much [m]; none: it is not convex.
    std::function<std::shared_ptr<const Convex>(const ShapeSizes& sizes, double rounding)> convex{};
};

class ShapeKinds : public core::Table<ShapeKind> {
  public:
    // Puts it last. Expects a name that no other has, and both functions.
    void add(ShapeKind kind);
};

// The engine's own.
const ShapeKinds& builtInShapes();

}  // namespace taut::collision
