// The surface of a damaged cloth or block: the triangles that are left, and the parts of severed ones up to the cut,
// each attached to its own side. It knows no picture.
//
//      b
//      |.          A triangle of which the edges ab and ac are severed is drawn as a, p, q and as b, c, q', p'.
//      | .
//   p' +  .        p and p' lie at the same share of the edge. p belongs to the surface at a, p' to that at b, as if
//   p  +   .       each went on flat beyond it.
//      |    .
//      a-+-+-c
//        q q'
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

#include "taut/damage/damage.h"

namespace taut::world {

using glm::dvec2;
using glm::dvec3;

// Where a vertex is: a sum of points of the model with weights that add up to 1, and `above` the triangle of three of
// them.
struct SkinVertex {
    struct Term {
        int point;
        float weight;
    };
    std::vector<Term> terms;
    dvec3 rest{0.0};  // [m] where it is in the model
    dvec2 uv{0.0};    // [m] along the material; unused for blocks
    std::array<int, 3> base{};
    float above = 0.0F;  // [m]
    glm::vec3 at(std::span<const glm::vec3> positions) const;
};

struct SkinTriangle {
    std::array<int, 3> vertices;
    int source;  // triangle of the model that it is part of, or -1 on the face of a cut through a block
};

struct Skin {
    std::vector<SkinVertex> vertices;
    std::vector<SkinTriangle> triangles;
};

// Expects damage that has been assessed.
Skin skinOf(const mechanics::Model& model, const Damage& damage);
// The faces of cuts through a block, without those of crumbs (remains.h).
Skin cutFacesOf(const mechanics::Model& model, const Damage& damage);

// The contact surface of a cut block: the outside of its intact tetrahedra, a closed surface, whose corners at the cut
// stand out until `back` [m] behind where their edges are severed, nearly. Points without an intact tetrahedron are
// vertices, also where no triangle has them.
Skin bluntSkinOf(const mechanics::Model& model, const Damage& damage, double back);

}  // namespace taut::world
