// Builders: from a size, a resolution and a material to a model. Stiffness is per metre of material, so that a
// finer model behaves like a coarse one. All lengths in metres, SI units.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/core/error.h"
#include "taut/mechanics/bending.h"
#include "taut/mechanics/lattice.h"
#include "taut/mechanics/model.h"

namespace taut::mechanics {

struct RopeShape {
    glm::dvec3 start{0.0}, end{1.0, 0.0, 0.0};  // [m]
    int segments = 20;
    double length = 0.0;       // natural length [m]; 0 means the distance; longer hangs slack along `sag`
    glm::dvec3 sag{0, -1, 0};  // direction of the slack, unit
    // Places that the rope passes on its way from start to end, along a smooth curve. It is then neither slack nor
    // stretched, and `length` is not used.
    std::vector<glm::dvec3> through{};
    // Its last segment leads back to the first point: a level ring whose diameter goes from start to end, or through
    // those places, from end on to start; `length` is not looked at either.
    bool isClosed = false;
    double mass = 1.0;      // whole rope [kg]
    double stretch = 1e4;   // EA [N]
    double bend = 0.0;      // EA of the span-2 springs [N]
    double rigidity = 0.0;  // EI, of bending [N m²]
    bool isCurvedAtRest =
        false;  // the rigidity resists bending away from the shape as it is laid, not from a straight one
    double dampingTime = 0.0;  // τ [s]
    double dragRate = 0.0;     // γ/m [1/s]
    Lumping lumping = Lumping::weighted;
};
// Points from start to end; of a ring round to the one before start, which lies nearest to end in the middle. Groups:
// start, end, ends, all. Expects segments >= 1, of a ring >= 3, and mass > 0; throws
// core::Error(badContent) when there is neither a length nor a distance.
Model buildRope(const RopeShape& shape);
std::vector<std::string> ropeGroups();  // besides all, as the others

struct ClothMaterial {
    double density = 0.2;      // [kg/m²]
    double stretch = 900.0;    // structural spring constant of a square cell k_s [N/m], along the warp (u)
    double shear = 450.0;      // diagonal k_d [N/m]
    double bend = 1.0;         // span-2 k_b [N/m]
    double dampingTime = 0.0;  // τ [s]
    double dragRate = 0.0;     // γ/m [1/s]
    Lumping lumping = Lumping::weighted;
    BendingRigidity rigidity{};
    std::optional<double> weftStretch{};  // k_s along the weft (v) [N/m]; none: as along the warp
    // Of a grid: the moment per width that friction of its threads resists bending with, and the curvature at which it
    // is reached; 0: none.
    double frictionMoment = 0.0, frictionYield = 0.0;  // [N], [1/m]
};

struct ClothShape {
    glm::dvec3 origin{0.0};      // top left corner [m]
    glm::dvec3 across{1, 0, 0};  // unit, from left to right
    glm::dvec3 down{0, -1, 0};   // unit, from top to bottom
    glm::dvec2 size{1.0, 1.0};   // across, down [m]
    glm::ivec2 cells{16, 16};    // across, down
    ClothMaterial material;
    double grain = 0.0;  // [rad] from `across` to the warp, towards `down`
    bool isRound = false;
};
// Points row by row from the top left. A round cloth has the cells with their middle inside the ellipse that fits into
// the size; points of no cell are held, in no group, and weigh a billionth of a cell. Structural springs on the
// boundary are halved when lumping is weighted. A cell of a by b (not square): k_s b/a along its side a, so that
// stretch stays per metre. A grain of entire quarter turns exchanges warp and weft. Any other turns the rigidity
// exactly (FreeformBending, without friction), and the stretch as nearly as springs along the grid and its diagonals
// can pull: exactly at 45° in square cells, except where springs would have to push. Groups: left, right, top, bottom,
// the four corners (top-left, …), corners, edges, all. Expects at least one cell, and a size above zero, each way.
Model buildCloth(const ClothShape& shape);
std::vector<std::string> clothGroups(bool isRound = false);  // of a round one neither corners

struct MeshClothShape {
    std::vector<glm::dvec3> positions;          // (vertices) [m] welded, each used by a triangle
    std::vector<glm::dvec2> uv;                 // (vertices) [m], or empty: then made from the longest two axes
    std::vector<std::array<int, 3>> triangles;  // (triangles) vertices; consistently oriented, edge-manifold
    // (triangles) texture coordinates of the corners, whose u runs along the warp; or empty: the material then bends
    // alike all ways. Only looked at for a rigidity.
    std::vector<std::array<glm::dvec2, 3>> cornerUv;
    ClothMaterial material;
    std::map<std::string, std::vector<int>> groups;  // more of them, vertices ascending
    std::vector<int> numbers;                        // (vertices) their names in messages; empty: from 1
};
// The fault of a mesh, and its triangle, from 0; -1: none in particular.
struct MeshFault : core::Error {
    MeshFault(const std::string& what, int of) : Error(core::ErrorKind::badContent, what), triangle(of) {}
    int triangle;
};
// Edges k = E₂D (A1 + A2)/c² (van Gelder) with E₂D = 4/3 stretch in an isotropic sheet, and along φ from the warp 4/3
// (warp cos⁴φ + weft sin⁴φ + 4 shear sin²φ cos²φ) in any other; bend springs across inner edges. Groups: boundary, all,
// and top, bottom, left, right: the points within 1 % of the size of that extreme; top-left, top-right, bottom-left,
// bottom-right: the one point furthest into that corner, width and height counted alike; and the groups of the shape
// that have other names. A rigidity resists bending away from the initial shape. Throws MeshFault with a remedy: no
// triangle, an edge of three triangles, a zero area, no direction of the warp.
Model buildMeshCloth(const MeshClothShape& shape);
std::vector<std::string> meshClothGroups();

struct BlockShape {
    glm::dvec3 centre{0.0};  // [m]
    glm::dmat3 axes{1.0};    // columns: the block's own x, y, z
    glm::dvec3 size{1.0};    // [m]
    glm::ivec3 cells{4};
    double density = 300.0;  // [kg/m³]
    double young = 2e4;      // E [Pa]
    double poisson = 0.4;    // ν of the block, 1/4 and more, below 1/2
    // K [Pa] of the cells' pressure, in place of ν: then E is that of the springs alone, whose ν is 1/4. 0: no cells.
    std::optional<double> bulk{};
    double dampingTime = 0.0;  // τ [s]
    double dragRate = 0.0;     // γ/m [1/s]
    Lumping lumping = Lumping::weighted;
    const Lattice* lattice = nullptr;  // the cells of a mesh: then `cells` is not looked at, `size` that of its box
};
// Points x fastest, then y, then z. Springs shared by several cells add up, so that faces and edges carry their
// share. One pressure a cell. Groups: left right bottom top back front (-x +x -y +y -z +z), corners, all; in the
// lattice of a mesh the outermost points that way, and no corners. Expects at least one cell, and a size above zero,
// each way, and right-handed axes.
Model buildBlock(const BlockShape& shape);
std::vector<std::string> blockGroups(bool isBox = true);

struct NetPoint {
    std::string name;
    glm::dvec3 position{0.0};  // [m]
    glm::dvec3 velocity{0.0};  // [m/s]
    double mass = 1.0;         // [kg] > 0
    double dragRate = 0.0;     // γ/m [1/s]
    bool held = false;
};
struct NetSpring {
    std::string a, b;                  // names of points
    double stiffness = 100.0;          // [N/m]
    std::optional<double> restLength;  // [m]; none: the distance at the start
    double dampingTime = 0.0;          // [s]
};
// An explicit network, points in the order given. Groups: each point's name, all. Expects every name once, and springs
// between two different points that exist (the loader checks them).
Model buildNet(std::span<const NetPoint> points, std::span<const NetSpring> springs);

}  // namespace taut::mechanics
