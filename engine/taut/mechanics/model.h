// A body before it is simulated: point masses, springs, triangles and cells in double precision, in the order of
// authoring. Builders make it; an island turns it into planar arrays.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

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

// A tetrahedron whose signed volume is preserved: E = ½ K V0 (V/V0 - 1)².
struct VolumeCell {
    std::array<int, 4> points{};  // right-handed: det[p1-p0, p2-p0, p3-p0] > 0 at rest
    double restVolume = 0;        // V0 [m³] > 0
    double bulkModulus = 0;       // K [Pa]
};

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

struct Model {
    // (points)
    std::vector<glm::dvec3> positions;   // [m]
    std::vector<glm::dvec3> velocities;  // [m/s]
    std::vector<double> masses;          // [kg] > 0, also of held points
    std::vector<double> dragRates;       // γ/m [1/s] >= 0
    std::vector<bool> held;              // inverse mass 0
    std::vector<glm::dvec2> uv;          // [m] along the material; (0, 0) where it has none

    std::vector<Spring> springs;
    std::vector<std::array<int, 3>> triangles;  // the surface, counter-clockwise seen from its front; empty for ropes
    std::vector<VolumeCell> cells;
    double workingStretch = 1;  // of a cell's edges, up to which a step must hold
    Bending bending;

    // Points by name: "left", "top-left", "all", … as each builder documents. Indices ascend.
    std::map<std::string, std::vector<int>> groups;

    // Cells along u and v of a rectangular grid with points row by row, or {0, 0}.
    std::array<int, 2> grid{0, 0};

    int pointCount() const { return static_cast<int>(positions.size()); }
};

}  // namespace taut::mechanics
