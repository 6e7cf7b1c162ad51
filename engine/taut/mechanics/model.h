// A body before it is simulated: point masses, springs, triangles and cells in double precision, in the order of
// authoring. Builders make it; an island turns it into planar arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "taut/core/value.h"

namespace taut::mechanics {

// How the mass is shared among points: by the length, area or volume around a point, or equally, m = M/n, as in the
// slides.
enum class Lumping { weighted, uniform };

enum class SpringKind : std::uint8_t { structural, shear, bend, joint };

struct Spring {
    int a = 0, b = 0;        // point indices, a != b
    double stiffness = 0;    // k [N/m] >= 0
    double restLength = 0;   // L [m] >= 0
    double dampingTime = 0;  // τ [s]: the dashpot is c = τ k [kg/s]
    SpringKind kind = SpringKind::structural;
};

// A hexahedron whose signed volume is preserved, with one pressure for all of it: E = ½ K V0 (V/V0 - 1)². V is that of
// the trilinear map of a cube onto the corners.
//
//        6------7
//      / |    / |      Corner c is at the far end of axis 0, 1, 2 if bit 0, 1, 2 of c is set.
//     4--|---5  |
//     |  2---|--3
//     | /    | /
//     0------1
//
struct VolumeCell {
    std::array<int, 8> points{};  // V > 0 at rest
    double restVolume = 0;        // V0 [m³] > 0
    double bulkModulus = 0;       // K [Pa]
};

// Corners of the six right-handed tetrahedra that a cell is cut up into where it needs faces: each of the six orders of
// the axes gives a path of three edges from corner 0 to corner 7 (Kuhn 1960). Cells that meet cut their common face
// alike.
inline constexpr std::array<std::array<std::size_t, 4>, 6> cellTetrahedra = {
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}, {0, 6, 4, 7}, {0, 3, 2, 7}}};

// Points of the tetrahedron `number` (0 to 5) of a cell.
inline std::array<int, 4> tetrahedronOf(const VolumeCell& cell, std::size_t number) {
    const auto& t = cellTetrahedra[number];
    return {cell.points[t[0]], cell.points[t[1]], cell.points[t[2]], cell.points[t[3]]};
}

// Resistance to bending of a grid of points, row by row: quadratic in places (Bergou et al. 2006), so that its forces
// are linear and a flat sheet has a stiffness.
//
//     q           fold along a row      d = p - 2c + r
//     |           fold across           e = q - 2c + s          E = ½ along d² + ½ across e² + both d·e
//  p--c--r        twist of a cell       w = c - r - s + t         + ½ twist w²
//     |  |
//     s--t
//
// A row of a rope is such a grid as well.
struct Bending {
    int columns = 0, rows = 0;  // points; 0: nothing bends
    // (points) [N/m] at c; 0 where there is no such fold or cell. both² < along · across.
    std::vector<double> along, across, both, twist;
    double dampingTime = 0;  // τ [s]: forces are those of x + τ v

    // A point whose direction is held: E = ½ stiffness |x_next - x_held - arm|².
    struct Clamp {
        int held = 0, next = 0;
        glm::dvec3 arm{0.0};   // [m]
        double stiffness = 0;  // [N/m]
    };
    std::vector<Clamp> clamps{};

    bool isEmpty() const { return columns == 0; }
};

// Of an orthotropic sheet, per metre of width:
//   energy per area = ½ [ along κ_uu² + across κ_vv² + 2 both κ_uu κ_vv + twist κ_uv² ]
struct BendingRigidity {
    double along = 0, across = 0, both = 0, twist = 0;  // B_u, B_v, B_1, 4 D_k [N m]
};

// Dry friction between the threads of a grid that is flat at rest: each of its folds is also a spring on the curvature
// κ that slips (a Jenkin element), with the moment K_p (κ - κ_s) between ± K_p yield.
struct BendingFriction {
    Bending stuck;          // rigidity without slip: K_p along and across, neither `both` nor `twist`
    double yield = 0;       // [1/m] > 0
    glm::dvec2 cell{1.0};   // [m] sides of a cell, along a row and across
    glm::dvec3 front{0.0};  // unit normal at rest, row × column

    bool isEmpty() const { return stuck.isEmpty(); }
};

// Bending resistance other than of flat grids and straight ropes: of the triangles of a mesh, of a ring, of a rope that
// is curved at rest. bending_elements.h makes elements of it.
struct FreeformBending {
    BendingRigidity rigidity;      // of a rope only `along`, EI [N m²]
    std::vector<glm::dvec3> rest;  // (points) [m] places at rest; empty: nothing bends
    std::vector<glm::dvec3> warp;  // (triangles) unit, the direction of u in the plane of the triangle; of a rope empty
    bool isClosed = false;         // of a rope: its last point is next to its first
    bool isCurved = true;          // of a rope: it is curved at rest, else straight
    double dampingTime = 0;        // τ [s]: forces are those of x + τ v

    bool isEmpty() const { return rest.empty(); }
};

// A part of a rigid body that touches others as one surface: all of it, or one of its shapes.
struct RigidPart {
    int first = 0, last = 0;  // points
    double thickness = 0;     // [m] that it keeps from others beyond its points and triangles
    double rounding = 0;      // [m] how far beyond them it ends as it is drawn
    double sag = 0;           // [m] how far a solid of revolution is outside of its triangles at most
};

struct Model {
    TAUT_VALUE(Model);
    // (points)
    std::vector<glm::dvec3> positions;   // [m]
    std::vector<glm::dvec3> velocities;  // [m/s]
    std::vector<double> masses;          // [kg] > 0, also of held points
    std::vector<double> airMasses;       // [kg] the part of them that is air, without weight; empty: none
    double plateAir = 0;                 // [kg/m²] of air at a surface that makes it flutter in a wind
    std::vector<double> dragRates;       // γ/m [1/s] >= 0
    std::vector<bool> held;              // inverse mass 0
    std::vector<glm::dvec2> uv;          // [m] along the material; (0, 0) where it has none
    int innerPoints = 0;                 // the first points touch nothing: a rigid body's (rigid.h)
    std::vector<RigidPart> parts;        // of a rigid body, in the order of points and triangles

    std::vector<Spring> springs;
    std::vector<std::array<int, 3>> triangles;  // the surface, counter-clockwise seen from its front; empty for ropes
    std::vector<VolumeCell> cells;
    double workingStretch = 1;  // of a cell's edges, up to which a step must hold
    Bending bending;
    BendingFriction friction;
    FreeformBending freeform;

    // Points by name: "left", "top-left", "all", … as each builder documents. Indices ascend, but for edges of panels
    // and lines of mesh files, which have the order of their way.
    std::map<std::string, std::vector<int>> groups;

    // Cells along u and v of a rectangular grid with points row by row, or {0, 0}.
    std::array<int, 2> grid{0, 0};
    double grain = 0;  // [rad] from u to the warp, towards v

    int pointCount() const { return static_cast<int>(positions.size()); }
};

}  // namespace taut::mechanics
