// All shapes by name, for colliders, solids and parts of compounds. The table is a value: a program may add shapes of
// its own. A new shape of the engine is one file in shapes/, with its row, and one line in shape_table.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/collision/convex.h"
#include "taut/collision/form.h"
#include "taut/core/mass_properties.h"
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
    std::map<std::string, double, std::less<>> own;  // additional keys of a shape
};

// A size that only this shape has, beyond the fields of all colliders.
struct OwnSize {
    std::string_view key;  // as scenes write it, "tube_m"
    std::string_view unit;
    double least, most;  // closed limits
    double standard;     // when a scene does not say
    std::string_view help;
};

// A shape as a solid: how its mass lies, and the points and triangles that meshes and bodies touch.
struct SolidShape {
    std::vector<dvec3> positions;  // [m] without the rounding
    std::vector<std::array<int, 3>> triangles{};
    std::vector<std::array<int, 2>> lines{};          // for shapes that are thin without their rounding
    double sag = 0;                                   // [m] how far round sides are outside of the triangles at most
    std::map<std::string, std::vector<int>> sides{};  // points by name, "top"
    // Of the whole shape; none: of the triangles, which have to be closed then.
    std::optional<core::MassProperties> properties{};
};

enum class Extent {
    bounded,    // it may be a part of a compound
    halfSpace,  //
    animated,   // an animation moves its mesh
    parts,      // it is a compound, and nothing of its own
};

// A row of the table of shapes. The texts are not copied.
struct ShapeKind {
    std::string_view name;                 // as scenes write it
    std::vector<std::string_view> fields;  // besides its place: "radius", "height", "size", …
    std::vector<OwnSize> own{};
    Extent extent = Extent::bounded;

    // These throw core::Error(badContent) for sizes that make no shape. The form for points of bodies; none: the form
    // of the convex shape.
    std::function<std::shared_ptr<const Form>(const ShapeSizes& sizes)> form{};
    // As it touches other convex shapes, its edges rounded by so much [m]; none: it is not convex.
    std::function<std::shared_ptr<const Convex>(const ShapeSizes& sizes, double rounding)> convex{};
    std::function<view::Mesh(const ShapeSizes& sizes)> mesh{};                    // about the same origin
    std::function<SolidShape(const ShapeSizes& sizes, double rounding)> solid{};  // none: no solid has this shape
    // [m] Radius of the largest ball in it, within which a solid is rounded; none: others keep its thickness from it.
    std::function<double(const ShapeSizes& sizes)> largestBall{};
    bool isRound = false;  // its rounding is that radius

    // As a collider.
    Shape shape(const ShapeSizes& sizes) const;
};

class ShapeKinds : public core::Table<ShapeKind> {
  public:
    // Puts it last. Expects a name that no other has; but for a compound a mesh, and a form or a convex shape.
    void add(ShapeKind kind);
};

// The engine's own.
const ShapeKinds& builtInShapes();

}  // namespace taut::collision
