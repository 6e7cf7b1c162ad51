#include "taut/collision/shape_table.h"

#include "taut/core/error.h"

// One line for each shape, in the order in which texts name them. It is the function that returns the shape's row; each
// has its own file.
#define TAUT_SHAPES(SHAPE) \
    SHAPE(planeKind)       \
    SHAPE(boxKind)         \
    SHAPE(sphereKind)      \
    SHAPE(capsuleKind)     \
    SHAPE(cylinderKind)    \
    SHAPE(coneKind)        \
    SHAPE(hullKind)        \
    SHAPE(meshKind)        \
    SHAPE(figureKind)      \
    SHAPE(compoundKind)

namespace taut::collision {

#define TAUT_DECLARE(kind) ShapeKind kind();
TAUT_SHAPES(TAUT_DECLARE)
#undef TAUT_DECLARE

// The shapes of its parts. Rounding of edges, for the eye, is theirs.
ShapeKind compoundKind() {
    return {.name = "compound", .fields = {"parts", "edge"}, .extent = Extent::parts};
}

const ShapeKinds& builtInShapes() {
    static const ShapeKinds table = [] {
        ShapeKinds all;
#define TAUT_ADD(kind) all.add(kind());
        TAUT_SHAPES(TAUT_ADD)
#undef TAUT_ADD
        return all;
    }();
    return table;
}

Shape ShapeKind::shape(const ShapeSizes& sizes) const {
    Shape made;
    if (convex) made.convex = convex(sizes, 0.0);
    made.form = form ? form(sizes) : made.convex->form();
    return made;
}

void ShapeKinds::add(ShapeKind kind) {
    TAUT_EXPECTS(kind.extent == Extent::parts ||
                 (kind.mesh != nullptr && (kind.form != nullptr || kind.convex != nullptr)));
    Table::add(std::move(kind));
}

}  // namespace taut::collision
